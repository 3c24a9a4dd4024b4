#include "io/scene_geometry_validation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/scene_surfaces.hpp"

namespace aquagraph::io {
namespace {

constexpr double touching = 1e-6;  // of a spacing

// The tables of a wall's shape and in how many dimensions each can be.
struct ShapeTable {
    const char* name;
    bool in_2d, in_3d;
};
constexpr ShapeTable shapes[] = {{"box", true, true},     {"rectangle", false, true}, {"extrusion", false, true},
                                 {"circle", true, false}, {"sphere", false, true},    {"cylinder", false, true},
                                 {"stl", false, true}};

// Tries what `make` makes; what it throws becomes a complaint.
template <class F>
void attempt(Complaints& complaints, const std::string& key, const std::string& help, const F& make) {
    try {
        make();
    } catch (const std::exception& error) {
        complaints.add(key, error.what(), help);
    }
}

double spacing_of(const Scene& scene) {
    return scene.fluid && scene.fluid->spacing > 0 ? scene.fluid->spacing : 1;
}

void wrong_dimension(const Scene& scene, Complaints& complaints, const std::string& key, const std::string& name) {
    complaints.add(key,
                   fmt::format("`{}` is for {} dimensions, but this scene has {}", name,
                               scene.dimension == 2 ? "three" : "two", scene.dimension == 2 ? "two" : "three"),
                   "the length of `min` of [domain] says how many dimensions a scene has");
}

template <int D>
void validate_motion(const Scene& scene, const MotionScene& motion, const std::string& key, Complaints& complaints) {
    const auto law = [&](const auto& law, const std::string& part) {
        if (law.constant && law.amplitude)
            complaints.add(part + ".amplitude", "both `velocity` and `amplitude` are given", "keep one of them");
        const bool rate = complaints.positions.contains(part + ".frequency"),
                   period = complaints.positions.contains(part + ".period");
        if (law.amplitude && rate == period)
            complaints.add(part + ".amplitude",
                           rate ? "both `frequency` and `period` are given" : "`frequency` or `period` is missing",
                           "a harmonic motion has an amplitude and one of frequency and period");
    };
    if (motion.translation) {
        law(*motion.translation, key + ".translation");
        if (!motion.translation->constant && !motion.translation->amplitude)
            complaints.add(key + ".translation", "neither `velocity` nor `amplitude` is given", "give one of them");
    }
    if (motion.rotation) {
        law(*motion.rotation, key + ".rotation");
        if (!motion.rotation->constant && !motion.rotation->amplitude && motion.table.empty())
            complaints.add(key + ".rotation", "neither `velocity` nor `amplitude` is given, and no table",
                           "give one of them");
        if (D == 3 && !(motion.axis[0] != 0 || motion.axis[1] != 0 || motion.axis[2] != 0))
            complaints.add(key + ".rotation.axis", "the axis has no direction", "axis = [0, 0, 1] is upwards");
    }
    if (!motion.translation && !motion.rotation && motion.table.empty())
        complaints.add(key, "the wall has a motion, but nothing moves it",
                       "give [wall.motion.translation], [wall.motion.rotation] or table = \"file.csv\"");
    if (complaints.touch(key)) return;
    attempt(complaints, motion.table.empty() ? key : key + ".table",
            "a head line with time and any of x, y, z, angle, then rows in increasing time that cover the run; "
            "after = \"hold\" lets the wall stand still after the last one",
            [&] { rigid_motion<D>(motion, scene.end_time); });
}

template <int D>
void validate_region(const Scene& scene, const RegionScene& region, Complaints& complaints) {
    const std::string& key = region.key;
    const std::string kind = key.substr(6, key.find('[') - 6);
    if ((kind == "polygon" || kind == "disc") != (D == 2))
        return wrong_dimension(scene, complaints, key, "fluid." + kind);
    if (complaints.touch(key)) return;
    const std::string place = region.stl ? key + ".stl" : kind == "polygon" ? key + ".points" : key;
    attempt(complaints, place,
            region.stl ? "a watertight surface; mend it or say how near vertices are `weld`ed"
                       : "a closed curve that does not cross or touch itself",
            [&] {
                const auto surface = region_surface<D>(region, spacing_of(scene));
                const auto [low, high] = bounds(surface);
                const double tolerance = touching * spacing_of(scene);
                const double top = region.level ? std::min(*region.level, high[D - 1]) : high[D - 1];
                if (top <= low[D - 1]) {
                    complaints.add(key + ".level",
                                   fmt::format("the level {} m lies below all of it: no water", *region.level),
                                   fmt::format("it reaches from {} m to {} m", low[D - 1], high[D - 1]));
                    return;
                }
                double cells = 1;
                for (int d = 0; d < D; ++d) cells *= (high[d] - low[d]) / spacing_of(scene);
                if (cells > most_particles) {
                    complaints.add(key,
                                   fmt::format("the lattice around this water has {:.2g} points, more than {:.2g}",
                                               cells, most_particles),
                                   "take a larger [fluid] spacing, or less water");
                    return;
                }
                for (int d = 0; d < D; ++d) {
                    const double end = d == D - 1 ? top : high[d];
                    if (low[d] >= scene.domain.min[std::size_t(d)] - tolerance &&
                        end <= scene.domain.max[std::size_t(d)] + tolerance)
                        continue;
                    complaints.add(key,
                                   fmt::format("the water reaches out of the domain: in {} from {} m to {} m", "xyz"[d],
                                               low[d], end),
                                   "make the domain larger: [domain] min and max must enclose all water");
                    return;
                }
            });
}

}  // namespace

void validate_wall_shapes(const Scene& scene, Complaints& complaints) {
    for (std::size_t i = 0; i < scene.walls.size(); ++i) {
        const WallScene& wall = scene.walls[i];
        const std::string key = fmt::format("wall[{}]", i);
        std::vector<std::string> given;
        if (complaints.positions.contains(key + ".points")) given.push_back("points");
        for (const ShapeTable& shape : shapes) {
            const std::string table = key + "." + shape.name;
            if (!complaints.positions.contains(table)) continue;
            given.push_back(shape.name);
            if (!(scene.dimension == 2 ? shape.in_2d : shape.in_3d))
                wrong_dimension(scene, complaints, table, std::string("wall.") + shape.name);
        }
        if (given.empty())
            complaints.add(key, "the wall has no shape",
                           "give `points`, or one of [wall.box], [wall.circle] (2D), [wall.rectangle], "
                           "[wall.extrusion], [wall.cylinder], [wall.sphere], [wall.stl] (3D)");
        if (given.size() > 1)
            complaints.add(given[1] == "points" ? key + ".points" : key + "." + given[1],
                           fmt::format("the wall has more than one shape: {}", fmt::join(given, ", ")),
                           "every [[wall]] has exactly one; give the other a [[wall]] of its own");
        if (wall.extrusion)
            for (std::size_t k = 0; k < wall.extrusion->points.size(); ++k)
                if (wall.extrusion->points[k].dimension() != 2)
                    complaints.add(fmt::format("{}.extrusion.points[{}]", key, k),
                                   "what is drawn along an axis is drawn in a plane: two coordinates",
                                   "(y, z) along x, (x, z) along y, (x, y) along z");
        if (complaints.touch(key) || given[0] == "points") continue;  // points are checked one by one
        const std::string table = key + "." + given[0];
        attempt(complaints, wall.stl ? table + ".file" : table,
                wall.stl
                    ? "mend the surface, say how near vertices are `weld`ed, or `closed = false` where it need not "
                      "be watertight"
                    : "see [wall." + given[0] + "] in SCENES.md",
                [&] {
                    if (scene.dimension == 2)
                        wall_surface<2>(wall, spacing_of(scene));
                    else
                        wall_surface<3>(wall, spacing_of(scene));
                });
    }
}

void validate_motions(const Scene& scene, Complaints& complaints) {
    for (std::size_t i = 0; i < scene.walls.size(); ++i) {
        const std::string key = fmt::format("wall[{}].motion", i);
        if (!scene.walls[i].motion || complaints.touch(key)) continue;
        if (scene.dimension == 2)
            validate_motion<2>(scene, *scene.walls[i].motion, key, complaints);
        else
            validate_motion<3>(scene, *scene.walls[i].motion, key, complaints);
    }
}

void validate_regions(const Scene& scene, Complaints& complaints) {
    if (!scene.fluid) return;
    for (const RegionScene& region : scene.fluid->regions) {
        if (complaints.touch(region.key)) continue;
        if (scene.dimension == 2)
            validate_region<2>(scene, region, complaints);
        else
            validate_region<3>(scene, region, complaints);
    }
}

}  // namespace aquagraph::io
