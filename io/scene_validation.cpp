#include "io/scene_validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>

#include "io/comparison.hpp"
#include "io/scene_formulas.hpp"
#include "io/scene_geometry_validation.hpp"
#include "io/scene_keys.hpp"
#include "io/scene_solid_validation.hpp"
#include "io/suggestion.hpp"
#include "physics/fluid/walls/damping.hpp"

namespace aquagraph::io {
namespace {

// Corners that meet to within this part of a spacing or length touch; they do not overlap.
constexpr double touching = 1e-6;

constexpr std::array<std::string_view, 3> axis{"x", "y", "z"};

std::string text(const Point& point) {
    return fmt::format("[{}]", fmt::join(point, ", "));
}

std::string text(const Box& box) {
    return text(box.min) + " – " + text(box.max);
}

std::string element(std::string_view list, std::size_t i, std::string_view key = {}) {
    return fmt::format("{}[{}]{}{}", list, i, key.empty() ? "" : ".", key);
}

std::optional<Box> overlap(const Box& a, const Box& b, double tolerance) {
    Box common = a;
    for (std::size_t d = 0; d < a.min.size(); ++d) {
        common.min[d] = std::max(a.min[d], b.min[d]);
        common.max[d] = std::min(a.max[d], b.max[d]);
        if (common.max[d] - common.min[d] <= tolerance) return std::nullopt;
    }
    return common;
}

class Validation {
  public:
    Validation(const Scene& scene, Complaints& complaints) : scene_(scene), complaints_(complaints) {}

    void parts() {
        const bool fluid = scene_.fluid.has_value(), solid = scene_.solid.has_value();
        if (!fluid && !solid && !complaints_.touch("fluid") && !complaints_.touch("solid"))
            complaints_.add_at({1, 1}, "fluid", "the scene has neither [fluid] nor [solid]",
                               "give at least one of them");
        if (complaints_.positions.contains("coupling") && fluid != solid)
            complaints_.add(
                "coupling",
                fmt::format("[coupling] needs a fluid and a solid, but there is no [{}]", fluid ? "solid" : "fluid"),
                fmt::format("add [{}] or take [coupling] out", fluid ? "solid" : "fluid"));
        if (solid && fluid && scene_.dimension == 3)
            complaints_.add("solid", "in three dimensions a solid is not coupled with water yet",
                            "take [solid] out, or [fluid], or make the scene two-dimensional: [domain] min = [x, y]");
        if (!fluid && !scene_.walls.empty() && !complaints_.touch("fluid"))
            complaints_.add("wall[0]", "walls hold water, and there is none in this scene",
                            "take the walls out, or add [fluid]");
        if (!fluid) return;
        if (scene_.fluid->boxes.empty() && scene_.fluid->regions.empty() && !complaints_.touch("fluid.box"))
            complaints_.add("fluid", "[fluid] has no water in it", "add at least one [[fluid.box]] with min and max");
    }

