#include "io/scene_json.hpp"

#include "io/scene_solid_json.hpp"
#include "io/scene_surfaces.hpp"
#include "io/scene_words.hpp"

namespace aquagraph::io {

namespace {

using Json = nlohmann::json;

Json to_json(const Box& box) {
    return {{"min", box.min}, {"max", box.max}};
}

const char* side(geometry::FluidSide fluid) {
    return fluid == geometry::FluidSide::inside ? "inside" : "outside";
}

Json to_json(const RoundShape& round) {
    Json json = {{"centre", round.centre}, {"radius", round.radius}};
    if (round.chord_error) json["chord_error"] = *round.chord_error;
    return json;
}

Json to_json(const StlShape& stl, const char* file_key) {
    return {{file_key, stl.file.filename().string()},
            {"scale", stl.scale},
            {"axis", stl.axis},
            {"angle", stl.angle},
            {"translate", stl.translate}};
}

template <class Value>
Json to_json(const LawScene<Value>& law) {
    Json json = {{"ramp", law.ramp}};
    if (law.constant) json["velocity"] = *law.constant;
    if (law.amplitude) json.update({{"amplitude", *law.amplitude}, {"frequency", law.frequency}, {"phase", law.phase}});
    return json;
}

Json to_json(const MotionScene& motion, int dimension) {
    Json json = Json::object();
    if (!motion.table.empty())
        json = {{"table", motion.table.filename().string()}, {"after", motion.hold ? "hold" : "refuse"}};
    if (motion.translation) json["translation"] = to_json(*motion.translation);
    if (motion.rotation) {
        json["rotation"] = to_json(*motion.rotation);
        json["rotation"]["centre"] = motion.centre;
        if (dimension == 3) json["rotation"]["axis"] = motion.axis;
    }
    return json;
}

Json to_json(const WallScene& wall) {
    Json json = {{"name", wall.name}, {"slip", word(slip_words, wall.slip)}, {"force", wall.force}};
    int dimension = 3;
    if (wall.box) {
        json["box"] = to_json(wall.box->box);
        json["box"].update({{"fluid", side(wall.box->fluid)}, {"open", wall.box->open}});
        dimension = wall.box->box.min.dimension();
    } else if (wall.rectangle) {
        json["rectangle"] = {
            {"corner", wall.rectangle->corner}, {"side_a", wall.rectangle->side_a}, {"side_b", wall.rectangle->side_b}};
    } else if (wall.extrusion) {
        const ExtrusionShape& shape = *wall.extrusion;
        json["extrusion"] = {{"points", shape.points}, {"closed", shape.closed},
                             {"caps", shape.caps},     {"axis", std::string(1, char('x' + shape.axis))},
                             {"from", shape.from},     {"to", shape.to}};
    } else if (wall.round) {
        dimension = wall.round->centre.dimension();
        Json& round = json[dimension == 2 ? "circle" : "sphere"];
        round = to_json(*wall.round);
        round["fluid"] = side(wall.round->fluid);
    } else if (wall.cylinder) {
        const CylinderShape& shape = *wall.cylinder;
        json["cylinder"] = {{"from", shape.from},
                            {"to", shape.to},
                            {"radius", shape.radius},
                            {"fluid", side(shape.fluid)},
                            {"open", shape.open}};
        if (shape.chord_error) json["cylinder"]["chord_error"] = *shape.chord_error;
    } else if (wall.stl) {
        json["stl"] = to_json(*wall.stl, "file");
        json["stl"].update({{"closed", wall.stl->closed}, {"fluid", side(wall.stl->fluid)}});
    } else {
        json["points"] = wall.points;
        json["closed"] = wall.closed;
        if (!wall.points.empty()) dimension = wall.points[0].dimension();
    }
    if (wall.motion) json["motion"] = to_json(*wall.motion, dimension);
    return json;
}

Json to_json(const RegionScene& region, const FluidScene& fluid) {
    Json json = region.round ? to_json(*region.round)
                : region.stl ? to_json(*region.stl, "stl")
                             : Json{{"points", region.points}};
    json["velocity"] = region.velocity;
    json["initial_pressure"] = is_hydrostatic(region, fluid) ? "hydrostatic" : "zero";
    json["clearance"] = region.clearance;
    if (region.level) json["level"] = *region.level;
    return json;
}

Json to_json(const FluidScene& fluid, int dimension) {
    Json json = {{"spacing", fluid.spacing},
                 {"density", fluid.density},
                 {"sound_speed", fluid.sound_speed},
                 {"polytropic_exponent", fluid.polytropic_exponent},
                 {"support_ratio", fluid.support_ratio},
                 {"cfl", fluid.cfl},
                 {"kernel", word(kernel_words, fluid.kernel)},
                 {"integration", word(integration_words, fluid.integration)},
                 {"walls", fluid.walls == WallMethod::ghosts ? "ghosts" : "normal_flux"},
                 {"initial_pressure", fluid.initial_pressure == InitialPressure::hydrostatic ? "hydrostatic" : "zero"}};
    const FluidScheme& scheme = fluid.scheme;
    json["scheme"] = {{"name", word(scheme_words, scheme.name)}};
    if (scheme.name == fluid::Scheme::riemann || scheme.name == fluid::Scheme::riemann_ale) {
        json["scheme"]["reconstruction"] = scheme.reconstruction == Reconstruction::muscl ? "muscl" : "none";
        json["scheme"]["riemann_solver"] = word(riemann_solver_words, scheme.riemann_solver);
    } else {
        if (scheme.name == fluid::Scheme::delta_sph) json["scheme"]["delta"] = scheme.delta;
        json["scheme"]["alpha"] = scheme.alpha;
    }
    if (fluid.viscosity > 0)
        json["viscosity"] = {{"dynamic", fluid.viscosity},
                             {"operator", word(viscous_operator_words, fluid.viscous_operator)}};
    if (fluid.transport != fluid::Transport::none) {
        json["transport"] = {{"name", word(transport_words, fluid.transport)}};
        if (fluid.transport == fluid::Transport::x_sph) json["transport"]["epsilon"] = fluid.x_sph;
    }
    for (const WaterBox& box : fluid.boxes) {
        json["box"].push_back(to_json(box));
        json["box"].back()["velocity"] = box.velocity;
    }
    for (const RegionScene& region : fluid.regions)
        json[region.key.substr(6, region.key.find('[') - 6)].push_back(to_json(region, fluid));
    if (!fluid.regions.empty()) {
        json["relax"] = fluid.relax;
        json["relax_tolerance"] = fluid.relax_tolerance;
    }
    json["surface_level"] = surface_level(fluid, dimension);
    if (!fluid.initial.velocity.empty()) json["initial"]["velocity"] = fluid.initial.velocity;
    if (!fluid.initial.pressure.empty()) json["initial"]["pressure"] = fluid.initial.pressure;
    if (fluid.driving_force) json["driving_force"] = *fluid.driving_force;
    if (fluid.central_force)
        json["central_force"] = {{"centre", fluid.central_force->centre}, {"rate", fluid.central_force->rate}};
    return json;
}

Json to_json(const CouplingScene& coupling) {
    Json json = {{"algorithm", word(algorithm_words, coupling.algorithm)},
                 {"ratio", coupling.ratio},
                 {"ratio_control", coupling.ratio_control},
                 {"load", word(load_words, coupling.load)},
                 {"extrapolation", word(extrapolation_words, coupling.extrapolation)},
                 {"smoothing", coupling.smoothing},
                 {"step_rule", word(step_rule_words, coupling.step_rule)},
                 {"step_fraction", coupling.step_fraction}};
    if (coupling.load == coupling::LoadMethod::energy_conservative) json["energy_cycles"] = coupling.energy_cycles;
    if (coupling.algorithm == CouplingAlgorithm::iterated)
        json.update({{"relaxation", word(relaxation_words, coupling.relaxation)},
                     {"tolerance", coupling.tolerance},
                     {"most_iterations", coupling.most_iterations}});
    return json;
}

Json to_json(const ProbeScene& probe) {
    Json json = {{"name", probe.name}, {"point", probe.point}};
    switch (probe.quantity) {
        case ProbeQuantity::pressure:
            json["quantity"] = "pressure";
            break;
        case ProbeQuantity::velocity:
            json["quantity"] = "velocity";
            break;
        case ProbeQuantity::level:
            json["quantity"] = "level";
            return json;
    }
    json["interpolation"] = probe.interpolation == ProbeInterpolation::linear ? "linear" : "shepard";
    if (!probe.wall.empty()) json["wall"] = probe.wall;
    return json;
}

Json to_json(const Compare& compare) {
    Json json = {{"column", compare.column},
                 {"label", compare.label},
                 {"window", compare.window},
                 {"time_scale", compare.time_scale},
                 {"value_scale", compare.value_scale},
                 {"value_offset", compare.value_offset},
                 {"error", compare.error}};
    if (compare.formula.empty())
        json["file"] = compare.file.filename().string();
    else
        json["formula"] = compare.formula;
    if (compare.change) json["change"] = true;
    if (compare.scale) json["scale"] = *compare.scale;
    return json;
}

Json to_json(const FieldError& error) {
    Json json = {
        {"name", error.name}, {"velocity", error.velocity}, {"pressure", error.pressure}, {"where", error.where}};
    if (error.velocity_scale) json["velocity_scale"] = *error.velocity_scale;
    if (error.pressure_scale) json["pressure_scale"] = *error.pressure_scale;
    return json;
}

}  // namespace

nlohmann::json to_json(const Scene& scene) {
    Json json = {{"title", scene.title},
                 {"dimension", scene.dimension},
                 {"gravity", scene.gravity},
                 {"time", {{"end", scene.end_time}}},
                 {"domain", to_json(scene.domain)},
                 {"output",
                  {{"frame_interval", scene.output.frame_interval},
                   {"history_interval", scene.output.history_interval},
                   {"checkpoint_interval", scene.output.checkpoint_interval},
                   {"interface_loads", scene.output.interface_loads},
                   {"energy_ledger", scene.output.energy_ledger}}}};
    json["domain"]["edge"] = scene.edge == DomainEdge::closed ? "closed" : "open";
    json["domain"]["periodic"] = scene.periodic;
    if (scene.fluid) json["fluid"] = to_json(*scene.fluid, scene.dimension);
    for (const WallScene& wall : scene.walls) json["wall"].push_back(to_json(wall));
    if (scene.solid) json["solid"] = to_json(*scene.solid, scene.dimension);
    for (const ProbeScene& probe : scene.probes) json["probe"].push_back(to_json(probe));
    if (scene.fluid && scene.solid) json["coupling"] = to_json(scene.coupling);
    if (!scene.constants.empty()) json["constants"] = scene.constants;
    for (const Integral& integral : scene.integrals)
        json["integral"].push_back(
            {{"name", integral.name}, {"value", integral.value}, {"weight", integral.weight}, {"unit", integral.unit}});
    for (const Extreme& extreme : scene.extremes)
        json["extreme"].push_back({{"name", extreme.name},
                                   {"value", extreme.value},
                                   {"of", extreme.largest ? "largest" : "smallest"},
                                   {"where", extreme.where},
                                   {"unit", extreme.unit}});
    for (const FieldError& error : scene.field_errors) json["field_error"].push_back(to_json(error));
    for (const Compare& compare : scene.comparisons) json["compare"].push_back(to_json(compare));
    return json;
}

}  // namespace aquagraph::io
