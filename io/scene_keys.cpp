#include "io/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace aquagraph::io {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr ValueRange any{};
constexpr ValueRange positive{0, inf, true, true};
constexpr ValueRange at_least_one{1, inf, false, true};

constexpr auto sections = std::to_array<SceneSection>({
    {"", false, true, "Before any table."},
    {"time", false, true, "How long."},
    {"domain", false, true, "Where particles live. Walls and the solid may stand outside it."},
    {"fluid", false, false, "The water: weakly compressible SPH. A scene needs it: a solid alone cannot be run yet."},
    {"fluid.scheme", false, false, "How particles act on each other."},
    {"fluid.viscosity", false, false, "Viscous forces. Without it the water has none beside the scheme's own."},
    {"fluid.transport", false, false, "What particles move with besides the water's velocity."},
    {"fluid.box", true, false,
     "Water at rest, one particle in the middle of every cell of Δx. Boxes may touch, not overlap each other or the "
     "solid."},
    {"wall", true, false,
     "Rigid walls. In 2D polylines with the fluid on the left of the direction of travel, so a closed tank is walked "
     "counter-clockwise. In 3D flat convex faces, their corners counter-clockwise as seen from the fluid."},
    {"probe", true, false,
     "Places whose values go into history.csv: `NAME_pressure`, `NAME_velocity_x` and so on, or `NAME_level`. Pressure "
     "and velocity are interpolated between the particles around; in the air they are 0. A level is the height of the "
     "free surface on the line upwards from the point: the highest place where the particles fill half of what they "
     "fill in the water below it."},
    {"solid", false, false, "The elastic body: finite elements. Without it the scene is a fluid alone."},
    {"solid.box", false, false, "A rectangle of eight-node quadrilaterals, with the sets left, right, bottom and top."},
    {"solid.material", false, false, "What the body is made of. Needed with [solid]."},
    {"solid.scheme", false, false, "How the body is taken through time."},
    {"solid.clamp", true, false, "Nodes that do not move."},
    {"solid.track", true, false, "Points whose displacement goes into history.csv as NAME_x[m] and NAME_y[m]."},
    {"coupling", false, false, "How fluid and solid wait for each other. Only where the scene has both."},
    {"output", false, false, "What is written, and how often."},
    {"compare", true, false, "Reference curves: drawn in the report, and measured against unless `error = false`."},
});