    // Choices of the fluid's method that do not go together.
    void fluid_scheme() {
        if (scene_.output.interface_loads && !(scene_.fluid && scene_.solid))
            complaints_.add("output.interface_loads", "there are no loads between water and a body in this scene",
                            "take it out, or add what is missing, [fluid] or [solid]");
        if (scene_.output.interface_loads && complaints_.positions.contains("output.history_interval"))
            complaints_.add("output.interface_loads", "loads are of use with a row for every coupling cycle only",
                            "take `history_interval` out, or interface_loads = false");
        if (!scene_.fluid) return;
        const FluidScene& fluid = *scene_.fluid;
        const bool riemann =
            fluid.scheme.name == fluid::Scheme::riemann || fluid.scheme.name == fluid::Scheme::riemann_ale;
        if (fluid.scheme.riemann_solver == fluid::RiemannSolver::exact && fluid.polytropic_exponent != 7 &&
            !complaints_.touch("fluid.scheme.riemann_solver"))
            complaints_.add(
                "fluid.scheme.riemann_solver",
                fmt::format("the exact Riemann solver is for water, polytropic_exponent = 7, but it is {:g}",
                            fluid.polytropic_exponent),
                "take \"acoustic\", which serves every exponent");
        if (scene_.output.energy_ledger && fluid.driving_force)
            complaints_.add("output.energy_ledger", "the energy ledger has no column for the work of a driving force",
                            "take [fluid] driving_force out, or energy_ledger = false");
        if (scene_.output.energy_ledger && fluid.scheme.name == fluid::Scheme::riemann_ale)
            complaints_.add("output.energy_ledger", "the energy ledger is for schemes that keep each particle's mass",
                            "choose another [fluid.scheme], or energy_ledger = false");
        for (const char* key : {"reconstruction", "riemann_solver"})
            if (!riemann && complaints_.positions.contains(std::string("fluid.scheme.") + key))
                complaints_.add(std::string("fluid.scheme.") + key,
                                fmt::format("`{}` belongs to the Riemann schemes", key),
                                "take it out, or choose name = \"riemann\"");
        for (const char* key : {"delta", "alpha"})
            if (complaints_.positions.contains(std::string("fluid.scheme.") + key) &&
                (riemann || (*key == 'd' && fluid.scheme.name != fluid::Scheme::delta_sph)))
                complaints_.add(std::string("fluid.scheme.") + key,
                                fmt::format("`{}` does nothing in this scheme", key),
                                "take it out: it belongs to delta_sph (delta, alpha) or artificial_viscosity (alpha)");
        if (fluid.transport == fluid::Transport::shifting && fluid.scheme.name != fluid::Scheme::riemann_ale &&
            !complaints_.touch("fluid.transport.name"))
            complaints_.add("fluid.transport.name",
                            "shifted particles must exchange mass and momentum, which this scheme does not",
                            "choose [fluid.scheme] name = \"riemann_ale\", or no shifting");
    }

    // What would be read and then do nothing.
    void idle_keys() {
        if (!scene_.fluid) {
            idle("output.energy_ledger", !complaints_.touch("fluid"), "a body alone has its energies as columns anyway",
                 "take it out, or add [fluid]");
            idle("domain.periodic", !complaints_.touch("fluid"), "only water goes round a periodic domain",
                 "take it out, or add [fluid]");
            return;
        }
        const FluidScene& fluid = *scene_.fluid;
        idle("fluid.transport.epsilon", fluid.transport != fluid::Transport::x_sph, "`epsilon` belongs to X-SPH",
             "take it out, or choose name = \"x_sph\"");
        idle("fluid.relax_tolerance", !fluid.relax, "nothing is relaxed in this scene",
             "take it out, or give relax = true");
    }

    // Keys that do nothing, and loads that a scheme cannot give.
    void coupling() {
        const CouplingScene& coupling = scene_.coupling;
        for (const char* key : {"coupling.relaxation", "coupling.tolerance", "coupling.most_iterations"})
            idle(key, coupling.algorithm != CouplingAlgorithm::iterated, "only the iterated algorithm iterates",
                 "take it out, or choose algorithm = \"iterated\"");
        // "fixed" is what css does not know either, but says nothing that it does not do: studies set it for all.
        idle("coupling.step_rule",
             coupling.algorithm == CouplingAlgorithm::css && coupling.step_rule == coupling::StepRule::predicted,
             "css chooses every step anew and predicts none",
             "take it out, or choose algorithm = \"cps\" or \"iterated\"");
        const bool energy = coupling.load == coupling::LoadMethod::energy_conservative;
        idle("coupling.energy_cycles", !energy, "only the energy-conservative load averages over cycles",
             "take it out, or choose load = \"energy_conservative\"");
        if (energy && scene_.fluid && scene_.fluid->scheme.name == fluid::Scheme::riemann_ale)
            complaints_.add("coupling.load", "energies are only known of schemes that keep each particle's mass",
                            "choose another [fluid.scheme], or load = \"force_conservative\"");
    }

