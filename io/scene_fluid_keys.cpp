// The sections and keys of the fluid and of its walls.
#include "io/scene_fluid_keys.hpp"

#include <array>
#include <vector>

#include "io/value_ranges.hpp"

namespace aquagraph::io {
namespace {

using namespace ranges;

constexpr auto sections = std::to_array<SceneSection>({
    {"fluid", false, false, "The water: weakly compressible SPH. Without it the scene is a solid alone."},
    {"fluid.scheme", false, false, "How particles act on each other."},
    {"fluid.viscosity", false, false, "Viscous forces. Without it the water has none beside the scheme's own."},
    {"fluid.transport", false, false, "What particles move with besides the water's velocity."},
    {"fluid.box", true, false,
     "Water, one particle in the middle of every cell of Δx. Bodies of water may touch, not overlap each other or the "
     "solid."},
    {"fluid.polygon", true, false,
     "Water inside a polygon, in two dimensions: the points of a lattice of Δx that lie inside."},
    {"fluid.disc", true, false, "Water inside a circle, in two dimensions: a drop, a round tank."},
    {"fluid.sphere", true, false, "Water inside a sphere, in three dimensions.", false, true},
    {"fluid.volume", true, false, "Water inside a watertight STL surface, in three dimensions.", false, true},
    {"fluid.initial", false, false, "How the water starts, as formulas of `x`, `y`, `z` and the constants."},
    {"fluid.central_force", false, false,
     "An acceleration -rate² (x - centre) beside gravity. Its energy belongs to the potential energy."},
    {"wall", true, false,
     "Rigid walls. Each has exactly one shape: `points`, or one of the tables below. `points` is in two dimensions a "
     "polyline with the fluid on the left of the direction of travel, so a closed tank is walked counter-clockwise; in "
     "three dimensions a flat face, its corners counter-clockwise as seen from the fluid."},
    {"wall.box", false, false, "A box, its sides left, right (x), front, back (y, in three dimensions), bottom, top."},
    {"wall.rectangle", false, false, "A rectangle or parallelogram in three dimensions.", false, true},
    {"wall.extrusion", false, false, "A polyline drawn along an axis, in three dimensions."},
    {"wall.circle", false, false, "A circle of straight panels, in two dimensions."},
    {"wall.sphere", false, false, "A sphere of triangles.", false, true},
    {"wall.cylinder", false, false, "A cylinder of triangles, with flat ends.", false, true},
    {"wall.stl", false, false,
     "A surface of triangles from an STL file, ASCII or binary: scaled, turned, moved, in this order. Triangles "
     "without area, twice the same, looking opposite ways or cutting through each other are refused, with their "
     "places.",
     false, true},
    {"wall.motion", false, false,
     "The wall moves by itself. Laws of a translation and of a rotation, and a table, add up; all are counted from "
     "t = 0, when the wall is where it is drawn."},
    {"wall.motion.translation", false, false, "Either `velocity`, or `amplitude` with `frequency` or `period`."},
    {"wall.motion.rotation", false, false,
     "Counter-clockwise about a point, or about an axis through it; the point takes part in the translation. Either "
     "`velocity`, or `amplitude` with `frequency` or `period`, or neither, where a table has the angle."},
});

using K = KeyKind;
// Of water of any shape: how high it reaches, and how far from the shape its particles are.
std::vector<SceneKey> filling_keys(std::string_view section) {
    return {
        {section, "level", K::number, false, "m", any, "", "none", "height that the water reaches: nothing above"},
        {section, "clearance", K::number, false, "Δx", closed(0, 1), "", "0.5",
         "distance of particles from the surface; without meaning where they are relaxed"},
    };
}

// Of a disc and of a sphere of water.
std::vector<SceneKey> round_water_keys(std::string_view section) {
    return {
        {section, "centre", K::point, true, "m", any, "", "", "its middle"},
        {section, "radius", K::number, true, "m", positive, "", "", "from the middle"},
        {section, "chord_error", K::number, false, "m", positive, "", "Δx/50",
         "distance of a panel's middle from the round"},
        {section, "velocity", K::point, false, "m/s", any, "", "0", "at t = 0"},
        {section, "initial_pressure", K::choice, false, "", any, "hydrostatic zero", "zero", "pressure at t = 0"},
    };
}

// Of a circle and of a sphere as walls.
std::vector<SceneKey> round_wall_keys(std::string_view section) {
    return {
        {section, "centre", K::point, true, "m", any, "", "", "its middle"},
        {section, "radius", K::number, true, "m", positive, "", "", "from the middle"},
        {section, "fluid", K::choice, true, "", any, "inside outside", "", "where the water is"},
        {section, "chord_error", K::number, false, "m", positive, "", "Δx/50",
         "distance of a panel's middle from the round"},
    };
}

// Where an STL surface is put.
std::vector<SceneKey> placing_keys(std::string_view section) {
    return {
        {section, "axis", K::point, false, "", any, "", "[0, 0, 1]",
         "turned about this direction through the file's origin …"},
        {section, "angle", K::number, false, "rad", any, "", "0", "… by this angle"},
        {section, "translate", K::point, false, "m", any, "", "[0, 0, 0]", "where the file's origin comes to lie"},
        {section, "weld", K::number, false, "m", positive, "", "a millionth of the size",
         "vertices closer than this are one"},
    };
}

// Of a motion that swings.
std::vector<SceneKey> swing_keys(std::string_view section) {
    return {
        {section, "frequency", K::number, false, "Hz", positive, "", "none",
         "of the swinging: amplitude · sin(2π frequency t + phase)"},
        {section, "period", K::number, false, "s", positive, "", "none", "1/frequency"},
        {section, "phase", K::number, false, "rad", any, "", "0", "at t = 0"},
        {section, "ramp", K::number, false, "s", not_negative, "", "0",
         "time in which the motion grows smoothly from rest"},
    };
}

// In the order in which benchmarks/SCENES.md shows them within a section.
std::vector<SceneKey> all_keys() {
    std::vector<SceneKey> all;
    const auto add = [&all](const std::vector<SceneKey>& keys) { all.insert(all.end(), keys.begin(), keys.end()); };
    add({
        {"fluid", "spacing", K::number, true, "m", positive, "", "", "Δx, distance between particles"},
        {"fluid", "density", K::number, false, "kg/m³", positive, "", "1000", "ρ0, at zero pressure"},
        {"fluid", "sound_speed", K::number, true, "m/s", positive, "", "",
         "c0, at least ten times the fastest flow to be expected"},
        {"fluid", "polytropic_exponent", K::number, false, "", closed(1, 20), "", "7", "γ of the Tait equation"},
        {"fluid", "support_ratio", K::number, false, "", closed(1.5, 6), "", "4",
         "R/Δx, radius of the kernel in particle distances"},
        {"fluid", "kernel", K::choice, false, "", any, "wendland_c2 cubic_spline", "wendland_c2", "smoothing kernel"},
        {"fluid", "integration", K::choice, false, "", any, "rk4 rk3 verlet", "rk4",
         "time integration: Runge–Kutta of order 4 (4 evaluations a step), of order 3 (3), or velocity Verlet (1)"},
        {"fluid", "cfl", K::number, false, "", open_below(0, 1), "", "rk4: 0.375, rk3: 0.35, verlet: 0.15",
         "K of Δt = K R/c"},
        {"fluid", "walls", K::choice, false, "", any, "ghosts normal_flux", "ghosts",
         "particles mirrored through the walls, or fluxes through their surface; the latter not for "
         "artificial_viscosity, and for delta_sph with alpha of 0.2 or more"},
        {"fluid", "initial_pressure", K::choice, false, "", any, "hydrostatic zero", "hydrostatic",
         "pressure at t = 0"},
        {"fluid", "surface_level", K::number, false, "m", any, "", "highest top of the water",
         "height (y, in 3D z) at which the hydrostatic pressure is zero"},
        {"fluid", "driving_force", K::point, false, "m/s²", any, "", "none",
         "an acceleration beside gravity that has no part in hydrostatic pressures: drives a flow between plates"},
        {"fluid", "relax", K::boolean, false, "", any, "", "false",
         "moves the particles of polygons, discs, spheres and volumes to a regular distribution before t = 0; they "
         "then have the exact volume"},
        {"fluid", "relax_tolerance", K::number, false, "", open(0, 1), "", "0.002",
         "standard deviation of the kernel sum at which that ends"},

        {"fluid.scheme", "name", K::choice, false, "", any, "riemann riemann_ale delta_sph artificial_viscosity",
         "riemann",
         "Riemann-SPH with constant masses, Riemann-SPH with mass exchange (ALE), δ-SPH, artificial viscosity"},
        {"fluid.scheme", "reconstruction", K::choice, false, "", any, "muscl none", "muscl",
         "Riemann schemes: states between two particles linear with limiter, or none"},
        {"fluid.scheme", "riemann_solver", K::choice, false, "", any, "acoustic low_dissipation exact", "acoustic",
         "Riemann schemes: linearised, with the low-dissipation limiter, or exact (polytropic_exponent 7 only)"},
        {"fluid.scheme", "delta", K::number, false, "", closed(0, 1), "", "0.1", "δ-SPH: diffusion of density"},
        {"fluid.scheme", "alpha", K::number, false, "", closed(0, 10), "",
         "0.01 with delta_sph, 0.05 with artificial_viscosity", "δ-SPH and artificial viscosity: dissipation α"},

        {"fluid.viscosity", "dynamic", K::number, true, "Pa s", positive, "", "", "µ"},
        {"fluid.viscosity", "operator", K::choice, false, "", any, "monaghan_gingold morris", "monaghan_gingold",
         "the first keeps angular momentum and suits free surfaces, the second confined flow"},

        {"fluid.transport", "name", K::choice, true, "", any, "none x_sph shifting", "",
         "particles move with the water, with X-SPH's smoothed velocity, or are shifted to a regular arrangement "
         "(needs riemann_ale)"},
        {"fluid.transport", "epsilon", K::number, false, "", closed(0, 1), "", "0.5", "ε of X-SPH"},

        {"fluid.box", "min", K::point, true, "m", any, "", "", "lower left corner"},
        {"fluid.box", "max", K::point, true, "m", any, "", "",
         "upper right corner, at least Δx away in every direction"},
        {"fluid.box", "velocity", K::point, false, "m/s", any, "", "0", "at t = 0"},

        {"fluid.polygon", "points", K::points, true, "m", any, "", "", "three or more, either way round"},
        {"fluid.polygon", "velocity", K::point, false, "m/s", any, "", "0", "at t = 0"},
        {"fluid.polygon", "initial_pressure", K::choice, false, "", any, "hydrostatic zero", "that of [fluid]",
         "pressure at t = 0"},
    });
    add(filling_keys("fluid.polygon"));
    add(round_water_keys("fluid.disc"));
    add(filling_keys("fluid.disc"));
    add(round_water_keys("fluid.sphere"));
    add(filling_keys("fluid.sphere"));
    add({
        {"fluid.volume", "stl", K::text, true, "", any, "", "", "STL file, seen from the scene's folder"},
        {"fluid.volume", "scale", K::number, false, "", positive, "", "1", "metres per unit of the file"},
    });
    add(placing_keys("fluid.volume"));
    add({
        {"fluid.volume", "velocity", K::point, false, "m/s", any, "", "0", "at t = 0"},
        {"fluid.volume", "initial_pressure", K::choice, false, "", any, "hydrostatic zero", "that of [fluid]",
         "pressure at t = 0"},
    });
    add(filling_keys("fluid.volume"));
    add({
        {"fluid.initial", "velocity", K::formulas, false, "m/s", any, "", "at rest", "one formula per direction"},
        {"fluid.initial", "pressure", K::formula, false, "Pa", any, "", "`initial_pressure`", "relative to the air"},

        {"fluid.central_force", "centre", K::point, true, "m", any, "", "", "where it points to"},
        {"fluid.central_force", "rate", K::number, true, "1/s", positive, "", "",
         "its square times the distance pulls"},

        {"wall", "name", K::text, true, "", any, "", "", "letters, digits and _, beginning with a letter; each once"},
        {"wall", "points", K::points, false, "m", any, "", "none",
         "no two in a row the same; in 2D two or more, in 3D the corners of a flat convex face"},
        {"wall", "closed", K::boolean, false, "", any, "", "false", "joins the last point to the first; 2D only"},
        {"wall", "slip", K::choice, false, "", any, "free none symmetry", "free",
         "along the wall: free slip or no slip; symmetry: free slip, and no body that bears a load"},
        {"wall", "force", K::boolean, false, "", any, "", "false",
         "writes the water's force on the wall into history.csv, as NAME_force_x and so on; with an energy ledger also "
         "its work on the water, NAME_work"},

        {"wall.box", "min", K::point, true, "m", any, "", "", "lower left corner"},
        {"wall.box", "max", K::point, true, "m", any, "", "", "upper right corner"},
        {"wall.box", "fluid", K::choice, true, "", any, "inside outside", "", "where the water is"},
        {"wall.box", "open", K::texts, false, "", any, "", "none", "sides that are no wall: [\"top\"]"},

        {"wall.rectangle", "corner", K::point, true, "m", any, "", "", "where both sides begin"},
        {"wall.rectangle", "side_a", K::point, true, "m", any, "", "", "from the corner along one side"},
        {"wall.rectangle", "side_b", K::point, true, "m", any, "", "",
         "along the other; the fluid is where a × b points"},

        {"wall.extrusion", "points", K::points, true, "m", any, "", "",
         "of two coordinates each: (y, z) along x, (x, z) along y, (x, y) along z; the fluid is on the left as drawn "
         "with the first to the right and the second upwards"},
        {"wall.extrusion", "closed", K::boolean, false, "", any, "", "false", "joins the last point to the first"},
        {"wall.extrusion", "caps", K::boolean, false, "", any, "", "false", "closes both ends"},
        {"wall.extrusion", "axis", K::choice, true, "", any, "x y z", "", "drawn along this direction"},
        {"wall.extrusion", "from", K::number, true, "m", any, "", "", "along the axis"},
        {"wall.extrusion", "to", K::number, true, "m", any, "", "", "along the axis, beyond `from`"},
    });
    add(round_wall_keys("wall.circle"));
    add(round_wall_keys("wall.sphere"));
    add({
        {"wall.cylinder", "from", K::point, true, "m", any, "", "", "middle of one end"},
        {"wall.cylinder", "to", K::point, true, "m", any, "", "", "middle of the other"},
        {"wall.cylinder", "radius", K::number, true, "m", positive, "", "", "from the middle"},
        {"wall.cylinder", "fluid", K::choice, true, "", any, "inside outside", "", "where the water is"},
        {"wall.cylinder", "open", K::texts, false, "", any, "", "none", "ends that are no wall: [\"from\", \"to\"]"},
        {"wall.cylinder", "chord_error", K::number, false, "m", positive, "", "Δx/50",
         "distance of a panel's middle from the round"},

        {"wall.stl", "file", K::text, true, "", any, "", "", "STL file, seen from the scene's folder"},
        {"wall.stl", "scale", K::number, false, "", positive, "", "1", "metres per unit of the file"},
    });
    add(placing_keys("wall.stl"));
    add({
        {"wall.stl", "closed", K::boolean, false, "", any, "", "true", "false: need not be watertight"},
        {"wall.stl", "fluid", K::choice, false, "", any, "inside outside", "outside",
         "of a watertight surface; of an open one outside is in front of its triangles"},

        {"wall.motion", "table", K::text, false, "", any, "", "none",
         "CSV file with a head line: time and any of x, y, z [m], angle [rad] ([deg] if the head says so); cubics in "
         "between"},
        {"wall.motion", "after", K::choice, false, "", any, "refuse hold", "refuse",
         "a table that ends before the run: an error, or the wall stands still from then on"},

        {"wall.motion.translation", "velocity", K::point, false, "m/s", any, "", "none", "constant"},
        {"wall.motion.translation", "amplitude", K::point, false, "m", any, "", "none", "of a harmonic motion"},
    });
    add(swing_keys("wall.motion.translation"));
    add({
        {"wall.motion.rotation", "centre", K::point, true, "m", any, "", "", "as drawn"},
        {"wall.motion.rotation", "axis", K::point, false, "", any, "", "[0, 0, 1]", "direction, in three dimensions"},
        {"wall.motion.rotation", "velocity", K::number, false, "rad/s", any, "", "none", "constant"},
        {"wall.motion.rotation", "amplitude", K::number, false, "rad", any, "", "none", "of a harmonic motion"},
    });
    add(swing_keys("wall.motion.rotation"));
    return all;
}

}  // namespace

std::span<const SceneSection> fluid_sections() {
    return sections;
}
std::span<const SceneKey> fluid_keys() {
    static const std::vector<SceneKey> all = all_keys();
    return all;
}

}  // namespace aquagraph::io
