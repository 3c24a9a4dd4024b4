#include "engine/frames.hpp"

#include <array>
#include <cmath>

#include "io/vtk_hdf.hpp"

namespace aquagraph::engine {

template <int D>
void write_fluid_frame(const std::filesystem::path& file, const fluid::Fluid<D>& fluid, double time) {
    const auto& s = fluid.particles;
    const auto part = [&](const fluid::Scalars& values) { return std::span<const double>(values.data(), s.count); };
    std::vector<double> density(s.count);
    for (std::size_t i = 0; i < s.count; ++i) density[i] = fluid.tait.reference_density + s.deviation[i];
    io::VtkArray velocity{"velocity", {}};
    for (const auto& component : s.v) velocity.components.push_back(part(component));
    io::VtkFrame frame;
    frame.x = part(s.x[0]);
    frame.y = part(s.x[1]);
    if constexpr (D == 3) frame.z = part(s.x[2]);
    frame.time = time;
    frame.precision = io::Precision::float32;
    frame.point_arrays = {{"pressure", {part(s.p)}},
                          std::move(velocity),
                          {"density", {std::span<const double>(density)}},
                          {"volume", {part(s.volume)}},
                          {"fullness", {part(s.fullness)}},
                          {"id", {std::span<const std::int64_t>(s.id.data(), s.count)}}};
    io::write_vtk_hdf(file, frame);
}

namespace {

template <int D>
io::CellType cell_type(const solid::Element& element) {
    if (D == 2) return element.size() == 4 ? io::CellType::quad : io::CellType::quadratic_quad;
    return element.size() == 8    ? io::CellType::hexahedron
           : element.size() == 10 ? io::CellType::quadratic_tetra
                                  : io::CellType::quadratic_hexahedron;
}

}  // namespace

template <int D>
void write_solid_frame(const std::filesystem::path& file, const solid::Solver<D>& solver, double time) {
    const std::size_t nodes = solver.mesh().nodes.size();
    using Components = std::array<std::vector<double>, D>;
    const auto components = [&](std::span<const double> values) {
        Components parts;
        for (std::size_t d = 0; d < D; ++d)
            for (std::size_t n = 0; n < nodes; ++n) parts[d].push_back(values[D * n + d]);
        return parts;
    };
    const Components x = components(solver.positions()), u = components(solver.displacements()),
                     v = components(solver.velocities());
    std::vector<double> stress(solver.mesh().elements.size());
    solver.element_stress(stress);
    std::vector<std::int32_t> connectivity;
    for (const auto& element : solver.mesh().elements)
        connectivity.insert(connectivity.end(), element.begin(), element.end());
    const auto vector = [](const std::string& name, const Components& parts) {
        io::VtkArray array{name, {}};
        for (const auto& part : parts) array.components.push_back(std::span<const double>(part));
        return array;
    };
    io::VtkFrame frame;
    frame.x = x[0];
    frame.y = x[1];
    if constexpr (D == 3) frame.z = x[2];
    frame.time = time;
    frame.cell_type = cell_type<D>(solver.mesh().elements.front());
    frame.connectivity = connectivity;
    frame.point_arrays = {vector("displacement", u), vector("velocity", v)};
    frame.cell_arrays = {{"von_mises_stress", {std::span<const double>(stress)}}};
    io::write_vtk_hdf(file, frame);
}

template void write_solid_frame(const std::filesystem::path&, const solid::Solver<2>&, double);
template void write_solid_frame(const std::filesystem::path&, const solid::Solver<3>&, double);
template void write_fluid_frame(const std::filesystem::path&, const fluid::Fluid<2>&, double);
template void write_fluid_frame(const std::filesystem::path&, const fluid::Fluid<3>&, double);

}  // namespace aquagraph::engine