    // What walls of normal fluxes do not go with.
    void wall_method() {
        if (!scene_.fluid || scene_.fluid->walls != WallMethod::normal_flux || complaints_.touch("fluid.walls")) return;
        const FluidScene& fluid = *scene_.fluid;
        const std::string help = "take [fluid] walls = \"ghosts\"";
        // Measured on benchmarks/still_tank (its README).
        if (fluid.scheme.name == fluid::Scheme::artificial_viscosity)
            complaints_.add("fluid.walls",
                            "without diffusion of density water does not stay still between walls of normal fluxes, "
                            "whatever alpha is",
                            help + ", or another [fluid.scheme] name");
        if (fluid.scheme.name == fluid::Scheme::delta_sph &&
            (fluid.scheme.alpha < fluid::least_wall_alpha || fluid.scheme.delta < fluid::least_wall_delta))
            complaints_.add(
                "fluid.walls",
                fmt::format(
                    "with less than delta = {} and alpha = {} water does not stay still between walls of normal "
                    "fluxes: with alpha = 0.05 its pressure is wrong by 28 % over the first 5 s",
                    fluid::least_wall_delta, fluid::least_wall_alpha),
                fmt::format("give [fluid.scheme] alpha = {}, or take [fluid] walls = \"ghosts\"",
                            fluid::least_wall_alpha));
    }

    // Whether max lies beyond min; without it no other check of the box makes sense.
    bool ordered(const Box& box, const std::string& key) {
        if (complaints_.touch(key + ".min") || complaints_.touch(key + ".max")) return false;
        for (std::size_t d = 0; d < box.min.size(); ++d)
            if (!(box.max[d] > box.min[d])) {
                complaints_.add(key + ".max",
                                fmt::format("`max` must lie beyond `min`, but in {} it is {} and `min` is {}", axis[d],
                                            box.max[d], box.min[d]),
                                "min is the lower left corner, max the upper right one");
                return false;
            }
        return true;
    }

    void fluid_boxes() {
        if (!scene_.fluid) return;
        const FluidScene& fluid = *scene_.fluid;
        const bool spacing_known = !complaints_.touch("fluid.spacing");
        const double tolerance = spacing_known ? touching * fluid.spacing : 0;
        const bool domain_known = !complaints_.touch("domain") && complaints_.positions.contains("domain");
        std::vector<bool> sound(fluid.boxes.size());
        double particles = 0;
        for (std::size_t i = 0; i < fluid.boxes.size(); ++i) {
            const Box& box = fluid.boxes[i];
            sound[i] = ordered(box, element("fluid.box", i));
            if (!sound[i]) continue;
            if (spacing_known) {
                thin(box, i, fluid.spacing);
                double cells = 1;
                for (std::size_t d = 0; d < box.min.size(); ++d) cells *= (box.max[d] - box.min[d]) / fluid.spacing;
                particles += cells;
            }
            if (domain_known) inside_domain(box, i, tolerance);
            for (std::size_t j = 0; j < i; ++j)
                if (const auto common = overlap(box, fluid.boxes[j], tolerance); sound[j] && common)
                    complaints_.add(
                        element("fluid.box", i),
                        fmt::format("water box {} overlaps water box {} in {}", i + 1, j + 1, text(*common)),
                        "boxes may share an edge, not an area: particles would stand in each other");
            if (scene_.dimension == 2 && scene_.solid && scene_.solid->box && !complaints_.touch("solid.box"))
                if (const auto common = overlap(box, *scene_.solid->box, tolerance))
                    complaints_.add(element("fluid.box", i),
                                    fmt::format("water box {} overlaps the solid box in {}", i + 1, text(*common)),
                                    fmt::format("let it end at the solid, which fills {}", text(*scene_.solid->box)));
        }
        if (particles > most_particles)
            complaints_.add(
                "fluid.spacing",
                fmt::format("the water would be {:.2g} particles, more than {:.2g}", particles, most_particles),
                "take a larger spacing, or less water");
    }