using K = KeyKind;
constexpr auto keys = std::to_array<SceneKey>({
    {"", "schema_version", K::integer, true, "", {1, 1, false, false}, "", "", "version of this layout"},
    {"", "title", K::text, false, "", any, "", "name of the scene", "one line for the report"},
    {"", "gravity", K::point, false, "m/s²", any, "", "[0, -9.81] or [0, 0, -9.81]", "acceleration of everything"},

    {"time", "end", K::number, true, "s", positive, "", "", "simulated time"},

    {"domain", "min", K::point, true, "m", any, "", "",
     "lower left corner; its length, 2 or 3, is the dimension of the scene"},
    {"domain", "max", K::point, true, "m", any, "", "", "upper right corner"},
    {"domain", "edge", K::choice, false, "", any, "closed open", "closed",
     "closed: a particle that leaves stops the run; open: it is taken out and counted"},
    {"domain", "periodic", K::texts, false, "", any, "", "none",
     "directions, as [\"x\"], in which what leaves on one side comes back on the other; flat walls may end there"},

    {"fluid", "spacing", K::number, true, "m", positive, "", "", "Δx, distance between particles"},
    {"fluid", "density", K::number, false, "kg/m³", positive, "", "1000", "ρ0, at zero pressure"},
    {"fluid", "sound_speed", K::number, true, "m/s", positive, "", "",
     "c0, at least ten times the fastest flow to be expected"},
    {"fluid", "polytropic_exponent", K::number, false, "", {1, 20, false, false}, "", "7", "γ of the Tait equation"},
    {"fluid",
     "support_ratio",
     K::number,
     false,
     "",
     {1.5, 6, false, false},
     "",
     "4",
     "R/Δx, radius of the kernel in particle distances"},
    {"fluid", "kernel", K::choice, false, "", any, "wendland_c2 cubic_spline", "wendland_c2", "smoothing kernel"},
    {"fluid", "integration", K::choice, false, "", any, "rk4 rk3 verlet", "rk4",
     "time integration: Runge–Kutta of order 4 (4 evaluations a step), of order 3 (3), or velocity Verlet (1)"},
    {"fluid",
     "cfl",
     K::number,
     false,
     "",
     {0, 1, true, false},
     "",
     "rk4: 0.375, rk3: 0.25, verlet: 0.1",
     "K of Δt = K R/c"},
    {"fluid", "initial_pressure", K::choice, false, "", any, "hydrostatic zero", "hydrostatic", "pressure at t = 0"},
    {"fluid", "surface_level", K::number, false, "m", any, "", "highest top of the boxes",
     "height (y, in 3D z) at which the hydrostatic pressure is zero"},

    {"fluid.scheme", "name", K::choice, false, "", any, "riemann riemann_ale delta_sph artificial_viscosity", "riemann",
     "Riemann-SPH with constant masses, Riemann-SPH with mass exchange (ALE), δ-SPH, artificial viscosity"},
    {"fluid.scheme", "reconstruction", K::choice, false, "", any, "muscl none", "muscl",
     "Riemann schemes: states between two particles linear with limiter, or none"},
    {"fluid.scheme", "riemann_solver", K::choice, false, "", any, "acoustic low_dissipation exact", "acoustic",
     "Riemann schemes: linearised, with the low-dissipation limiter, or exact (polytropic_exponent 7 only)"},
    {"fluid.scheme", "delta", K::number, false, "", {0, 1, false, false}, "", "0.1", "δ-SPH: diffusion of density"},
    {"fluid.scheme",
     "alpha",
     K::number,
     false,
     "",
     {0, 10, false, false},
     "",
     "0.01 with delta_sph, 0.05 with artificial_viscosity",
     "δ-SPH and artificial viscosity: dissipation α"},

    {"fluid.viscosity", "dynamic", K::number, true, "Pa s", positive, "", "", "µ"},
    {"fluid.viscosity", "operator", K::choice, false, "", any, "monaghan_gingold morris", "monaghan_gingold",
     "the first keeps angular momentum and suits free surfaces, the second confined flow"},

    {"fluid.transport", "name", K::choice, true, "", any, "none x_sph shifting", "",
     "particles move with the water, with X-SPH's smoothed velocity, or are shifted to a regular arrangement (needs "
     "riemann_ale)"},
    {"fluid.transport", "epsilon", K::number, false, "", {0, 1, false, false}, "", "0.5", "ε of X-SPH"},

    {"fluid.box", "min", K::point, true, "m", any, "", "", "lower left corner"},
    {"fluid.box", "max", K::point, true, "m", any, "", "", "upper right corner, at least Δx away in every direction"},

    {"wall", "name", K::text, true, "", any, "", "", "letters, digits and _, beginning with a letter; each once"},
    {"wall", "points", K::points, true, "m", any, "", "",
     "no two in a row the same; in 2D two or more, in 3D three or more"},
    {"wall", "closed", K::boolean, false, "", any, "", "false", "joins the last point to the first; 2D only"},
    {"wall", "slip", K::choice, false, "", any, "free none symmetry", "free",
     "along the wall: free slip or no slip; symmetry: free slip, and no body that bears a load"},

    {"probe", "name", K::text, true, "", any, "", "", "letters, digits and _, beginning with a letter; each once"},
    {"probe", "quantity", K::choice, true, "", any, "pressure velocity level", "", "what is measured"},
    {"probe", "point", K::point, true, "m", any, "", "", "where; of a level, the lower end of its line"},
    {"probe", "wall", K::text, false, "", any, "", "none",
     "name of a wall or of the solid: the probe sits on its nearest place, moves with it and sees its wetted side "
     "only"},
    {"probe", "interpolation", K::choice, false, "", any, "shepard linear", "shepard",
     "of pressure and velocity: a weighted mean, or a fitted line, which does not shift what is measured on a wall "
     "into the water but is more restless"},

    {"solid", "name", K::text, false, "", any, "", "solid", "letters, digits and _, beginning with a letter"},
    {"solid", "mesh", K::text, false, "", any, "", "none",
     "Gmsh 4.1 file, seen from the scene's folder; either this or [solid.box]"},
    {"solid", "plane", K::choice, false, "", any, "strain stress", "strain", "what holds across the plane"},
    {"solid", "static_start", K::boolean, false, "", any, "", "false",
     "start from the equilibrium under its own weight, without the water"},
    {"solid", "wet", K::texts, false, "", any, "", "none",
     "surface sets that touch the water; needed where the scene has water"},

    {"solid.box", "min", K::point, true, "m", any, "", "", "lower left corner"},
    {"solid.box", "max", K::point, true, "m", any, "", "", "upper right corner"},
    {"solid.box", "elements", K::pair_of_counts, true, "", at_least_one, "", "", "number along x and along y"},

    {"solid.material", "law", K::choice, false, "", any, "saint_venant_kirchhoff neo_hookean", "saint_venant_kirchhoff",
     "stress from strain; the second where strains are large"},
    {"solid.material", "density", K::number, true, "kg/m³", positive, "", "", "ρ of the body at rest"},
    {"solid.material", "youngs_modulus", K::number, true, "Pa", positive, "", "", "E at small strain"},
    {"solid.material", "poissons_ratio", K::number, true, "", {-1, 0.5, true, true}, "", "", "ν at small strain"},

    {"solid.scheme", "name", K::choice, false, "", any, "hht newmark", "hht",
     "Hilber–Hughes–Taylor, or Newmark with the same β and γ"},
    {"solid.scheme",
     "alpha",
     K::number,
     false,
     "",
     {-1.0 / 3, 0, true, false},
     "",
     "-0.3",
     "αs, numerical damping of high frequencies: 0 none"},

    {"solid.clamp", "set", K::text, true, "", any, "", "", "node set: of a box left, right, bottom, top"},
    {"solid.clamp", "fixed", K::texts, false, "", any, "", "[\"x\", \"y\"]", "which displacements are zero"},

    {"solid.track", "name", K::text, true, "", any, "", "",
     "letters, digits and _, beginning with a letter; each once"},
    {"solid.track", "point", K::point, true, "m", any, "", "", "at rest; the nearest node is taken"},

    {"coupling", "algorithm", K::choice, false, "", any, "cps css", "cps",
     "parallel (the solid runs beside the fluid) or sequential staggered"},
    {"coupling", "ratio", K::integer, false, "", {1, 100, false, false}, "", "1", "p, fluid steps per solid step"},
    {"coupling",
     "step_fraction",
     K::number,
     false,
     "",
     {0, 1, true, false},
     "",
     "0.8",
     "of the CFL step, at which the steps of a cycle are fixed"},

    {"output", "frame_interval", K::number, false, "s", positive, "", "a hundredth of the end time",
     "between frames for ParaView"},
    {"output", "history_interval", K::number, false, "s", positive, "", "every coupling cycle",
     "between rows of history.csv"},

    {"compare", "column", K::text, true, "", any, "", "", "of history.csv, without its unit: tip_x"},
    {"compare", "file", K::text, true, "", any, "", "",
     "two columns of numbers, seen from the scene's folder; lines of text are skipped"},
    {"compare", "label", K::text, true, "", any, "", "", "for the report"},
    {"compare", "window", K::interval, false, "s", any, "", "[0, end]", "the time compared"},
    {"compare", "time_scale", K::number, false, "", positive, "", "1", "makes seconds of the first column"},
    {"compare", "value_scale", K::number, false, "", any, "", "1", "makes the column's unit of the second"},
    {"compare", "value_offset", K::number, false, "", any, "", "0", "added after the scale, in the column's unit"},
    {"compare", "error", K::boolean, false, "", any, "", "true", "false: drawn only"},
});

