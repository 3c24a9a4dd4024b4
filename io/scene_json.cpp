#include "io/scene_json.hpp"

#include <algorithm>

#include "io/scene_words.hpp"

namespace aquagraph::io {

namespace {

using Json = nlohmann::json;

Json to_json(const Box& box) {
    return {{"min", box.min}, {"max", box.max}};
}

Json to_json(const FluidScene& fluid, int dimension) {
    const auto up = static_cast<std::size_t>(dimension - 1);
    Json json = {{"spacing", fluid.spacing},
                 {"density", fluid.density},
                 {"sound_speed", fluid.sound_speed},
                 {"polytropic_exponent", fluid.polytropic_exponent},
                 {"support_ratio", fluid.support_ratio},
                 {"cfl", fluid.cfl},
                 {"kernel", word(kernel_words, fluid.kernel)},
                 {"integration", word(integration_words, fluid.integration)},
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
    double top = 0;
    for (std::size_t k = 0; k < fluid.boxes.size(); ++k) {
        json["box"].push_back(to_json(fluid.boxes[k]));
        top = k == 0 ? fluid.boxes[k].max[up] : std::max(top, fluid.boxes[k].max[up]);
    }
    json["surface_level"] = fluid.surface_level.value_or(top);
    return json;
}

Json to_json(const SolidScene& solid) {
    Json json = {{"name", solid.name},
                 {"plane", solid.plane == PlaneCondition::strain ? "strain" : "stress"},
                 {"static_start", solid.static_start},
                 {"wet", solid.wet}};
    if (solid.box) {
        json["box"] = to_json(*solid.box);
        json["box"]["elements"] = solid.elements;
    } else {
        json["mesh"] = solid.mesh.filename().string();
    }
    json["material"] = {{"law", solid.law == MaterialLaw::neo_hookean ? "neo_hookean" : "saint_venant_kirchhoff"},
                        {"density", solid.density},
                        {"youngs_modulus", solid.youngs_modulus},
                        {"poissons_ratio", solid.poissons_ratio}};
    json["scheme"] = {{"name", solid.scheme == SolidScheme::hht ? "hht" : "newmark"}, {"alpha", solid.alpha}};
    for (const Clamp& clamp : solid.clamps) {
        Json fixed = Json::array();
        if (clamp.fixed[0]) fixed.push_back("x");
        if (clamp.fixed[1]) fixed.push_back("y");
        json["clamp"].push_back({{"set", clamp.set}, {"fixed", fixed}});
    }
    for (const Track& track : solid.tracks) json["track"].push_back({{"name", track.name}, {"point", track.point}});
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
    return {{"column", compare.column},
            {"file", compare.file.filename().string()},
            {"label", compare.label},
            {"window", compare.window},
            {"time_scale", compare.time_scale},
            {"value_scale", compare.value_scale},
            {"value_offset", compare.value_offset},
            {"error", compare.error}};
}

}  // namespace

nlohmann::json to_json(const Scene& scene) {
    Json json = {
        {"title", scene.title},
        {"dimension", scene.dimension},
        {"gravity", scene.gravity},
        {"time", {{"end", scene.end_time}}},
        {"domain", to_json(scene.domain)},
        {"output",
         {{"frame_interval", scene.output.frame_interval}, {"history_interval", scene.output.history_interval}}}};
    json["domain"]["edge"] = scene.edge == DomainEdge::closed ? "closed" : "open";
    json["domain"]["periodic"] = scene.periodic;
    if (scene.fluid) json["fluid"] = to_json(*scene.fluid, scene.dimension);
    for (const WallScene& wall : scene.walls)
        json["wall"].push_back({{"name", wall.name},
                                {"points", wall.points},
                                {"closed", wall.closed},
                                {"slip", wall.slip == Slip::free   ? "free"
                                         : wall.slip == Slip::none ? "none"
                                                                   : "symmetry"}});
    if (scene.solid) json["solid"] = to_json(*scene.solid);
    for (const ProbeScene& probe : scene.probes) json["probe"].push_back(to_json(probe));
    if (scene.fluid && scene.solid)
        json["coupling"] = {{"algorithm", scene.coupling.algorithm == CouplingAlgorithm::cps ? "cps" : "css"},
                            {"ratio", scene.coupling.ratio},
                            {"step_fraction", scene.coupling.step_fraction}};
    for (const Compare& compare : scene.comparisons) json["compare"].push_back(to_json(compare));
    return json;
}

}  // namespace aquagraph::io
