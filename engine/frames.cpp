#include "engine/frames.hpp"

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

void write_solid_frame(const std::filesystem::path& file, const solid::Solver& solver, double time) {
    const std::size_t nodes = solver.mesh().nodes.size();
    const auto component = [&](std::span<const double> values, std::size_t d) {
        std::vector<double> one(nodes);
        for (std::size_t n = 0; n < nodes; ++n) one[n] = values[2 * n + d];
        return one;
    };
    const auto x = component(solver.positions(), 0), y = component(solver.positions(), 1),
               ux = component(solver.displacements(), 0), uy = component(solver.displacements(), 1),
               vx = component(solver.velocities(), 0), vy = component(solver.velocities(), 1);
    std::vector<double> stress(solver.mesh().elements.size());
    solver.element_stress(stress);
    std::vector<std::int32_t> connectivity;
    for (const auto& element : solver.mesh().elements)
        connectivity.insert(connectivity.end(), element.begin(), element.end());
    const auto array = [](const std::vector<double>& v) { return io::VtkValues(std::span<const double>(v)); };
    io::VtkFrame frame;
    frame.x = x;
    frame.y = y;
    frame.time = time;
    frame.cell_type = io::CellType::quadratic_quad;
    frame.connectivity = connectivity;
    frame.point_arrays = {{"displacement", {array(ux), array(uy)}}, {"velocity", {array(vx), array(vy)}}};
    frame.cell_arrays = {{"von_mises_stress", {array(stress)}}};
    io::write_vtk_hdf(file, frame);
}

template void write_fluid_frame(const std::filesystem::path&, const fluid::Fluid<2>&, double);
template void write_fluid_frame(const std::filesystem::path&, const fluid::Fluid<3>&, double);

}  // namespace aquagraph::engine