constexpr auto reserved = std::to_array<std::string_view>(
    {"time", "step", "fluid", "solid", "force", "energy", "all", "interface", "total", "particles"});

std::string kind_text(const SceneKey& key) {
    switch (key.kind) {
        case K::number:
            return "number";
        case K::integer:
            return "whole number";
        case K::boolean:
            return "true or false";
        case K::text:
            return "text";
        case K::choice:
            return "text";
        case K::point:
            return "[x, y]";
        case K::pair_of_counts:
            return "[nx, ny]";
        case K::texts:
            return "list of texts";
        case K::points:
            return "list of [x, y]";
        case K::interval:
            return "[from, to]";
    }
    return {};
}

std::string choices_text(std::string_view choices, std::string_view quote) {
    std::string text;
    for (std::size_t begin = 0; begin < choices.size();) {
        const std::size_t end = std::min(choices.find(' ', begin), choices.size());
        text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", quote, choices.substr(begin, end - begin), quote);
        begin = end + 1;
    }
    return text;
}

std::string bound(double value) {
    return value == -1.0 / 3 ? "-1/3" : fmt::format("{}", value);
}

}  // namespace

bool ValueRange::contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string ValueRange::text() const {
    const bool below = std::isfinite(high), above = std::isfinite(low);
    if (!below && !above) return "any";
    if (!below) return fmt::format("{} {}", low_open ? ">" : "≥", bound(low));
    if (!above) return fmt::format("{} {}", high_open ? "<" : "≤", bound(high));
    if (low == high) return bound(low);
    return fmt::format("{}{}, {}{}", low_open ? "]" : "[", bound(low), bound(high), high_open ? "[" : "]");
}

