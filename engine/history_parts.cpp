#include "engine/history_parts.hpp"

#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "engine/field_columns.hpp"
#include "engine/solid_history.hpp"

namespace aquagraph::engine {

namespace {

HistoryPart interface_force(const io::Scene& scene, const coupling::Interface& interface) {
    return {{{scene.solid->name + "_force_x", "N/m"}, {scene.solid->name + "_force_y", "N/m"}},
            [&interface](std::vector<double>& row) {
                row.insert(row.end(), {interface.force[0], interface.force[1]});
            }};
}

// What the fluid has computed for the end of the cycle.
HistoryPart interface_loads(const io::Scene& scene, const Model<2>& model) {
    std::set<int> nodes;
    for (const std::string& surface : scene.solid->wet)
        for (const solid::Facet& edge : model.solid->mesh().surface(surface)) nodes.insert(edge.begin(), edge.end());
    HistoryPart part;
    for (const int node : nodes)
        for (const char* direction : {"x", "y"})
            part.columns.push_back({"load_" + std::to_string(node + 1) + "_" + direction, "N/m"});
    part.append = [&loads = model.interface->fluid_loads, nodes](std::vector<double>& row) {
        for (const int node : nodes)
            for (std::size_t d = 0; d < 2; ++d) row.push_back(loads[2 * std::size_t(node) + d]);
    };
    return part;
}

// Kinetic and potential, of a central force too.
template <int D>
fluid::FluidEnergies energies_of(const Model<D>& model) {
    const fluid::Fluid<D>& fluid = *model.fluid;
    fluid::FluidEnergies sum = total_energies(fluid);
    for (std::size_t block = 0; model.central_force && block < fluid.blocks(); ++block)
        sum.potential += potential_energy(fluid.particles, *model.central_force, fluid.lanes(block));
    return sum;
}

template <int D>
HistoryPart fluid_energies(const Model<D>& model) {
    return {{{"fluid_kinetic_energy", per_depth<D>("J")}, {"fluid_potential_energy", per_depth<D>("J")}},
            [&model](std::vector<double>& row) {
                const fluid::FluidEnergies sum = energies_of(model);
                row.insert(row.end(), {sum.kinetic, sum.potential});
            }};
}

// The balance: kinetic + potential + compression + dissipated + viscous + lost energy - its initial value = wall work,
// and the residual is what this misses. Walls of normal fluxes have a defect besides (walls/normal_flux.hpp).
template <int D>
HistoryPart energy_balance(const Model<D>& model) {
    const std::string unit = per_depth<D>("J");
    auto initial = std::make_shared<std::vector<double>>();  // of the first row
    std::vector<io::HistoryColumn> columns{{"fluid_compression_energy", unit}, {"fluid_dissipated_energy", unit},
                                           {"fluid_viscous_heat", unit},       {"fluid_lost_energy", unit},
                                           {"fluid_wall_work", unit},          {"fluid_energy_residual", unit}};
    if (model.flux_walls) columns.push_back({"flux_wall_defect", unit});
    return {columns,
            [&model, initial](std::vector<double>& row) {
                const fluid::EnergyLedger& ledger = model.fluid->ledger;
                const fluid::FluidEnergies state = energies_of(model);
                const double now = state.kinetic + state.potential;
                if (initial->empty()) initial->push_back(now);
                const double lost = ledger.lost + ledger.sum.displacement;
                const double residual = now - initial->front() + ledger.sum.compression + ledger.sum.dissipation +
                                        ledger.sum.viscous + ledger.sum.defect + lost - ledger.sum.walls;
                row.insert(row.end(), {ledger.sum.compression, ledger.sum.dissipation, ledger.sum.viscous, lost,
                                       ledger.sum.walls, residual});
                if (model.flux_walls) row.push_back(ledger.sum.defect);
            },
            initial};
}

// E_fluid/body, E_Interface; E_body/fluid is the body's column among the works of walls.
HistoryPart interface_energies(const coupling::Interface& interface) {
    HistoryPart part{{{"interface_from_body_energy", "J/m"}, {"interface_energy", "J/m"}}, {}};
    const bool corrected = interface.method == coupling::LoadMethod::energy_conservative;
    if (corrected) part.columns.push_back({"load_correction", ""});
    part.append = [&interface, corrected](std::vector<double>& row) {
        row.insert(row.end(), {interface.energy.from_body, interface.energy.of_interface()});
        if (corrected) row.push_back(interface.correction.epsilon);
    };
    return part;
}

// Water and body together, without what both have dissipated: the rigid walls' work, that of what else drives the body
// and E_Interface are all that can change it, and the residual is what this misses.
HistoryPart total_balance(const Model<2>& model) {
    auto initial = std::make_shared<std::vector<double>>();  // of the first row
    return {{{"total_energy_change", "J/m"}, {"total_energy_residual", "J/m"}},
            [&model, initial](std::vector<double>& row) {
                const fluid::EnergyLedger& ledger = model.fluid->ledger;
                const fluid::FluidEnergies state = energies_of(model);
                const solid::Energies body = model.solid->energies();
                const double now = state.kinetic + state.potential + ledger.sum.compression + ledger.sum.displacement +
                                   ledger.lost + body.stored();
                if (initial->empty()) initial->push_back(now);
                const coupling::InterfaceEnergy& interface = model.interface->energy;
                const double dissipated = ledger.sum.dissipation + ledger.sum.viscous + ledger.sum.defect +
                                          body.external_work - (body.stored() - interface.solid_at_start),
                             rigid = ledger.sum.walls - interface.to_fluid,
                             driving = body.external_work - body.load_work;
                row.insert(row.end(), {now - initial->front(), now - initial->front() + dissipated - rigid - driving -
                                                                   interface.of_interface()});
            },
            initial};
}

HistoryPart ratio(const coupling::RatioControl& control) {
    return {{{"coupling_ratio", ""}}, [&control](std::vector<double>& row) { row.push_back(control.p); }};
}

template <int D>
HistoryPart particle_figures(const fluid::Fluid<D>& fluid) {
    return {{{"particles", ""}, {"fastest_particle", "m/s"}}, [&fluid](std::vector<double>& row) {
                const auto& particles = fluid.particles;
                double fastest2 = 0;
                for (std::size_t i = 0; i < particles.count; ++i) {
                    double v2 = 0;
                    for (std::size_t d = 0; d < D; ++d) v2 += particles.v[d][i] * particles.v[d][i];
                    fastest2 = std::max(fastest2, v2);
                }
                row.insert(row.end(), {double(particles.count), std::sqrt(fastest2)});
            }};
}

// Columns that the scene asks for by formula.
template <int D>
HistoryPart fields(const io::Scene& scene, const Model<D>& model) {
    auto columns = std::make_shared<FieldColumns>(scene);
    return {columns->columns(), [&model, columns](std::vector<double>& row) {
                columns->append(model.fluid->particles, model.fluid->tait, model.clock.time, row);
            }};
}

}  // namespace

template <int D>
std::vector<HistoryPart> history_parts(const io::Scene& scene, const Model<D>& model) {
    std::vector<HistoryPart> parts;
    parts.push_back({{{"time", "s"}, {"step_size", "s"}}, [&clock = model.clock](std::vector<double>& row) {
                         row.insert(row.end(), {clock.time, clock.step});
                     }});
    if (model.solid)
        for (HistoryPart& part : solid_columns(scene, *model.solid)) parts.push_back(std::move(part));
    if (model.interface) parts.push_back(interface_force(scene, *model.interface));
    if (model.fluid) parts.push_back(fluid_energies(model));
    if (model.fluid && model.fluid->ledger.kept) parts.push_back(energy_balance(model));
    for (const fluid::WallWork<D>& work : model.wall_works)
        parts.push_back({{{work.name + "_work", per_depth<D>("J")}},
                         [&work](std::vector<double>& row) { row.push_back(work.ledger.sum.walls); }});
    const coupling::Interface* interface = model.interface ? &*model.interface : nullptr;
    if (interface && interface->keeps_energy) parts.push_back(interface_energies(*interface));
    if (model.solid) parts.push_back(solid_energies(model, interface && interface->keeps_energy ? interface : nullptr));
    if constexpr (D == 2)
        if (interface && interface->keeps_energy && model.fluid->ledger.kept) parts.push_back(total_balance(model));
    if (interface && scene.coupling.algorithm == io::CouplingAlgorithm::iterated)
        parts.push_back(
            {{{"coupling_iterations", ""}, {"coupling_residual", ""}}, [interface](std::vector<double>& row) {
                 row.insert(row.end(),
                            {double(interface->fixed_point.iterations()), interface->fixed_point.residual()});
             }});
    if (interface && interface->ratio.regulated) parts.push_back(ratio(interface->ratio));
    if constexpr (D == 2)
        if (scene.output.interface_loads) parts.push_back(interface_loads(scene, model));
    if (model.fluid) parts.push_back(particle_figures(*model.fluid));
    if (model.fluid && !FieldColumns(scene).columns().empty()) parts.push_back(fields(scene, model));
    return parts;
}

template std::vector<HistoryPart> history_parts(const io::Scene&, const Model<2>&);
template std::vector<HistoryPart> history_parts(const io::Scene&, const Model<3>&);

}  // namespace aquagraph::engine
