#include "engine/solid_history.hpp"

#include <algorithm>
#include <memory>

#include "engine/body_parts.hpp"

namespace aquagraph::engine {

namespace {

template <int D>
void add_force_columns(HistoryPart& part, const std::string& name) {
    for (std::size_t d = 0; d < D; ++d) part.columns.push_back({name + "_force_" + "xyz"[d], per_depth<D>("N")});
}

template <int D>
HistoryPart tracks(const io::Scene& scene, const solid::Solver<D>& solid) {
    HistoryPart part;
    std::vector<std::size_t> nodes;
    for (const io::Track& track : scene.solid->tracks) {
        nodes.push_back(nearest_node(solid.mesh(), track.point));
        for (std::size_t d = 0; d < D; ++d) part.columns.push_back({track.name + "_" + "xyz"[d], "m"});
    }
    part.append = [&solid, nodes](std::vector<double>& row) {
        for (const std::size_t node : nodes)
            for (std::size_t d = 0; d < D; ++d) row.push_back(solid.displacements()[D * node + d]);
    };
    return part;
}

// Of the clamps and prescribed motions that have a name.
template <int D>
HistoryPart holding_forces(const io::Scene& scene, const solid::Solver<D>& solid) {
    HistoryPart part;
    std::vector<std::string> sets;
    const auto add = [&](const std::string& name, const std::string& set) {
        if (name.empty()) return;
        sets.push_back(set);
        add_force_columns<D>(part, name);
    };
    for (const io::Clamp& clamp : scene.solid->clamps) add(clamp.name, clamp.set);
    for (const io::NodeMotionScene& motion : scene.solid->motions) add(motion.name, motion.set);
    part.append = [&solid, sets](std::vector<double>& row) {
        for (const std::string& set : sets) {
            const auto force = solid.reaction(set);
            row.insert(row.end(), force.begin(), force.end());
        }
    };
    return part;
}

// Displacements and turns; of what is prescribed, the forces and moments that do it.
template <int D>
HistoryPart rigid_bodies(const io::Scene& scene, const solid::Solver<D>& solid) {
    HistoryPart part;
    const auto& bodies = solid.options().rigid_bodies;
    const auto turn = [](std::size_t i) { return D == 2 ? std::string() : std::string("_") + "xyz"[i - D]; };
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const std::string& name = scene.solid->rigid_bodies[b].name;
        for (std::size_t i = 0; i < solid::rigid_freedoms<D>; ++i)
            part.columns.push_back(i < D ? io::HistoryColumn{name + "_" + "xyz"[i], "m"}
                                         : io::HistoryColumn{name + "_turn" + turn(i), "rad"});
        for (std::size_t i = 0; i < solid::rigid_freedoms<D>; ++i)
            if (bodies[b].motion[i])
                part.columns.push_back(i < D ? io::HistoryColumn{name + "_force_" + "xyz"[i], per_depth<D>("N")}
                                             : io::HistoryColumn{name + "_moment" + turn(i), D == 2 ? "N" : "N m"});
    }
    part.append = [&solid, &bodies](std::vector<double>& row) {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const auto state = solid.rigid_body(b);
            row.insert(row.end(), state.displacement.begin(), state.displacement.end());
            for (std::size_t i = 0; i < solid::rigid_freedoms<D>; ++i)
                if (bodies[b].motion[i]) row.push_back(state.reaction[i]);
        }
    };
    return part;
}

template <int D>
HistoryPart contacts(const io::Scene& scene, const solid::Solver<D>& solid) {
    HistoryPart part;
    for (const io::ContactScene& contact : scene.solid->contacts) {
        add_force_columns<D>(part, contact.name);
        part.columns.push_back({contact.name + "_area", D == 2 ? "m" : "m²"});
        part.columns.push_back({contact.name + "_pressure", "Pa"});
    }
    part.append = [&solid, count = scene.solid->contacts.size()](std::vector<double>& row) {
        for (std::size_t k = 0; k < count; ++k) {
            const auto report = solid.contact(k);
            row.insert(row.end(), report.force.begin(), report.force.end());
            row.insert(row.end(), {report.area, report.largest_pressure});
        }
    };
    return part;
}