    void periodic(bool domain_known) {
        for (std::size_t k = 0; k < scene_.periodic.size(); ++k) {
            const std::string& direction = scene_.periodic[k];
            const auto found = std::find(axis.begin(), axis.end(), direction);
            const auto d = static_cast<std::size_t>(found - axis.begin());
            if (d >= static_cast<std::size_t>(scene_.dimension)) {
                complaints_.add("domain.periodic",
                                fmt::format("'{}' is no direction of a {}D scene", direction, scene_.dimension),
                                scene_.dimension == 2 ? "periodic = [\"x\"], [\"y\"] or both"
                                                      : "periodic = a list of \"x\", \"y\" and \"z\"");
                return;
            }
            if (scene_.gravity[d] != 0)
                complaints_.add("domain.periodic",
                                fmt::format("gravity acts along {}, and pressure would jump at the seam", direction),
                                "let gravity act across the periodic directions");
            if (!domain_known || !scene_.fluid || complaints_.touch("fluid")) continue;
            // The neighbour lists reach a quarter further than the kernel.
            const double reach = 1.25 * scene_.fluid->support_ratio * scene_.fluid->spacing,
                         period = scene_.domain.max[d] - scene_.domain.min[d];
            if (!(period > reach))
                complaints_.add("domain.periodic",
                                fmt::format("the period along {} is {} m, but must be longer than {} m, 1.25 "
                                            "support_ratio × spacing",
                                            direction, period, reach),
                                "make the domain longer or the spacing smaller");
        }
    }

    void walls() {
        for (std::size_t i = 0; i < scene_.walls.size(); ++i) {
            const std::string key = element("wall", i, "points");
            const std::vector<Point>& points = scene_.walls[i].points;
            if (complaints_.touch(key) || !complaints_.positions.contains(key)) continue;
            const auto fewest = static_cast<std::size_t>(scene_.dimension);  // a segment, a triangle
            if (points.size() < fewest) {
                complaints_.add(
                    key, fmt::format("a wall needs at least {} points, but this one has {}", fewest, points.size()),
                    fewest == 2 ? "points = [[x0, y0], [x1, y1], …] with the water on the left of the way"
                                : "points = [[x0, y0, z0], …], the corners of a flat convex face, counter-clockwise as "
                                  "seen from the water");
                continue;
            }
            if (scene_.dimension == 3 && scene_.walls[i].closed)
                complaints_.add(element("wall", i, "closed"), "a face is always closed: `closed` is for 2D scenes",
                                "take it out");
            for (std::size_t k = 1; k < points.size(); ++k)
                if (points[k] == points[k - 1])
                    complaints_.add(
                        element(key, k),
                        fmt::format("segment {} of the wall has no length: both its ends are {}", k, text(points[k])),
                        "take one of the two points out");
            if (scene_.walls[i].closed && points.front() == points.back())
                complaints_.add(element(key, points.size() - 1),
                                "the closing segment of the wall has no length: the first point is repeated",
                                "`closed = true` already joins the last point to the first");
        }
    }

    void names() {
        std::set<std::string> bodies, tracks;
        for (std::size_t i = 0; i < scene_.walls.size(); ++i)
            name(element("wall", i, "name"), scene_.walls[i].name, bodies);
        for (std::size_t i = 0; i < scene_.probes.size(); ++i)
            name(element("probe", i, "name"), scene_.probes[i].name, tracks);
        if (!scene_.solid) return;
        // "solid" is reserved for the solid, which is what it is called by default.
        if (scene_.solid->name != "solid") name("solid.name", scene_.solid->name, bodies);
        for (std::size_t i = 0; i < scene_.solid->tracks.size(); ++i)
            name(element("solid.track", i, "name"), scene_.solid->tracks[i].name, tracks);
        // These have columns as tracks have and columns as walls have.
        const auto both = [&](std::string_view list, const auto& entries) {
            for (std::size_t i = 0; i < entries.size(); ++i) {
                const std::string key = element(list, i, "name");
                name(key, entries[i].name, tracks);
                name(key, entries[i].name, bodies);
            }
        };
        const auto forces = [&](std::string_view list, const auto& entries) {
            for (std::size_t i = 0; i < entries.size(); ++i) name(element(list, i, "name"), entries[i].name, bodies);
        };
        forces("solid.clamp", scene_.solid->clamps);
        forces("solid.motion", scene_.solid->motions);
        both("solid.rigid_body", scene_.solid->rigid_bodies);
        both("solid.contact", scene_.solid->contacts);
    }

