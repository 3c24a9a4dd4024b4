#include "io/scene_solid_files.hpp"

#include <fmt/format.h>

namespace aquagraph::io {

std::map<std::string, std::filesystem::path> files_of(const SolidScene& solid) {
    std::map<std::string, std::filesystem::path> files{{"solid.mesh", solid.mesh},
                                                       {"solid.material.curve", solid.material.curve_file}};
    for (std::size_t k = 0; k < solid.parts.size(); ++k)
        files[fmt::format("solid.part[{}].curve", k)] = solid.parts[k].material.curve_file;
    for (std::size_t k = 0; k < solid.tractions.size(); ++k)
        files[fmt::format("solid.traction[{}].table", k)] = solid.tractions[k].factor.table;
    for (std::size_t k = 0; k < solid.forces.size(); ++k)
        files[fmt::format("solid.force[{}].table", k)] = solid.forces[k].factor.table;
    const auto add = [&files](const char* list, const auto& entries) {
        for (std::size_t k = 0; k < entries.size(); ++k)
            files[fmt::format("solid.{}[{}].table", list, k)] = entries[k].law.table;
    };
    add("motion", solid.motions);
    add("pressure", solid.pressures);
    add("rigid_motion", solid.rigid_motions);
    add("rigid_load", solid.rigid_loads);
    add("ground_motion", solid.ground_motions);
    std::erase_if(files, [](const auto& entry) { return entry.second.empty(); });
    return files;
}

}  // namespace aquagraph::io