// Something else than the water's loads can do work on the body.
template <int D>
bool is_driven(const solid::Options<D>& options) {
    const auto turns_with_time = [](const auto& laws) {
        return std::any_of(laws.begin(), laws.end(), [](const TimeFunction& law) { return !law.changes.empty(); });
    };
    return !options.motions.empty() || !options.pressures.empty() || !options.rigid_bodies.empty() ||
           std::any_of(options.contacts.begin(), options.contacts.end(),
                       [&](const auto& contact) { return turns_with_time(contact.ground.displacement); });
}

}  // namespace

template <int D>
std::vector<HistoryPart> solid_columns(const io::Scene& scene, const solid::Solver<D>& solid) {
    std::vector<HistoryPart> parts{tracks(scene, solid), holding_forces(scene, solid), rigid_bodies(scene, solid),
                                   contacts(scene, solid)};
    std::erase_if(parts, [](const HistoryPart& part) { return part.columns.empty(); });
    return parts;
}

// Kinetic + strain + gravity's + contact + friction + damping + numerical energy - external work keeps its initial
// value; the residual is what this misses. Across an interface also what was dissipated in all, work of the loads minus
// what the body has gained, and the part of the external work that is not the water's.
template <int D>
HistoryPart solid_energies(const Model<D>& model, const coupling::Interface* interface) {
    const std::string unit = per_depth<D>("J");
    const solid::Solver<D>& solid = *model.solid;
    const solid::Options<D>& options = solid.options();
    const bool alone = model.structure.has_value(), moves = !alone || !model.structure->is_static;
    const bool touches = !options.contacts.empty(),
               rubs = std::any_of(options.contacts.begin(), options.contacts.end(),
                                  [](const auto&contact) { return contact.friction > 0; }),
               damped = moves && (options.mass_damping > 0 || options.stiffness_damping > 0),
               balances = moves && (alone || interface), driven = interface && is_driven(options);
    HistoryPart part;
    const auto column = [&](bool is_there, const char* name) {
        if (is_there) part.columns.push_back({name, unit});
    };
    column(moves, "solid_kinetic_energy");
    column(true, "solid_strain_energy");
    column(moves, "solid_external_work");
    column(driven, "solid_driving_work");
    column(alone || interface, "solid_gravity_energy");
    column(touches, "solid_contact_energy");
    column(interface, "solid_dissipated_energy");
    column(rubs, "solid_friction_energy");
    column(damped, "solid_damping_energy");
    column(balances, "solid_numerical_energy");
    column(balances, "solid_energy_residual");
    part.memory = std::make_shared<std::vector<double>>();  // what is kept, in the first row
    part.append = [=, &solid, initial = part.memory](std::vector<double>& row) {
        const solid::Energies e = solid.energies();
        if (moves) row.push_back(e.kinetic);
        row.push_back(e.strain);
        if (moves) row.push_back(e.external_work);
        if (driven) row.push_back(e.external_work - e.load_work);
        if (alone || interface) row.push_back(e.gravity_potential);
        if (touches) row.push_back(e.contact);
        if (interface) row.push_back(e.external_work - (e.stored() - interface->energy.solid_at_start));
        if (rubs) row.push_back(e.friction);
        if (damped) row.push_back(e.damping);
        if (!balances) return;
        const double kept = e.stored() + e.friction + e.damping + e.numerical - e.external_work;
        if (initial->empty()) initial->push_back(kept);
        row.insert(row.end(), {e.numerical, kept - initial->front()});
    };
    return part;
}

#define AQUAGRAPH_INSTANTIATE(D)                                                                \
    template std::vector<HistoryPart> solid_columns(const io::Scene&, const solid::Solver<D>&); \
    template HistoryPart solid_energies(const Model<D>&, const coupling::Interface*);
AQUAGRAPH_INSTANTIATE(2)
AQUAGRAPH_INSTANTIATE(3)
#undef AQUAGRAPH_INSTANTIATE

}  // namespace aquagraph::engine