    void probes() {
        std::vector<std::string> walls;
        for (const WallScene& wall : scene_.walls) walls.push_back(wall.name);
        if (scene_.solid) walls.push_back(scene_.solid->name);
        for (std::size_t i = 0; i < scene_.probes.size(); ++i) {
            const ProbeScene& probe = scene_.probes[i];
            const std::string at = element("probe", i);
            if (!scene_.fluid && !complaints_.touch("fluid"))
                complaints_.add(at, "a probe needs water to measure in", "add [fluid] or take the probe out");
            if (probe.quantity == ProbeQuantity::level)
                for (const char* key : {"wall", "interpolation"})
                    if (complaints_.positions.contains(at + "." + key))
                        complaints_.add(at + "." + key, fmt::format("a level has no `{}`", key),
                                        "it is looked for along a line that stands still: take the key out");
            if (probe.wall.empty() || complaints_.touch(at + ".wall") || complaints_.touch("wall") ||
                std::find(walls.begin(), walls.end(), probe.wall) != walls.end())
                continue;
            const auto guess = nearest(probe.wall, walls);
            complaints_.add(at + ".wall", fmt::format("there is no wall \"{}\"", probe.wall),
                            guess           ? fmt::format("did you mean \"{}\"?", *guess)
                            : walls.empty() ? "the scene has no walls: take the key out"
                                            : fmt::format("there are {}", fmt::join(walls, ", ")));
        }
    }

    void comparisons() {
        for (std::size_t i = 0; i < scene_.comparisons.size(); ++i) {
            const Compare& compare = scene_.comparisons[i];
            if (!complaints_.touch(element("compare", i, "window")) && !complaints_.touch("time") &&
                !(compare.window[0] < compare.window[1]))
                complaints_.add(
                    element("compare", i, "window"),
                    fmt::format("`window` runs backwards, from {} s to {} s", compare.window[0], compare.window[1]),
                    "window = [from, to] with from < to");
            const std::string key = element("compare", i, "file");
            if (complaints_.touch(key) || complaints_.touch(element("compare", i, "formula"))) continue;
            if (compare.file.empty() == compare.formula.empty()) {
                complaints_.add(element("compare", i),
                                compare.file.empty() ? "there is nothing to compare with"
                                                     : "there are both a `file` and a `formula` to compare with",
                                "give either `file` or `formula`");
                continue;
            }
            if (compare.file.empty()) {
                finite_formula(compare, element("compare", i, "formula"));
                continue;
            }
            const std::string help = "two columns of numbers, time and value; the path is seen from the scene's folder";
            if (!std::filesystem::exists(compare.file)) {
                complaints_.add(
                    key, fmt::format("the file {} does not exist", compare.file.lexically_normal().string()), help);
                continue;
            }
            try {
                const std::vector<double> time = read_reference(compare).time;
                const std::string window = element("compare", i, "window");
                const auto inside = [&](double t) { return compare.window[0] <= t && t <= compare.window[1]; };
                if (compare.error && complaints_.positions.contains(window) && !complaints_.touch(window) &&
                    std::none_of(time.begin(), time.end(), inside))
                    complaints_.add(window,
                                    fmt::format("the file has no point between {} s and {} s, its points are between "
                                                "{} s and {} s",
                                                compare.window[0], compare.window[1], time.front(), time.back()),
                                    "take a window with points in it, or look at `time_scale`");
            } catch (const std::exception& error) {
                complaints_.add(key, fmt::format("the file cannot be used: {}", error.what()), help);
            }
        }
    }

