// The sections and keys of a scene file: data only, those of the fluid in scene_fluid_keys.cpp, of the solid in
// scene_solid_keys.cpp. io/scene_keys.cpp says what is done with them.
#include <algorithm>
#include <array>
#include <vector>

#include "io/scene_fluid_keys.hpp"
#include "io/scene_keys.hpp"
#include "io/scene_solid_keys.hpp"
#include "io/value_ranges.hpp"

namespace aquagraph::io {
namespace {

using namespace ranges;

constexpr auto sections = std::to_array<SceneSection>({
    {"", false, true, "Before any table."},
    {"constants", false, false,
     "Numbers with names, for formulas: `U = 1.5`, or a formula of other constants, `k = \"2*pi/L\"`. Beside them "
     "formulas know pi and the scene's own `dx` (spacing), `rho0` and `c0`.",
     true},
    {"time", false, true, "How long."},
    {"domain", false, true, "Where particles live. Walls and the solid may stand outside it."},
    {"probe", true, false,
     "Places whose values go into history.csv: `NAME_pressure`, `NAME_velocity_x` and so on, or `NAME_level`. Pressure "
     "and velocity are interpolated between the particles around; in the air they are 0. A level is the height of the "
     "free surface on the line upwards from the point: the highest place where the particles fill half of what they "
     "fill in the water below it."},
    {"coupling", false, false, "How fluid and solid wait for each other. Only where the scene has both."},
    {"output", false, false, "What is written, and how often."},
    {"integral", true, false,
     "A column of history.csv: the value summed over the water, Σ ω value. Formulas of `x y z t vx vy vz p rho "
     "fullness` (of the support: 1 inside, towards 0 at a free surface) and the constants."},
    {"extreme", true, false, "A column of history.csv: the largest or smallest value in the water."},
    {"field_error", true, false,
     "Columns NAME_velocity_error and NAME_pressure_error of history.csv: the L2 norm, weighted by mass, of the "
     "difference to fields known as formulas of `x y z t` and the constants, divided by that of the known field."},
    {"compare", true, false,
     "Reference curves: drawn in the report, and measured against unless `error = false`. A curve is a file or a "
     "formula."},
});

using K = KeyKind;
constexpr auto keys = std::to_array<SceneKey>({
    {"", "schema_version", K::integer, true, "", closed(1, 1), "", "", "version of this layout"},
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

    {"probe", "name", K::text, true, "", any, "", "", "letters, digits and _, beginning with a letter; each once"},
    {"probe", "quantity", K::choice, true, "", any, "pressure velocity level", "", "what is measured"},
    {"probe", "point", K::point, true, "m", any, "", "", "where; of a level, the lower end of its line"},
    {"probe", "wall", K::text, false, "", any, "", "none",
     "name of a wall or of the solid: the probe sits on its nearest place, moves with it and sees its wetted side "
     "only"},
    {"probe", "interpolation", K::choice, false, "", any, "shepard linear", "shepard",
     "of pressure and velocity: a weighted mean, or a fitted line, which does not shift what is measured on a wall "
     "into the water but is more restless"},

    {"coupling", "algorithm", K::choice, false, "", any, "cps css iterated", "cps",
     "parallel (the solid runs beside the fluid), sequential staggered, or iterated until both agree, for bodies that "
     "are light for the water they move"},
    {"coupling", "ratio", K::integer, false, "", closed(1, 100), "", "1",
     "p, fluid steps per solid step; with `ratio_control` the most there may be"},
    {"coupling", "ratio_control", K::boolean, false, "", any, "", "false",
     "p follows the force: one more while it changes by less than 7.5 % in a cycle, one less up to 15 %, else 1"},
    {"coupling", "load", K::choice, false, "", any, "averaged_pressure force_conservative energy_conservative",
     "force_conservative",
     "what the body bears: the mean pressure within R, minus the force that it exerts on the water, or this times 1 + "
     "ε with ε up to ±0.15 so that no energy is lost or made between the two"},
    {"coupling", "energy_cycles", K::number, false, "", at_least_one, "", "20",
     "over which the energy-conservative load averages"},
    {"coupling", "extrapolation", K::choice, false, "", any, "none linear quadratic", "linear",
     "how wet nodes move between two solid steps; none: they stand still, to show why they should not"},
    {"coupling", "smoothing", K::number, false, "Δx", closed(0, 4), "", "0.5",
     "ℓ: waves along the wet surface that are shorter than about 4 ℓ are taken out of what the water sees of it, and "
     "of "
     "its load; 0: none, then shorter steps or elements finer than particles may fail"},
    {"coupling", "step_rule", K::choice, false, "", any, "fixed predicted", "fixed",
     "cps and iterated (css chooses every step anew; `predicted` is refused there): steps of a cycle are fixed to "
     "`step_fraction` of the present CFL step, or to the trend of the CFL step "
     "and how well it did of late"},
    {"coupling", "step_fraction", K::number, false, "", open_below(0, 1), "", "0.8; predicted: 1",
     "of the CFL step, or of its trend"},
    {"coupling", "relaxation", K::choice, false, "", any, "aitken quasi_newton", "quasi_newton",
     "iterated: how the next guess is made"},
    {"coupling", "tolerance", K::number, false, "", open(0, 1), "", "0.001",
     "iterated: of the difference between both sides' wet nodes, over what they move in the cycle"},
    {"coupling", "most_iterations", K::integer, false, "", closed(1, 100), "", "20",
     "iterated: of a cycle; how many cycles have not converged then is in summary.json"},

    {"output", "frame_interval", K::number, false, "s", positive, "", "a hundredth of the end time",
     "between frames for ParaView"},
    {"output", "history_interval", K::number, false, "s", positive, "", "every coupling cycle",
     "between rows of history.csv"},
    {"output", "checkpoint_interval", K::number, false, "min", not_negative, "", "10",
     "of wall-clock time between checkpoints (README.md); 0: only when the run is asked to stop"},
    {"output", "interface_loads", K::boolean, false, "", any, "", "false",
     "columns load_N_x[N/m] and load_N_y[N/m] of every wet node N (counted from 1): what the water does to the body, "
     "each coupling cycle; another solver can be given them (export-ccx --loads)"},
    {"output", "energy_ledger", K::boolean, false, "", any, "", "false",
     "columns of the fluid's compression, dissipated and viscous energy, of the walls' work and of what is missing in "
     "the balance, with a solid also of what crosses the interface, of its own ledger and of what else drives it; "
     "costs "
     "about a flux pass per stage"},

    {"integral", "name", K::text, true, "", any, "", "", "of the column"},
    {"integral", "value", K::formula, true, "", any, "", "", "summed with each particle's volume"},
    {"integral", "weight", K::formula, false, "", any, "", "none", "makes it a mean, Σ ω weight value / Σ ω weight"},
    {"integral", "unit", K::text, false, "", any, "", "none", "of the column"},

    {"extreme", "name", K::text, true, "", any, "", "", "of the column"},
    {"extreme", "value", K::formula, true, "", any, "", "", "of each particle, as in [[integral]]"},
    {"extreme", "of", K::choice, false, "", any, "largest smallest", "largest", "which end"},
    {"extreme", "where", K::formula, false, "", any, "", "all particles",
     "only particles where it is not zero: `fullness > 0.3` leaves drops out"},
    {"extreme", "unit", K::text, false, "", any, "", "none", "of the column"},

    {"field_error", "name", K::text, true, "", any, "", "", "of the columns"},
    {"field_error", "velocity", K::formulas, false, "m/s", any, "", "not compared", "one formula per direction"},
    {"field_error", "pressure", K::formula, false, "Pa", any, "", "not compared", "relative to the air"},
    {"field_error", "where", K::formula, false, "", any, "", "everywhere", "only particles where it is not zero"},
    {"field_error", "velocity_scale", K::number, false, "m/s", positive, "", "norm of the known field",
     "the error is divided by"},
    {"field_error", "pressure_scale", K::number, false, "Pa", positive, "", "norm of the known field",
     "the error is divided by"},

    {"compare", "column", K::text, true, "", any, "", "", "of history.csv, without its unit: tip_x"},
    {"compare", "file", K::text, false, "", any, "", "none",
     "two columns of numbers, seen from the scene's folder; lines of text are skipped"},
    {"compare", "formula", K::formula, false, "", any, "", "none", "of `t`, instead of a file"},
    {"compare", "label", K::text, true, "", any, "", "", "for the report"},
    {"compare", "window", K::interval, false, "s", any, "", "[0, end]", "the time compared"},
    {"compare", "time_scale", K::number, false, "", positive, "", "1", "makes seconds of the first column"},
    {"compare", "value_scale", K::number, false, "", any, "", "1", "makes the column's unit of the second"},
    {"compare", "value_offset", K::number, false, "", any, "", "0", "added after the scale, in the column's unit"},
    {"compare", "scale", K::number, false, "", positive, "", "the curve's largest value in the window",
     "the relative error is the error divided by this, in the column's unit"},
    {"compare", "change", K::boolean, false, "", any, "", "false",
     "true: compares how far the column has moved from its first row"},
    {"compare", "error", K::boolean, false, "", any, "", "true", "false: drawn only"},
});

constexpr auto reserved = std::to_array<std::string_view>(
    {"time", "step", "fluid", "solid", "force", "energy", "all", "interface", "total", "particles"});

// In the order of benchmarks/SCENES.md: the fluid's sections before [[probe]], the solid's before [coupling].
std::vector<SceneSection> all_sections() {
    std::vector<SceneSection> all(sections.begin(), sections.end());
    const auto insert = [&all](std::string_view before, std::span<const SceneSection> more) {
        const auto place = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == before; });
        all.insert(place, more.begin(), more.end());
    };
    insert("probe", fluid_sections());
    insert("coupling", solid_sections());
    return all;
}
std::vector<SceneKey> all_keys() {
    std::vector<SceneKey> all(keys.begin(), keys.end());
    all.insert(all.end(), fluid_keys().begin(), fluid_keys().end());
    all.insert(all.end(), solid_keys().begin(), solid_keys().end());
    return all;
}

}  // namespace

std::span<const SceneSection> scene_sections() {
    return scene_table().sections;
}
std::span<const SceneKey> scene_keys() {
    return scene_table().keys;
}
std::span<const std::string_view> reserved_names() {
    return reserved;
}

const KeyTable& scene_table() {
    static const std::vector<SceneSection> known_sections = all_sections();
    static const std::vector<SceneKey> known_keys = all_keys();
    static const KeyTable table{"scene", known_sections, known_keys};
    return table;
}

}  // namespace aquagraph::io
