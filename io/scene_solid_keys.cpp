#include "io/scene_solid_keys.hpp"

#include <array>
#include <limits>

namespace aquagraph::io {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr ValueRange any{};
constexpr ValueRange positive{0, inf, true, true};
constexpr ValueRange not_negative{0, inf, false, true};
constexpr ValueRange at_least_one{1, inf, false, true};

constexpr auto sections = std::to_array<SceneSection>({
    {"solid", false, false,
     "The elastic body: finite elements. Without it the scene is a fluid alone; without [fluid] the body is computed "
     "alone, at rest or in motion. With water it is two-dimensional so far."},
    {"solid.box", false, false,
     "A rectangle of quadrilaterals, with the node sets and surfaces left, right, bottom and top; in three dimensions "
     "a "
     "box of hexahedra, with front (least y) and back too."},
    {"solid.material", false, false, "What the body is made of. Needed with [solid]."},
    {"solid.part", true, false, "Elements of another material than the rest: the same keys as [solid.material]."},
    {"solid.scheme", false, false, "How the body is taken through time."},
    {"solid.clamp", true, false, "Nodes that do not move."},
    {"solid.traction", true, false,
     "A load on a surface. It keeps its direction, and its size per area of the body at rest, however the body bends."},
    {"solid.force", true, false, "A force on nodes, either of a set or the one nearest to a point."},
    {"solid.track", true, false,
     "Points whose displacement goes into history.csv as NAME_x[m], NAME_y[m] and, in three dimensions, NAME_z[m]."},
});

using K = KeyKind;
constexpr auto keys = std::to_array<SceneKey>({
    {"solid", "name", K::text, false, "", any, "", "solid", "letters, digits and _, beginning with a letter"},
    {"solid", "mesh", K::text, false, "", any, "", "none",
     "Gmsh file (.msh, 4.1 or 2.2, ASCII) or CalculiX or Abaqus deck (.inp), seen from the scene's folder; either this "
     "or "
     "[solid.box]. Physical groups, NSET, ELSET and SURFACE become sets of these names"},
    {"solid",
     "order",
     K::integer,
     false,
     "",
     {1, 2, false, false},
     "",
     "2",
     "of boxes and Gmsh files. 2: elements of 8 nodes, in three dimensions 20 or 10, made where the mesh has none on "
     "its "
     "edges; 1: of 4 or 8, with enhanced strains so that they do not lock"},
    {"solid", "integration", K::choice, false, "", any, "reduced full", "reduced",
     "Gauss points of quadratic elements: 2 each way, which do not lock, or 3"},
    {"solid", "plane", K::choice, false, "", any, "strain stress", "strain",
     "what holds across the plane, in two dimensions"},
    {"solid", "static_start", K::boolean, false, "", any, "", "false",
     "start from the equilibrium under its own weight and its loads at t = 0, without the water"},
    {"solid", "wet", K::texts, false, "", any, "", "none",
     "surface sets that touch the water; needed where the scene has water"},

    {"solid.box", "min", K::point, true, "m", any, "", "", "lower left corner"},
    {"solid.box", "max", K::point, true, "m", any, "", "", "upper right corner"},
    {"solid.box", "elements", K::counts, true, "", at_least_one, "", "",
     "number along x, along y and, in three dimensions, along z"},
    {"solid.material", "law", K::choice, false, "", any,
     "saint_venant_kirchhoff linear neo_hookean mooney_rivlin uniaxial_curve", "saint_venant_kirchhoff",
     "stress from strain: the first for large rotations and small strains, linear for small "
     "displacements only, the others for rubber, the last from a measured curve"},
    {"solid.material", "density", K::number, true, "kg/m³", positive, "", "", "ρ of the body at rest"},
    {"solid.material", "youngs_modulus", K::number, false, "Pa", positive, "",
     "needed but for mooney_rivlin and uniaxial_curve", "E at small strain"},
    {"solid.material",
     "poissons_ratio",
     K::number,
     false,
     "",
     {-1, 0.5, true, true},
     "",
     "needed but for mooney_rivlin",
     "ν at small strain"},
    {"solid.material", "c10", K::number, false, "Pa", positive, "", "needed for mooney_rivlin",
     "C10 of W = C10 (Ī1 - 3) + C01 (Ī2 - 3) + κ/2 (J - 1)²"},
    {"solid.material", "c01", K::number, false, "Pa", not_negative, "", "0", "C01; the shear modulus is 2 (C10 + C01)"},
    {"solid.material", "bulk_modulus", K::number, false, "Pa", positive, "", "needed for mooney_rivlin", "κ"},
    {"solid.material", "curve", K::text, false, "", any, "", "needed for uniaxial_curve",
     "file of two columns, seen from the scene's folder: strain, and force per area at rest [Pa] of a strip that is "
     "pulled"},

    {"solid.part", "set", K::text, true, "", any, "", "", "element set: a physical group of a mesh"},
    {"solid.part", "law", K::choice, false, "", any,
     "saint_venant_kirchhoff linear neo_hookean mooney_rivlin uniaxial_curve", "saint_venant_kirchhoff",
     "stress from strain: the first for large rotations and small strains, linear for small "
     "displacements only, the others for rubber, the last from a measured curve"},
    {"solid.part", "density", K::number, true, "kg/m³", positive, "", "", "ρ of the body at rest"},
    {"solid.part", "youngs_modulus", K::number, false, "Pa", positive, "",
     "needed but for mooney_rivlin and uniaxial_curve", "E at small strain"},
    {"solid.part",
     "poissons_ratio",
     K::number,
     false,
     "",
     {-1, 0.5, true, true},
     "",
     "needed but for mooney_rivlin",
     "ν at small strain"},
    {"solid.part", "c10", K::number, false, "Pa", positive, "", "needed for mooney_rivlin",
     "C10 of W = C10 (Ī1 - 3) + C01 (Ī2 - 3) + κ/2 (J - 1)²"},
    {"solid.part", "c01", K::number, false, "Pa", not_negative, "", "0", "C01; the shear modulus is 2 (C10 + C01)"},
    {"solid.part", "bulk_modulus", K::number, false, "Pa", positive, "", "needed for mooney_rivlin", "κ"},
    {"solid.part", "curve", K::text, false, "", any, "", "needed for uniaxial_curve",
     "file of two columns, seen from the scene's folder: strain, and force per area at rest [Pa] of a strip that is "
     "pulled"},

    {"solid.scheme", "name", K::choice, false, "", any, "hht newmark static", "hht",
     "Hilber–Hughes–Taylor, or Newmark with the same β and γ; static: an equilibrium at the end of every step, without "
     "water"},
    {"solid.scheme",
     "alpha",
     K::number,
     false,
     "",
     {-1.0 / 3, 0, true, false},
     "",
     "-0.3",
     "αs, numerical damping of high frequencies: 0 none"},
    {"solid.scheme", "step", K::number, false, "s", positive, "", "static: the end time",
     "largest time step, needed for a motion without water; with water the coupling cycle is the step"},

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
});

}  // namespace

std::span<const SceneSection> solid_sections() {
    return sections;
}
std::span<const SceneKey> solid_keys() {
    return keys;
}

}  // namespace aquagraph::io
