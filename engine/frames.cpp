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

template <int D>
using Components = std::array<std::vector<double>, D>;

template <int D>
Components<D> components(std::span<const double> interleaved) {
    Components<D> parts;
    for (std::size_t k = 0; k < interleaved.size(); ++k) parts[k % D].push_back(interleaved[k]);
    return parts;
}

// Views of the parts, hence not of some that are about to go.
template <int D>
io::VtkArray vector_array(const std::string& name, Components<D>&& parts) = delete;
template <int D>
io::VtkArray vector_array(const std::string& name, const Components<D>& parts) {
    io::VtkArray array{name, {}};
    for (const auto& part : parts) array.components.push_back(std::span<const double>(part));
    return array;
}

// Fields at the nodes where they are now.
template <int D>
void write_on_nodes(const std::filesystem::path& file, const solid::Solver<D>& solver, double time,
                    std::vector<io::VtkArray> point_arrays, std::vector<io::VtkArray> cell_arrays) {
    const Components<D> x = components<D>(solver.positions());
    std::vector<std::int32_t> connectivity;
    for (const auto& element : solver.mesh().elements)
        connectivity.insert(connectivity.end(), element.begin(), element.end());
    io::VtkFrame frame;
    frame.x = x[0];
    frame.y = x[1];
    if constexpr (D == 3) frame.z = x[2];
    frame.time = time;
    frame.cell_type = cell_type<D>(solver.mesh().elements.front());
    frame.connectivity = connectivity;
    frame.point_arrays = std::move(point_arrays);
    frame.cell_arrays = std::move(cell_arrays);
    io::write_vtk_hdf(file, frame);
}

}  // namespace

template <int D>
void write_solid_frame(const std::filesystem::path& file, const solid::Solver<D>& solver, double time) {
    const Components<D> u = components<D>(solver.displacements()), v = components<D>(solver.velocities());
    std::vector<double> stress(solver.mesh().elements.size());
    solver.element_stress(stress);
    std::vector<io::VtkArray> fields{vector_array<D>("displacement", u), vector_array<D>("velocity", v)};
    std::vector<double> pressure;
    if (!solver.options().contacts.empty()) {
        pressure.resize(solver.mesh().nodes.size());
        solver.contact_pressure(pressure);
        fields.push_back({"contact_pressure", {std::span<const double>(pressure)}});
    }
    write_on_nodes(file, solver, time, std::move(fields), {{"von_mises_stress", {std::span<const double>(stress)}}});
}

template <int D>
void write_mode_frame(const std::filesystem::path& file, const solid::Solver<D>& solver, const solid::NaturalMode& mode,
                      int number) {
    const Components<D> shape = components<D>(mode.shape), u = components<D>(solver.displacements());
    write_on_nodes(file, solver, number, {vector_array<D>("mode_shape", shape), vector_array<D>("displacement", u)},
                   {});
}

template void write_mode_frame(const std::filesystem::path&, const solid::Solver<2>&, const solid::NaturalMode&, int);
template void write_mode_frame(const std::filesystem::path&, const solid::Solver<3>&, const solid::NaturalMode&, int);
template void write_solid_frame(const std::filesystem::path&, const solid::Solver<2>&, double);
template void write_solid_frame(const std::filesystem::path&, const solid::Solver<3>&, double);
template void write_fluid_frame(const std::filesystem::path&, const fluid::Fluid<2>&, double);
template void write_fluid_frame(const std::filesystem::path&, const fluid::Fluid<3>&, double);

}  // namespace aquagraph::engine
