#include "io/scene_solid_keys.hpp"

#include <array>
#include <vector>

#include "io/scene_time_law.hpp"
#include "io/value_ranges.hpp"

namespace aquagraph::io {
namespace {

using namespace ranges;

constexpr auto sections = std::to_array<SceneSection>({
    {"solid", false, false,
     "The elastic body: finite elements. Without it the scene is a fluid alone; without [fluid] the body is computed "
     "alone, at rest or in motion. With water it is two-dimensional so far."},
    {"solid.box", false, false,
     "A rectangle of quadrilaterals, with the node sets and surfaces left, right, bottom and top; in three dimensions "
     "a box of hexahedra, with front (least y) and back too."},
    {"solid.material", false, false, "What the body is made of. Needed with [solid]."},
    {"solid.part", true, false, "Elements of another material than the rest: the same keys as [solid.material]."},
    {"solid.scheme", false, false, "How the body is taken through time."},
    {"solid.clamp", true, false, "Nodes that do not move."},
    {"solid.traction", true, false,
     "A load on a surface. It keeps its direction, and its size per area of the body at rest, however the body bends."},
    {"solid.force", true, false, "A force on nodes, either of a set or the one nearest to a point."},
    {"solid.damping", false, false,
     "Rayleigh's damping, of the mass and of the stiffness: a mode of circular frequency ω is damped by α/(2ω) + βω/2 "
     "of the critical value. The stiffness is that of the body at rest, carried along by its rotation, so that a body "
     "that turns is not braked by it."},
    {"solid.cords", true, false,
     "Parallel cords in a layer of rubber (neo_hookean or mooney_rivlin), in three dimensions: a ply of a tyre.", false,
     true},
    {"solid.motion", true, false,
     "Nodes that are displaced along a direction as prescribed: by the sum of what is given."},
    {"solid.pressure", true, false,
     "A pressure that stays normal to the surface and counts per area as it is now, towards the body: inflation."},
    {"solid.rigid_body", true, false,
     "Nodes that move as one rigid body, a wheel's rim. Its freedoms are free unless a [[solid.rigid_motion]] "
     "prescribes them. Columns of history.csv: `NAME_x[m]` and so on, `NAME_turn[rad]` (in three dimensions "
     "`NAME_turn_x[rad]` …); of what is prescribed `NAME_force_x` …, `NAME_moment` (`NAME_moment_x` …), acting on the "
     "body."},
    {"solid.rigid_motion", true, false, "What a freedom of a rigid body is made to do: the sum of what is given."},
    {"solid.rigid_load", true, false, "A force or a moment on a rigid body: the sum of what is given."},
    {"solid.contact", true, false,
     "A surface of the body and rigid ground, which it cannot pass through (by penalty), with Coulomb's friction. "
     "Columns of history.csv: `NAME_force_x` …, on the body, `NAME_area` and `NAME_pressure`, the largest; frames have "
     "the field contact_pressure."},
    {"solid.ground_motion", true, false, "The ground of a contact moves as prescribed: by the sum of what is given."},
    {"solid.track", true, false,
     "Points whose displacement goes into history.csv as NAME_x[m], NAME_y[m] and, in three dimensions, NAME_z[m]."},
});

using K = KeyKind;
constexpr auto body_keys = std::to_array<SceneKey>({
    {"solid", "name", K::text, false, "", any, "", "solid", "letters, digits and _, beginning with a letter"},
    {"solid", "solver", K::choice, false, "", any, "built_in calculix", "built_in",
     "who computes the body: this program, or CalculiX, started once per step (slow; quadratic quadrilaterals in plane "
     "strain and hexahedra, integration = full)"},
    {"solid", "program", K::text, false, "", any, "", "ccx",
     "CalculiX; looked for in PATH, with a slash seen from the scene's folder"},
    {"solid", "mesh", K::text, false, "", any, "", "none",
     "Gmsh file (.msh, 4.1 or 2.2, ASCII) or CalculiX or Abaqus deck (.inp), seen from the scene's folder; either this "
     "or [solid.box]. Physical groups, NSET, ELSET and SURFACE become sets of these names"},
    {"solid", "order", K::integer, false, "", closed(1, 2), "", "2",
     "of boxes and Gmsh files. 2: elements of 8 nodes, in three dimensions 20 or 10, made where the mesh has none on "
     "its edges; 1: of 4 or 8, with enhanced strains so that they do not lock"},
    {"solid", "integration", K::choice, false, "", any, "reduced full", "reduced",
     "Gauss points of quadratic elements: 2 each way, which do not lock, or 3"},
    {"solid", "plane", K::choice, false, "", any, "strain stress", "strain",
     "what holds across the plane, in two dimensions"},
    {"solid", "static_start", K::boolean, false, "", any, "", "false",
     "start from the equilibrium under its own weight and its loads at t = 0, without the water"},
    {"solid", "velocity", K::point, false, "m/s", any, "", "[0, 0]", "of the whole body at the start"},
    {"solid", "wet", K::texts, false, "", any, "", "none",
     "surface sets that touch the water; needed where the scene has water"},

    {"solid.box", "min", K::point, true, "m", any, "", "", "lower left corner"},
    {"solid.box", "max", K::point, true, "m", any, "", "", "upper right corner"},
    {"solid.box", "elements", K::counts, true, "", at_least_one, "", "",
     "number along x, along y and, in three dimensions, along z"},
});

// What a material is made of: of the body, and of a part.
std::vector<SceneKey> material_keys(std::string_view section) {
    return {
        {section, "law", K::choice, false, "", any,
         "saint_venant_kirchhoff linear neo_hookean mooney_rivlin uniaxial_curve", "saint_venant_kirchhoff",
         "stress from strain: the first for large rotations and small strains, linear for small "
         "displacements only, the others for rubber, the last from a measured curve"},
        {section, "density", K::number, true, "kg/m³", positive, "", "", "ρ of the body at rest"},
        {section, "youngs_modulus", K::number, false, "Pa", positive, "",
         "needed but for mooney_rivlin and uniaxial_curve", "E at small strain"},
        {section, "poissons_ratio", K::number, false, "", open(-1, 0.5), "", "needed but for mooney_rivlin",
         "ν at small strain"},
        {section, "c10", K::number, false, "Pa", positive, "", "needed for mooney_rivlin",
         "C10 of W = C10 (Ī1 - 3) + C01 (Ī2 - 3) + κ/2 (J - 1)²"},
        {section, "c01", K::number, false, "Pa", not_negative, "", "0", "C01; the shear modulus is 2 (C10 + C01)"},
        {section, "bulk_modulus", K::number, false, "Pa", positive, "", "needed for mooney_rivlin", "κ"},
        {section, "curve", K::text, false, "", any, "", "needed for uniaxial_curve",
         "file of two columns, seen from the scene's folder: strain, and force per area at rest [Pa] of a strip that "
         "is pulled"},
    };
}

constexpr auto condition_keys = std::to_array<SceneKey>({
    {"solid.scheme", "name", K::choice, false, "", any, "hht newmark central_difference static", "hht",
     "Hilber–Hughes–Taylor, or Newmark with the same β and γ; central differences, explicit; static: an equilibrium at "
     "the end of every step, without water"},
    {"solid.scheme", "alpha", K::number, false, "", open_below(-1.0 / 3, 0), "", "-0.3",
     "αs, numerical damping of high frequencies: 0 none"},
    {"solid.scheme", "step", K::number, false, "s", positive, "",
     "static: the end time; central differences: 0.9 of the critical step",
     "largest time step, needed for a motion without water; with water the coupling cycle is the step, central "
     "differences making as many in it as are stable"},

    {"solid.clamp", "name", K::text, false, "", any, "", "none",
     "of columns NAME_force_x[N] … of history.csv: the force that holds the nodes there"},
    {"solid.clamp", "set", K::text, true, "", any, "", "", "node set: of a box left, right, bottom, top (front, back)"},
    {"solid.clamp", "fixed", K::texts, false, "", any, "", "all directions",
     "which displacements are zero: [\"x\", \"y\"]"},

    {"solid.traction", "surface", K::text, true, "", any, "", "", "surface set: of a box left, right, bottom, top …"},
    {"solid.traction", "value", K::point, true, "N/m²", any, "", "", "force per area of the body at rest"},
    {"solid.traction", "factor", K::formula, false, "", any, "", "1",
     "of `t`, multiplies the value: \"sin(2*pi*50*t)\""},
    {"solid.traction", "table", K::text, false, "", any, "", "none",
     "instead of `factor`: a file of two columns, time [s] and factor, seen from the scene's folder; straight lines in "
     "between, constant outside"},

    {"solid.force", "set", K::text, false, "", any, "", "none", "node set; its nodes share the force evenly"},
    {"solid.force", "point", K::point, false, "m", any, "", "none", "at rest; the nearest node bears the force"},
    {"solid.force", "value", K::point, true, "N", any, "", "",
     "the whole force; in two dimensions on a metre of depth"},
    {"solid.force", "factor", K::formula, false, "", any, "", "1", "of `t`, multiplies the value: \"sin(2*pi*50*t)\""},
    {"solid.force", "table", K::text, false, "", any, "", "none",
     "instead of `factor`: a file of two columns, time [s] and factor, seen from the scene's folder; straight lines in "
     "between, constant outside"},

    {"solid.track", "name", K::text, true, "", any, "", "",
     "letters, digits and _, beginning with a letter; each once"},
    {"solid.track", "point", K::point, true, "m", any, "", "", "at rest; the nearest node is taken"},

    {"solid.damping", "mass", K::number, false, "1/s", not_negative, "", "0", "α"},
    {"solid.damping", "stiffness", K::number, false, "s", not_negative, "", "0", "β"},

    {"solid.cords", "set", K::text, false, "", any, "", "the body's own material", "of the [[solid.part]]"},
    {"solid.cords", "modulus", K::number, true, "Pa", positive, "", "",
     "of a cord in tension; it bears no compression"},
    {"solid.cords", "section", K::number, true, "m²", positive, "", "", "area of one cord"},
    {"solid.cords", "spacing", K::number, true, "m", positive, "", "", "between cords"},
    {"solid.cords", "thickness", K::number, true, "m", positive, "", "", "of the layer that the elements stand for"},
    {"solid.cords", "angles", K::numbers, true, "rad", any, "", "",
     "of each family of cords, from the layer's reference direction, by the right hand about its normal"},
    {"solid.cords", "axis", K::point, false, "", any, "", "none",
     "the layer lies around this axis: reference direction around it, normal away from it"},
    {"solid.cords", "axis_point", K::point, false, "m", any, "", "[0, 0, 0]", "on the axis"},
    {"solid.cords", "along", K::point, false, "", any, "", "[1, 0, 0]",
     "without an axis: the reference direction, projected on the layer"},
    {"solid.cords", "normal", K::point, false, "", any, "", "[0, 0, 1]",
     "without an axis: on this side the layer's normal is"},

    {"solid.motion", "name", K::text, false, "", any, "", "none",
     "of columns NAME_force_x[N] … of history.csv: the force that holds the nodes there"},
    {"solid.motion", "set", K::text, true, "", any, "", "", "node set"},
    {"solid.motion", "along", K::choice, true, "", any, "x y z", "", "direction"},
    {"solid.pressure", "surface", K::text, true, "", any, "", "", "surface set"},

    {"solid.rigid_body", "name", K::text, true, "", any, "", "",
     "letters, digits and _, beginning with a letter; each once"},
    {"solid.rigid_body", "set", K::text, true, "", any, "", "", "node set"},
    {"solid.rigid_body", "point", K::point, false, "m", any, "", "mean of the nodes",
     "of the body: displacements and turns are counted there, loads act there"},
    {"solid.rigid_body", "mass", K::number, false, "kg", not_negative, "", "0",
     "its own, beside that of its nodes; in two dimensions of a metre of depth"},
    {"solid.rigid_body", "inertia", K::numbers, false, "kg m²", not_negative, "", "0",
     "its own, about the point: one number; in three dimensions three, about x, y and z as drawn"},
    {"solid.rigid_motion", "body", K::text, true, "", any, "", "", "name of a [[solid.rigid_body]]"},
    {"solid.rigid_motion", "freedom", K::choice, true, "", any, "x y z turn turn_x turn_y turn_z", "",
     "turn in two dimensions, turn_x, turn_y, turn_z in three"},
    {"solid.rigid_load", "body", K::text, true, "", any, "", "", "name of a [[solid.rigid_body]]"},
    {"solid.rigid_load", "freedom", K::choice, true, "", any, "x y z turn turn_x turn_y turn_z", "",
     "force along x, y, z; moment about z (turn), or about x, y, z"},

    {"solid.contact", "name", K::text, true, "", any, "", "",
     "letters, digits and _, beginning with a letter; each once"},
    {"solid.contact", "surface", K::text, true, "", any, "", "", "surface set of the body"},
    {"solid.contact", "shape", K::choice, false, "", any, "plane cylinder sphere", "plane",
     "of the ground; a cylinder is a circle in two dimensions"},
    {"solid.contact", "point", K::point, true, "m", any, "", "", "on the plane; the centre; on the axis"},
    {"solid.contact", "normal", K::point, false, "", any, "", "needed for a plane", "of any length, towards the body"},
    {"solid.contact", "axis", K::point, false, "", any, "", "needed for a cylinder in three dimensions",
     "its direction"},
    {"solid.contact", "radius", K::number, false, "m", positive, "", "needed for a cylinder or a sphere",
     "of the ground"},
    {"solid.contact", "hollow", K::boolean, false, "", any, "", "false", "the body is inside the cylinder or sphere"},
    {"solid.contact", "friction", K::number, false, "", not_negative, "", "0", "Coulomb's coefficient"},
    {"solid.contact", "penalty", K::number, false, "Pa/m", positive, "", "10 E/h",
     "pressure per depth of penetration; by default with E and height h of the element behind each facet"},
    {"solid.ground_motion", "contact", K::text, true, "", any, "", "", "name of a [[solid.contact]]"},
    {"solid.ground_motion", "along", K::choice, true, "", any, "x y z", "", "direction"},
});

std::vector<SceneKey> all_keys() {
    std::vector<SceneKey> all(body_keys.begin(), body_keys.end());
    const auto add = [&all](const auto& keys) { all.insert(all.end(), keys.begin(), keys.end()); };
    add(material_keys("solid.material"));
    all.push_back({"solid.part", "set", K::text, true, "", any, "", "", "element set: a physical group of a mesh"});
    add(material_keys("solid.part"));
    add(condition_keys);
    add(time_law_keys("solid.motion", "m", "m/s"));
    add(time_law_keys("solid.pressure", "Pa", "Pa/s"));
    add(time_law_keys("solid.rigid_motion", "m, rad", "m/s, rad/s"));
    add(time_law_keys("solid.rigid_load", "N, N m", "N/s, N m/s"));
    add(time_law_keys("solid.ground_motion", "m", "m/s"));
    return all;
}

}  // namespace

std::span<const SceneSection> solid_sections() {
    return sections;
}
std::span<const SceneKey> solid_keys() {
    static const std::vector<SceneKey> all = all_keys();
    return all;
}

}  // namespace aquagraph::io
