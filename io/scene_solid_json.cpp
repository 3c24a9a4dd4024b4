#include "io/scene_solid_json.hpp"

#include <utility>

#include "io/scene_words.hpp"

namespace aquagraph::io {

namespace {

using Json = nlohmann::json;

Json to_json(const MaterialScene& material) {
    Json json = {{"law", word(material_law_words, material.law)}, {"density", material.density}};
    if (material.law == solid::MaterialLaw::mooney_rivlin)
        json.update({{"c10", material.c10}, {"c01", material.c01}, {"bulk_modulus", material.bulk_modulus}});
    else if (material.law == solid::MaterialLaw::uniaxial_curve)
        json.update({{"curve", material.curve_file.filename().string()}, {"poissons_ratio", material.poissons_ratio}});
    else
        json.update({{"youngs_modulus", material.youngs_modulus}, {"poissons_ratio", material.poissons_ratio}});
    return json;
}

void put(Json& json, const LoadHistory& factor) {
    if (!factor.formula.empty()) json["factor"] = factor.formula;
    if (!factor.table.empty()) json["table"] = factor.table.filename().string();
}

void put(Json& json, const TimeLawScene& law) {
    if (law.value != 0) json["value"] = law.value;
    if (law.rate != 0) json["rate"] = law.rate;
    if (law.amplitude != 0)
        json.update({{"amplitude", law.amplitude}, {"frequency", law.frequency}, {"phase", law.phase}});
    if (law.ramp > 0) json["ramp"] = law.ramp;
    if (!law.points.empty()) json["points"] = law.points;
    if (!law.table.empty()) json["table"] = law.table.filename().string();
}

Json to_json(const ContactScene& contact) {
    const bool plane = contact.shape == solid::GroundShape::plane;
    Json json = {{"name", contact.name},
                 {"surface", contact.surface},
                 {"shape", word(ground_words, contact.shape)},
                 {"point", contact.point},
                 {"friction", contact.friction}};
    if (contact.direction) json[plane ? "normal" : "axis"] = *contact.direction;
    if (!plane) json.update({{"radius", contact.radius}, {"hollow", contact.hollow}});
    if (contact.penalty) json["penalty"] = *contact.penalty;
    return json;
}

Json to_json(const CordsScene& cords) {
    Json json = {{"modulus", cords.modulus},
                 {"section", cords.section},
                 {"spacing", cords.spacing},
                 {"thickness", cords.thickness},
                 {"angles", cords.angles}};
    if (!cords.set.empty()) json["set"] = cords.set;
    if (cords.axis) json["axis"] = *cords.axis;
    if (cords.axis_point) json["axis_point"] = *cords.axis_point;
    if (cords.along) json["along"] = *cords.along;
    if (cords.normal) json["normal"] = *cords.normal;
    return json;
}

// What moves, presses and reinforces the body.
void put_conditions(Json& json, const SolidScene& solid, int dimension) {
    if (solid.mass_damping > 0 || solid.stiffness_damping > 0)
        json["damping"] = {{"mass", solid.mass_damping}, {"stiffness", solid.stiffness_damping}};
    for (const CordsScene& cords : solid.cords) json["cords"].push_back(to_json(cords));
    const auto with_law = [&json](const char* list, const auto& entry, Json made) {
        put(made, entry.law);
        json[list].push_back(std::move(made));
    };
    for (const NodeMotionScene& motion : solid.motions) {
        with_law("motion", motion, {{"set", motion.set}, {"along", word(direction_words, motion.along)}});
        if (!motion.name.empty()) json["motion"].back()["name"] = motion.name;
    }
    for (const PressureScene& pressure : solid.pressures)
        with_law("pressure", pressure, {{"surface", pressure.surface}});
    for (const RigidBodyScene& body : solid.rigid_bodies) {
        json["rigid_body"].push_back({{"name", body.name}, {"set", body.set}, {"mass", body.mass}});
        if (body.point) json["rigid_body"].back()["point"] = *body.point;
        if (!body.inertia.empty()) json["rigid_body"].back()["inertia"] = body.inertia;
    }
    const auto freedom = [dimension](int k) {
        return dimension == 2 ? word(plane_freedom_words, k) : word(freedom_words, k);
    };
    for (const RigidFreedomScene& entry : solid.rigid_motions)
        with_law("rigid_motion", entry, {{"body", entry.body}, {"freedom", freedom(entry.freedom)}});
    for (const RigidFreedomScene& entry : solid.rigid_loads)
        with_law("rigid_load", entry, {{"body", entry.body}, {"freedom", freedom(entry.freedom)}});
    for (const ContactScene& contact : solid.contacts) json["contact"].push_back(to_json(contact));
    for (const GroundMotionScene& motion : solid.ground_motions)
        with_law("ground_motion", motion,
                 {{"contact", motion.contact}, {"along", word(direction_words, motion.along)}});
}

}  // namespace

nlohmann::json to_json(const SolidScene& solid, int dimension) {
    Json json = {{"name", solid.name}, {"static_start", solid.static_start}, {"wet", solid.wet}};
    if (solid.velocity) json["velocity"] = *solid.velocity;
    if (solid.solver != SolidSolver::built_in) {
        json["solver"] = word(solid_solver_words, solid.solver);
        json["program"] = solid.program;
    }
    if (dimension == 2) json["plane"] = word(plane_words, solid.plane);
    if (solid.box) {
        json["box"] = {{"min", solid.box->min}, {"max", solid.box->max}};
        json["box"]["elements"] = std::vector(solid.elements.begin(), solid.elements.begin() + dimension);
    } else {
        json["mesh"] = solid.mesh.filename().string();
    }
    json["order"] = solid.element_order;
    json["integration"] = word(integration_points_words, solid.integration);
    json["material"] = to_json(solid.material);
    for (const PartScene& part : solid.parts) {
        json["part"].push_back(to_json(part.material));
        json["part"].back()["set"] = part.set;
    }
    if (solid.is_static)
        json["scheme"] = {{"name", "static"}};
    else
        json["scheme"] = {{"name", word(solid_scheme_words, solid.scheme)}};
    if (!solid.is_static && solid.scheme != solid::Scheme::central_difference) json["scheme"]["alpha"] = solid.alpha;
    if (solid.step > 0) json["scheme"]["step"] = solid.step;
    for (const Clamp& clamp : solid.clamps) {
        Json fixed = Json::array();
        for (std::size_t d = 0; d < 3; ++d)
            if (clamp.fixed[d]) fixed.push_back(std::string(1, "xyz"[d]));
        json["clamp"].push_back({{"set", clamp.set}, {"fixed", fixed}});
        if (!clamp.name.empty()) json["clamp"].back()["name"] = clamp.name;
    }
    for (const TractionScene& traction : solid.tractions) {
        json["traction"].push_back({{"surface", traction.surface}, {"value", traction.value}});
        put(json["traction"].back(), traction.factor);
    }
    for (const ForceScene& force : solid.forces) {
        json["force"].push_back({{"value", force.value}});
        if (force.point)
            json["force"].back()["point"] = *force.point;
        else
            json["force"].back()["set"] = force.set;
        put(json["force"].back(), force.factor);
    }
    put_conditions(json, solid, dimension);
    for (const Track& track : solid.tracks) json["track"].push_back({{"name", track.name}, {"point", track.point}});
    return json;
}

}  // namespace aquagraph::io
