#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "io/report_parts.hpp"
#include "io/scene_words.hpp"
#include "io/scheme_text.hpp"
#include "io/wording.hpp"

namespace aquagraph::io {
namespace {

using Row = std::pair<std::string, std::string>;

std::string table(std::string_view title, const std::vector<Row>& rows) {
    std::string text = fmt::format("<table class=\"facts\"><caption>{}</caption>\n", title);
    for (const auto& [name, value] : rows)
        text += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, html_escaped(value));
    return text + "</table>\n";
}

std::string point(const Point& p) {
    return fmt::format("({:g}, {:g})", p[0], p[1]);
}
std::string box(const Box& b) {
    return fmt::format("{} – {} m", point(b.min), point(b.max));
}

std::string fluid_table(const FluidScene& fluid) {
    std::vector<Row> rows{
        {"particle spacing Δx", quantity(fluid.spacing, "m")},
        {"kernel radius R/Δx", fmt::format("{:g}", fluid.support_ratio)},
        {"density ρ0", fmt::format("{:g} kg/m³", fluid.density)},
        {"sound speed c0", fmt::format("{:g} m/s", fluid.sound_speed)},
        {"polytropic exponent γ", fmt::format("{:g}", fluid.polytropic_exponent)},
        {"CFL", fmt::format("{:g}", fluid.cfl)},
        {"scheme", scheme_text(fluid)},
        {"walls", fluid.walls == WallMethod::ghosts ? "ghost particles" : "normal fluxes"},
        {"pressure at t = 0", fluid.initial_pressure == InitialPressure::hydrostatic ? "hydrostatic" : "zero"}};
    for (const Box& b : fluid.boxes) rows.emplace_back("water", box(b));
    return table("Fluid (SPH)", rows);
}

const char* law_text(solid::MaterialLaw law) {
    switch (law) {
        case solid::MaterialLaw::linear:
            return "linear, small displacements";
        case solid::MaterialLaw::neo_hookean:
            return "neo-Hookean";
        case solid::MaterialLaw::mooney_rivlin:
            return "Mooney–Rivlin";
        case solid::MaterialLaw::uniaxial_curve:
            return "measured uniaxial curve";
        case solid::MaterialLaw::saint_venant_kirchhoff:
            break;
    }
    return "Saint-Venant–Kirchhoff";
}

void material_rows(std::vector<Row>& rows, const MaterialScene& material, const std::string& where) {
    rows.emplace_back("law" + where, law_text(material.law));
    rows.emplace_back("density ρ" + where, fmt::format("{:g} kg/m³", material.density));
    if (material.law == solid::MaterialLaw::mooney_rivlin) {
        rows.emplace_back("C10, C01" + where,
                          fmt::format("{}, {}", quantity(material.c10, "Pa"), quantity(material.c01, "Pa")));
        rows.emplace_back("bulk modulus κ" + where, quantity(material.bulk_modulus, "Pa"));
        return;
    }
    if (material.law == solid::MaterialLaw::uniaxial_curve)
        rows.emplace_back("curve" + where, material.curve_file.filename().string());
    else
        rows.emplace_back("Young's modulus E" + where, quantity(material.youngs_modulus, "Pa"));
    rows.emplace_back("Poisson's ratio ν" + where, fmt::format("{:g}", material.poissons_ratio));
}

std::string factor_text(const LoadHistory& factor) {
    if (!factor.table.empty()) return " × " + factor.table.filename().string();
    return factor.formula.empty() ? "" : " × " + factor.formula;
}

// "0.2 m + 0.5 m/s t + …"
std::string law_text(const TimeLawScene& law, const std::string& unit) {
    std::vector<std::string> parts;
    if (law.value != 0) parts.push_back(quantity(law.value, unit));
    if (law.rate != 0) parts.push_back(quantity(law.rate, unit + "/s") + " t");
    if (law.amplitude != 0)
        parts.push_back(fmt::format("{} at {}", quantity(law.amplitude, unit), quantity(law.frequency, "Hz")));
    if (!law.points.empty()) parts.push_back(fmt::format("a curve of {} points", law.points.size()));
    if (!law.table.empty()) parts.push_back(law.table.filename().string());
    std::string text = parts.empty() ? "0 " + unit : fmt::format("{}", fmt::join(parts, " + "));
    return law.ramp > 0 ? text + fmt::format(", ramp {}", quantity(law.ramp, "s")) : text;
}

// What moves, presses and reinforces the body.
void condition_rows(std::vector<Row>& rows, const SolidScene& solid, int dimension) {
    if (solid.mass_damping > 0 || solid.stiffness_damping > 0)
        rows.emplace_back("Rayleigh damping α, β", fmt::format("{}, {}", quantity(solid.mass_damping, "1/s"),
                                                               quantity(solid.stiffness_damping, "s")));
    for (const CordsScene& cords : solid.cords)
        rows.emplace_back(
            "cords" + (cords.set.empty() ? "" : " of " + cords.set),
            fmt::format("{}, {} every {}, at {} rad", quantity(cords.modulus, "Pa"), quantity(cords.section, "m²"),
                        quantity(cords.spacing, "m"), fmt::join(cords.angles, ", ")));
    for (const NodeMotionScene& motion : solid.motions)
        rows.emplace_back(
            "prescribed motion",
            fmt::format("{} along {}: {}", motion.set, word(direction_words, motion.along), law_text(motion.law, "m")));
    for (const PressureScene& pressure : solid.pressures)
        rows.emplace_back("pressure", fmt::format("{} on {}", law_text(pressure.law, "Pa"), pressure.surface));
    for (const RigidBodyScene& body : solid.rigid_bodies)
        rows.emplace_back("rigid body", fmt::format("{}: nodes of {}", body.name, body.set));
    const auto freedom = [dimension](int k) {
        return dimension == 2 ? word(plane_freedom_words, k) : word(freedom_words, k);
    };
    for (const RigidFreedomScene& entry : solid.rigid_motions)
        rows.emplace_back("prescribed", fmt::format("{} {}: {}", entry.body, freedom(entry.freedom),
                                                    law_text(entry.law, entry.freedom < dimension ? "m" : "rad")));
    for (const RigidFreedomScene& entry : solid.rigid_loads)
        rows.emplace_back("load", fmt::format("{} {}: {}", entry.body, freedom(entry.freedom),
                                              law_text(entry.law, entry.freedom < dimension ? "N" : "N m")));
    for (const ContactScene& contact : solid.contacts)
        rows.emplace_back("contact", fmt::format("{}: {} with a {}, friction {:g}", contact.name, contact.surface,
                                                 word(ground_words, contact.shape), contact.friction));
    for (const GroundMotionScene& motion : solid.ground_motions)
        rows.emplace_back("ground", fmt::format("{} moves along {}: {}", motion.contact,
                                                word(direction_words, motion.along), law_text(motion.law, "m")));
}

std::string solid_table(const SolidScene& solid, int dimension) {
    std::vector<Row> rows{{"name", solid.name}};
    if (solid.box) {
        rows.emplace_back("body", box(*solid.box));
        const int nodes = dimension == 2 ? 4 * solid.element_order : solid.element_order == 1 ? 8 : 20;
        rows.emplace_back(
            "elements",
            fmt::format("{}, {} nodes each",
                        fmt::join(solid.elements.begin(), solid.elements.begin() + dimension, " × "), nodes));
    } else {
        rows.emplace_back("mesh", solid.mesh.filename().string());
    }
    if (dimension == 2) rows.emplace_back("plane", std::string(word(plane_words, solid.plane)));
    material_rows(rows, solid.material, "");
    for (const PartScene& part : solid.parts) material_rows(rows, part.material, " of " + part.set);
    if (solid.is_static)
        rows.emplace_back("time scheme", "static: an equilibrium at the end of every step");
    else if (solid.scheme == solid::Scheme::central_difference)
        rows.emplace_back("time scheme", "central differences, explicit");
    else
        rows.emplace_back(
            "time scheme",
            fmt::format("{}, αs = {:g}", solid.scheme == solid::Scheme::hht ? "HHT" : "Newmark", solid.alpha));
    if (solid.step > 0) rows.emplace_back("step", quantity(solid.step, "s"));
    if (solid.velocity) rows.emplace_back("velocity at first", point(*solid.velocity) + " m/s");
    if (solid.static_start) rows.emplace_back("start", "equilibrium under its own weight and loads");
    for (const Clamp& clamp : solid.clamps) {
        std::string directions;
        for (std::size_t d = 0; d < 3; ++d)
            if (clamp.fixed[d]) directions += "xyz"[d];
        rows.emplace_back("clamped", fmt::format("{} ({})", clamp.set, directions));
    }
    for (const TractionScene& traction : solid.tractions)
        rows.emplace_back("traction", fmt::format("{} N/m² on {}{}", point(traction.value), traction.surface,
                                                  factor_text(traction.factor)));
    for (const ForceScene& force : solid.forces)
        rows.emplace_back("force", fmt::format("{} N {}{}", point(force.value),
                                               force.point ? "at " + point(*force.point) + " m" : "on " + force.set,
                                               factor_text(force.factor)));
    condition_rows(rows, solid, dimension);
    if (!solid.wet.empty()) rows.emplace_back("wet", fmt::format("{}", fmt::join(solid.wet, ", ")));
    for (const Track& track : solid.tracks)
        rows.emplace_back("track", fmt::format("{} at {} m", track.name, point(track.point)));
    return table("Solid (finite elements)", rows);
}

std::string shape(const WallScene& wall) {
    if (wall.box) return "box";
    if (wall.rectangle) return "rectangle";
    if (wall.extrusion) return "extruded polyline";
    if (wall.round) return wall.round->centre.dimension() == 2 ? "circle" : "sphere";
    if (wall.cylinder) return "cylinder";
    if (wall.stl) return wall.stl->file.filename().string();
    return fmt::format("{} points{}", wall.points.size(), wall.closed ? ", closed" : "");
}

std::string family_class(std::string_view family) {
    constexpr std::array<std::string_view, 4> known{"fluid", "solid", "coupling", "output"};
    return std::find(known.begin(), known.end(), family) != known.end() ? std::string(family) : "other";
}

std::string rate(double per_second, std::string_view what) {
    if (per_second >= 1e6) return fmt::format("{:.3g} M {}/s", per_second / 1e6, what);
    if (per_second >= 1e3) return fmt::format("{:.3g} k {}/s", per_second / 1e3, what);
    return fmt::format("{:.3g} {}/s", per_second, what);
}

}  // namespace