std::span<const SceneSection> scene_sections() {
    return sections;
}
std::span<const SceneKey> scene_keys() {
    return keys;
}
std::span<const std::string_view> reserved_names() {
    return reserved;
}

const SceneSection* find_section(std::string_view name) {
    for (const SceneSection& section : sections)
        if (section.name == name) return &section;
    return nullptr;
}

const SceneKey* find_key(std::string_view section, std::string_view name) {
    for (const SceneKey& key : scene_keys())
        if (key.section == section && key.name == name) return &key;
    return nullptr;
}

std::string expectation(const SceneKey& key) {
    if (key.kind == K::choice) return "one of " + choices_text(key.choices, "\"");
    std::string text;
    switch (key.kind) {
        case K::number:
            text = "a number";
            break;
        case K::integer:
            text = "a whole number";
            break;
        case K::text:
            text = "a text in quotes";
            break;
        case K::point:
            text = "two numbers [x, y] or three [x, y, z]";
            break;
        case K::pair_of_counts:
            text = "two whole numbers [nx, ny]";
            break;
        case K::texts:
            text = "a list of texts [\"…\", …]";
            break;
        case K::points:
            text = "a list of points [[x, y], …]";
            break;
        case K::interval:
            text = "two numbers [from, to]";
            break;
        default:
            text = kind_text(key);
    }
    const std::string range = key.range.text();
    if (key.range.low == key.range.high)
        text += ", " + range;
    else if (range.front() == '[' || range.front() == ']')
        text += " in " + range;
    else if (range != "any")
        text += (key.kind == K::pair_of_counts ? ", each " : " ") + range;
    if (!key.unit.empty()) text += fmt::format(", in {}", key.unit);
    return text;
}

std::string section_heading(const SceneSection& section) {
    if (section.name.empty()) return {};
    return section.repeated ? fmt::format("[[{}]]", section.name) : fmt::format("[{}]", section.name);
}

std::string section_markdown(const SceneSection& section) {
    std::string text =
        section.name.empty() ? "## Top of the file\n\n" : fmt::format("## `{}`\n\n", section_heading(section));
    text += fmt::format("{}\n\n| key | takes | unit | range | default | meaning |\n|---|---|---|---|---|---|\n",
                        section.meaning);
    for (const SceneKey& key : scene_keys()) {
        if (key.section != section.name) continue;
        const std::string range = key.kind == K::choice ? choices_text(key.choices, "`") : key.range.text();
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, kind_text(key),
                            key.unit.empty() ? "–" : key.unit, range == "any" ? "–" : range,
                            key.required ? "**required**" : key.standard, key.meaning);
    }
    return text;
}

}  // namespace aquagraph::io