  private:
    // Without a sample at which it is not a number; what is no formula at all is complained of elsewhere.
    void finite_formula(const Compare& compare, const std::string& key) {
        if (complaints_.touch("constants") || complaints_.touch("fluid") || !(compare.window[0] < compare.window[1]))
            return;
        try {
            const Curve curve = sampled_formula(compare, all_constants(scene_));
            for (std::size_t k = 0; k < curve.time.size(); ++k)
                if (!std::isfinite(curve.value[k])) {
                    complaints_.add(key, fmt::format("at t = {:g} s the formula is {}", curve.time[k], curve.value[k]),
                                    "a reference is a number at all times of `window`");
                    return;
                }
        } catch (const ExpressionError&) {
        }
    }

    void idle(const char* key, bool is_idle, const char* why, const char* help) {
        if (is_idle && complaints_.positions.contains(key) && !complaints_.touch(key)) complaints_.add(key, why, help);
    }

    static std::string_view extent(const Box& box, std::size_t d) {
        if (d + 1 == box.min.size()) return "high";
        return d == 0 ? "wide" : "deep";
    }

    void thin(const Box& box, std::size_t i, double spacing) {
        for (std::size_t d = 0; d < box.min.size(); ++d)
            if (const double width = box.max[d] - box.min[d]; width < (1 - touching) * spacing)
                complaints_.add(
                    element("fluid.box", i, "max"),
                    fmt::format("the box is {} m {}, less than one spacing of {} m", width, extent(box, d), spacing),
                    "a particle needs a cell of Δx in every direction: make the box larger or the spacing "
                    "smaller");
    }

    void inside_domain(const Box& box, std::size_t i, double tolerance) {
        const Box& domain = scene_.domain;
        for (std::size_t d = 0; d < box.min.size(); ++d)
            if (box.min[d] < domain.min[d] - tolerance || box.max[d] > domain.max[d] + tolerance) {
                complaints_.add(element("fluid.box", i),
                                fmt::format("water box {} reaches out of the domain {}", i + 1, text(domain)),
                                "make the domain larger: [domain] min and max must enclose all water");
                return;
            }
    }

    void name(const std::string& key, const std::string& given, std::set<std::string>& taken) {
        if (complaints_.touch(key) || given.empty()) return;
        const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
        const bool plain = letter(given.front()) && std::all_of(given.begin(), given.end(), [&](char c) {
                               return letter(c) || std::isdigit(static_cast<unsigned char>(c)) || c == '_';
                           });
        const auto reserved = reserved_names();
        if (!plain)
            complaints_.add(key, fmt::format("\"{}\" cannot be a name", given),
                            "letters, digits and _, beginning with a letter");
        else if (std::find(reserved.begin(), reserved.end(), given) != reserved.end())
            complaints_.add(key, fmt::format("the name \"{}\" is reserved for the results", given),
                            fmt::format("choose another; reserved are {}", fmt::join(reserved, ", ")));
        else if (!taken.insert(given).second)
            complaints_.add(key, fmt::format("the name \"{}\" is already taken", given),
                            "every name stands for one thing: choose another");
    }

    const Scene& scene_;
    Complaints& complaints_;
};

}  // namespace

void validate(const Scene& scene, Complaints& complaints) {
    Validation validation(scene, complaints);
    validation.parts();
    if (complaints.positions.contains("domain") && !complaints.touch("domain"))
        validation.ordered(scene.domain, "domain");
    validation.periodic(complaints.positions.contains("domain") && !complaints.touch("domain"));
    validate_solid(scene, complaints);
    validation.fluid_scheme();
    validation.idle_keys();
    validation.coupling();
    validation.wall_method();
    validation.fluid_boxes();
    validation.walls();
    validate_wall_shapes(scene, complaints);
    validate_motions(scene, complaints);
    validate_regions(scene, complaints);
    validation.names();
    validation.probes();
    validation.comparisons();
    validate_formulas(scene, complaints);
}

}  // namespace aquagraph::io