std::string html_escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:
                safe += c;
        }
    return safe;
}

std::string quantity(double value, std::string_view unit) {
    if (!std::isfinite(value)) return "–";
    static constexpr std::array<std::string_view, 6> takes_prefix{"m", "s", "Pa", "N", "J", "W"};
    const std::string_view leading = unit.substr(0, unit.find('/'));
    const bool prefixed = std::find(takes_prefix.begin(), takes_prefix.end(), leading) != takes_prefix.end();
    static constexpr std::array<std::pair<double, std::string_view>, 7> prefixes{
        {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}}};
    if (prefixed && value != 0)
        for (const auto& [factor, prefix] : prefixes)
            if (std::abs(value) >= 0.9995 * factor) return fmt::format("{:.3g} {}{}", value / factor, prefix, unit);
    return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string duration(double seconds) {
    if (!(seconds >= 0) || !std::isfinite(seconds)) return "–";
    if (seconds < 99.95) return fmt::format("{:.3g} s", seconds);
    const auto whole = static_cast<long long>(std::llround(seconds));
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string key_number_cards(const Report& report, const std::vector<Comparison>& comparisons) {
    std::string text;
    const auto card = [&](std::string_view label, std::string_view value, std::string_view unit,
                          std::string_view note) {
        text += fmt::format(
            "<div class=\"card\"><div class=\"label\">{}</div><div class=\"value\">{}<span "
            "class=\"unit\">{}{}</span></div>"
            "<div class=\"note\">{}</div></div>\n",
            html_escaped(label), html_escaped(value), unit.empty() ? "" : " ", html_escaped(unit), html_escaped(note));
    };
    for (const Comparison& comparison : comparisons) {
        if (!comparison.error || comparison.points == 0) continue;
        const std::string rms = quantity(comparison.rms, comparison.unit);
        const std::size_t blank = rms.find(' ');
        card(fmt::format("{} against {}", comparison.column, comparison.label), rms.substr(0, blank),
             blank == std::string::npos ? "" : rms.substr(blank + 1),
             fmt::format("RMS, {:.1f} % of the peak; {}, {:g}–{:g} s", 100 * comparison.normalised,
                         counted(long(comparison.points), "point"), comparison.window[0], comparison.window[1]));
    }
    for (const KeyNumber& number : report.key_numbers) card(number.label, number.value, number.unit, number.note);
    return text.empty() ? "" : "<div class=\"cards\">\n" + text + "</div>\n";
}

std::string comparison_table(const std::vector<Comparison>& comparisons) {
    std::string rows;
    for (const Comparison& c : comparisons) {
        if (!c.error) continue;
        rows += fmt::format(
            "<tr><td><code>{}</code></td><td>{}</td><td>{:g} – {:g} s</td><td class=\"number\">{}{}</td>"
            "<td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
            "<td class=\"number\">{}</td></tr>\n",
            html_escaped(c.column), html_escaped(c.label), c.window[0], c.window[1], c.points,
            c.points == c.points_in_window ? "" : fmt::format(" of {}", c.points_in_window), quantity(c.rms, c.unit),
            c.points ? fmt::format("{:.1f} %", 100 * c.normalised) : "–", quantity(c.mean, c.unit),
            c.points ? fmt::format("{} at {}", quantity(c.largest, c.unit), quantity(c.largest_time, "s")) : "–");
    }
    if (rows.empty()) return {};
    return "<div class=\"wide\"><table class=\"list\"><thead><tr><th>column</th><th>reference</th><th>window</th><th "
           "class=\"number\">points</th>"
           "<th class=\"number\">RMS error</th><th class=\"number\">of the peak</th><th class=\"number\">mean "
           "error</th><th class=\"number\">largest "
           "error</th></tr></thead><tbody>\n" +
           rows + "</tbody></table></div>\n";
}

std::string task_table(const Report& report) {
    if (report.tasks.empty()) return {};
    std::vector<TaskTiming> tasks = report.tasks;
    std::stable_sort(tasks.begin(), tasks.end(),
                     [](const TaskTiming& a, const TaskTiming& b) { return a.seconds > b.seconds; });
    const double sum =
        std::accumulate(tasks.begin(), tasks.end(), 0.0, [](double s, const TaskTiming& t) { return s + t.seconds; });
    const double whole = report.wall_seconds > 0 ? report.wall_seconds : sum,
                 longest = std::max(tasks.front().seconds, 1e-300);
    std::string text =
        "<div class=\"wide\"><table class=\"list tasks\"><thead><tr><th>task</th><th>family</th><th "
        "class=\"bars\"></th><th class=\"number\">time</th>"
        "<th class=\"number\">share</th><th class=\"number\">runs</th><th class=\"number\">per run</th><th "
        "class=\"number\">rate</th></tr></thead><tbody>\n";
    for (const TaskTiming& task : tasks)
        text += fmt::format(
            "<tr><td>{}</td><td>{}</td><td class=\"bars\"><div class=\"bar {}\" style=\"width:{:.2f}%\"></div></td><td "
            "class=\"number\">{}</td>"
            "<td class=\"number\">{:.1f} %</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
            "class=\"number\">{}</td></tr>\n",
            html_escaped(task.name), html_escaped(task.family), family_class(task.family), 100 * task.seconds / longest,
            duration(task.seconds), whole > 0 ? 100 * task.seconds / whole : 0, task.calls,
            task.calls ? quantity(task.seconds / static_cast<double>(task.calls), "s") : "–",
            task.pairs > 0 && task.seconds > 0 ? html_escaped(rate(task.pairs / task.seconds, task.work_name)) : "–");
    text += "</tbody></table></div>\n";
    return text + fmt::format(
                      "<p class=\"remark\">Shares are of the {} that the run took. Tasks run side by side, so they may "
                      "add up to more "
                      "than 100 %.</p>\n",
                      duration(whole));
}

std::string parameter_tables(const Scene& scene) {
    std::string text = "<div class=\"facts-grid\">\n";
    if (scene.fluid) text += fluid_table(*scene.fluid);
    if (scene.solid) text += solid_table(*scene.solid, scene.dimension);
    std::vector<Row> rows{
        {"simulated time", fmt::format("{:g} s", scene.end_time)},
        {"gravity", fmt::format("{} m/s²", point(scene.gravity))},
        {"domain",
         fmt::format(
             "{}, {}{}", box(scene.domain), scene.edge == DomainEdge::open ? "open" : "closed",
             scene.periodic.empty() ? "" : fmt::format(", periodic along {}", fmt::join(scene.periodic, ", ")))}};
    if (scene.fluid && scene.solid) {
        const CouplingScene& coupling = scene.coupling;
        const bool cps = coupling.algorithm == CouplingAlgorithm::cps;
        const bool css = coupling.algorithm == CouplingAlgorithm::css;
        rows.emplace_back("coupling", cps   ? "CPS (parallel)"
                                      : css ? "CSS (sequential)"
                                            : fmt::format("iterated to {:g}", coupling.tolerance));
        rows.emplace_back("fluid steps per solid step p",
                          fmt::format("{}{}", coupling.ratio_control ? "regulated, at most " : "", coupling.ratio));
        std::string load(word(load_words, coupling.load));
        std::replace(load.begin(), load.end(), '_', ' ');
        rows.emplace_back("load", load);
        rows.emplace_back("extrapolation of wet nodes", std::string(word(extrapolation_words, coupling.extrapolation)));
        if (!css)
            rows.emplace_back("step, of the CFL step",
                              fmt::format("{:g}{}", coupling.step_fraction,
                                          coupling.step_rule == coupling::StepRule::predicted ? ", predicted" : ""));
    }
    for (const WallScene& wall : scene.walls)
        rows.emplace_back("wall", fmt::format("{}, {}{}, {}", wall.name, shape(wall), wall.motion ? ", moves" : "",
                                              wall.slip == Slip::free   ? "free slip"
                                              : wall.slip == Slip::none ? "no slip"
                                                                        : "symmetry"));
    return text + table("Run", rows) + "</div>\n";
}

}  // namespace aquagraph::io
