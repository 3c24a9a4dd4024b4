#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "io/atomic_file.hpp"
#include "io/scene_dimension.hpp"
#include "io/scene_formulas.hpp"
#include "io/scene_geometry_reader.hpp"
#include "io/scene_solid_reader.hpp"
#include "io/scene_validation.hpp"
#include "io/scene_words.hpp"
#include "io/suggestion.hpp"
#include "io/toml_document.hpp"

namespace aquagraph::io {
namespace {

// K of Δt = K R/c that is stable with room to spare: the dam break at R/Δx 4 blows up at 0.75 (RK4), beyond 0.5 (RK3)
// and at 0.3 (Verlet).
double standard_cfl(fluid::IntegrationScheme scheme) {
    switch (scheme) {
        case fluid::IntegrationScheme::rk3:
            return 0.35;
        case fluid::IntegrationScheme::verlet:
            return 0.15;
        default:
            return 0.375;
    }
}

// Moves what the document says into the scene; what is not given keeps the default that scene.hpp states.
class Filler {
  public:
    Filler(const CheckedDocument& document, Complaints& complaints, Scene& scene)
        : document_(document), complaints_(complaints), scene_(scene) {}

    void everything() {
        scene_.constants = resolve_constants(document_, complaints_);
        document_.take("title", scene_.title);
        scene_.dimension = agree_on_dimension(document_, complaints_);
        if (scene_.dimension == 3) scene_.gravity = Point(0, 0, -9.81);
        document_.take("gravity", scene_.gravity);
        document_.take("time.end", scene_.end_time);
        document_.take("domain.min", scene_.domain.min);
        document_.take("domain.max", scene_.domain.max);
        choose("domain.edge", scene_.edge, {{"closed", DomainEdge::closed}, {"open", DomainEdge::open}});
        document_.take("domain.periodic", scene_.periodic);
        if (document_.count("fluid")) fluid(scene_.fluid.emplace());
        walls();
        if (document_.count("solid")) read_solid(document_, complaints_, scene_);
        probes();
        coupling(scene_.coupling);
        scene_.output.frame_interval = scene_.end_time / 100;
        document_.take("output.frame_interval", scene_.output.frame_interval);
        document_.take("output.history_interval", scene_.output.history_interval);
        document_.take("output.checkpoint_interval", scene_.output.checkpoint_interval);
        document_.take("output.energy_ledger", scene_.output.energy_ledger);
        document_.take("output.interface_loads", scene_.output.interface_loads);
        columns();
        comparisons();
    }

  private:
    void coupling(CouplingScene& coupling) {
        choose("coupling.algorithm", coupling.algorithm, algorithm_words);
        document_.take("coupling.ratio", coupling.ratio);
        document_.take("coupling.ratio_control", coupling.ratio_control);
        choose("coupling.load", coupling.load, load_words);
        document_.take("coupling.energy_cycles", coupling.energy_cycles);
        choose("coupling.extrapolation", coupling.extrapolation, extrapolation_words);
        document_.take("coupling.smoothing", coupling.smoothing);
        choose("coupling.step_rule", coupling.step_rule, step_rule_words);
        if (coupling.step_rule == coupling::StepRule::predicted) coupling.step_fraction = 1;
        document_.take("coupling.step_fraction", coupling.step_fraction);
        choose("coupling.relaxation", coupling.relaxation, relaxation_words);
        document_.take("coupling.tolerance", coupling.tolerance);
        document_.take("coupling.most_iterations", coupling.most_iterations);
    }

    template <class E>
    void choose(const std::string& key, E& target, std::initializer_list<std::pair<std::string_view, E>> meanings) {
        take_choice(document_, key, target, meanings);
    }

    template <class E, std::size_t n>
    void choose(const std::string& key, E& target, const Words<E, n>& meanings) {
        take_choice(document_, key, target, meanings);
    }

    std::filesystem::path beside_the_scene(const std::string& path) const {
        return (scene_.file.parent_path() / path).lexically_normal();
    }

    void fluid(FluidScene& fluid) {
        document_.take("fluid.spacing", fluid.spacing);
        document_.take("fluid.density", fluid.density);
        document_.take("fluid.sound_speed", fluid.sound_speed);
        document_.take("fluid.polytropic_exponent", fluid.polytropic_exponent);
        document_.take("fluid.support_ratio", fluid.support_ratio);
        choose("fluid.kernel", fluid.kernel, kernel_words);
        choose("fluid.integration", fluid.integration, integration_words);
        fluid.cfl = standard_cfl(fluid.integration);
        document_.take("fluid.cfl", fluid.cfl);
        choose("fluid.scheme.name", fluid.scheme.name, scheme_words);
        choose("fluid.scheme.reconstruction", fluid.scheme.reconstruction,
               {{"muscl", Reconstruction::muscl}, {"none", Reconstruction::none}});
        choose("fluid.scheme.riemann_solver", fluid.scheme.riemann_solver, riemann_solver_words);
        document_.take("fluid.scheme.delta", fluid.scheme.delta);
        fluid.scheme.alpha = fluid.scheme.name == fluid::Scheme::artificial_viscosity ? 0.05 : 0.01;
        document_.take("fluid.scheme.alpha", fluid.scheme.alpha);
        document_.take("fluid.viscosity.dynamic", fluid.viscosity);
        choose("fluid.viscosity.operator", fluid.viscous_operator, viscous_operator_words);
        choose("fluid.transport.name", fluid.transport, transport_words);
        document_.take("fluid.transport.epsilon", fluid.x_sph);
        choose("fluid.walls", fluid.walls, {{"ghosts", WallMethod::ghosts}, {"normal_flux", WallMethod::normal_flux}});
        choose("fluid.initial_pressure", fluid.initial_pressure,
               {{"hydrostatic", InitialPressure::hydrostatic}, {"zero", InitialPressure::zero}});
        if (double level = 0; document_.take("fluid.surface_level", level)) fluid.surface_level = level;
        for (int i = 0; i < document_.count("fluid.box"); ++i) {
            Box& box = fluid.boxes.emplace_back();
            document_.take(fmt::format("fluid.box[{}].min", i), box.min);
            document_.take(fmt::format("fluid.box[{}].max", i), box.max);
        }
        document_.take("fluid.relax", fluid.relax);
        document_.take("fluid.relax_tolerance", fluid.relax_tolerance);
        read_water(document_, scene_.file.parent_path(), scene_.dimension, fluid);
        if (Point force; document_.take("fluid.driving_force", force)) fluid.driving_force = force;
        document_.take("fluid.initial.velocity", fluid.initial.velocity);
        document_.take("fluid.initial.pressure", fluid.initial.pressure);
        if (document_.count("fluid.central_force")) {
            fluid.central_force.emplace();
            document_.take("fluid.central_force.centre", fluid.central_force->centre);
            document_.take("fluid.central_force.rate", fluid.central_force->rate);
        }
    }

    void walls() {
        for (int i = 0; i < document_.count("wall"); ++i) {
            WallScene& wall = scene_.walls.emplace_back();
            const std::string at = fmt::format("wall[{}].", i);
            document_.take(at + "name", wall.name);
            document_.take(at + "points", wall.points);
            document_.take(at + "closed", wall.closed);
            document_.take(at + "force", wall.force);
            choose(at + "slip", wall.slip, slip_words);
            read_wall_geometry(document_, fmt::format("wall[{}]", i), scene_.file.parent_path(), wall);
        }
    }

    void probes() {
        for (int i = 0; i < document_.count("probe"); ++i) {
            ProbeScene& probe = scene_.probes.emplace_back();
            const std::string at = fmt::format("probe[{}].", i);
            document_.take(at + "name", probe.name);
            choose(at + "quantity", probe.quantity,
                   {{"pressure", ProbeQuantity::pressure},
                    {"velocity", ProbeQuantity::velocity},
                    {"level", ProbeQuantity::level}});
            document_.take(at + "point", probe.point);
            document_.take(at + "wall", probe.wall);
            choose(at + "interpolation", probe.interpolation,
                   {{"shepard", ProbeInterpolation::shepard}, {"linear", ProbeInterpolation::linear}});
        }
    }

    void columns() {
        for (int i = 0; i < document_.count("integral"); ++i) {
            Integral& integral = scene_.integrals.emplace_back();
            const std::string at = fmt::format("integral[{}].", i);
            document_.take(at + "name", integral.name);
            document_.take(at + "value", integral.value);
            document_.take(at + "weight", integral.weight);
            document_.take(at + "unit", integral.unit);
        }
        for (int i = 0; i < document_.count("extreme"); ++i) {
            Extreme& extreme = scene_.extremes.emplace_back();
            const std::string at = fmt::format("extreme[{}].", i);
            document_.take(at + "name", extreme.name);
            document_.take(at + "value", extreme.value);
            choose(at + "of", extreme.largest, {{"largest", true}, {"smallest", false}});
            document_.take(at + "where", extreme.where);
            document_.take(at + "unit", extreme.unit);
        }
        for (int i = 0; i < document_.count("field_error"); ++i) {
            FieldError& error = scene_.field_errors.emplace_back();
            const std::string at = fmt::format("field_error[{}].", i);
            document_.take(at + "name", error.name);
            document_.take(at + "velocity", error.velocity);
            document_.take(at + "pressure", error.pressure);
            document_.take(at + "where", error.where);
            if (double scale = 0; document_.take(at + "velocity_scale", scale)) error.velocity_scale = scale;
            if (double scale = 0; document_.take(at + "pressure_scale", scale)) error.pressure_scale = scale;
        }
    }

    void comparisons() {
        for (int i = 0; i < document_.count("compare"); ++i) {
            Compare& compare = scene_.comparisons.emplace_back();
            const std::string at = fmt::format("compare[{}].", i);
            document_.take(at + "column", compare.column);
            if (std::string file; document_.take(at + "file", file)) compare.file = beside_the_scene(file);
            document_.take(at + "formula", compare.formula);
            if (double scale = 0; document_.take(at + "scale", scale)) compare.scale = scale;
            document_.take(at + "label", compare.label);
            compare.window = {0, scene_.end_time};
            document_.take(at + "window", compare.window);
            document_.take(at + "time_scale", compare.time_scale);
            document_.take(at + "value_scale", compare.value_scale);
            document_.take(at + "value_offset", compare.value_offset);
            document_.take(at + "change", compare.change);
            document_.take(at + "error", compare.error);
        }
    }

    const CheckedDocument& document_;
    Complaints& complaints_;
    Scene& scene_;
};

std::string result_name(const std::filesystem::path& scene_file) {
    const std::string folder = scene_file.parent_path().filename().string(), stem = scene_file.stem().string();
    if (folder.empty()) return stem;
    return stem == "scene" ? folder : folder + "_" + stem;
}

}  // namespace

void check_compared_columns(const Scene& scene, std::span<const std::string> columns) {
    std::vector<SceneComplaint> complaints;
    for (std::size_t i = 0; i < scene.comparisons.size(); ++i) {
        const std::string& column = scene.comparisons[i].column;
        if (std::find(columns.begin(), columns.end(), column) != columns.end()) continue;
        const std::string key = fmt::format("compare[{}].column", i);
        const auto guess = nearest(column, columns);
        complaints.push_back({key, position_of(scene.positions, key),
                              fmt::format("history.csv will have no column \"{}\"", column),
                              guess ? fmt::format("did you mean \"{}\"?", *guess)
                                    : fmt::format("it will have {}", fmt::join(columns, ", "))});
    }
    if (!complaints.empty()) throw SceneError(scene.file, scene.text, std::move(complaints));
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
    Scene scene;
    int lines = 0;
    try {
        if (std::filesystem::is_directory(file))
            throw std::system_error(std::make_error_code(std::errc::is_a_directory));
        scene.file = std::filesystem::absolute(file).lexically_normal();
        scene.text = read_file(file);
        scene.overrides.assign(overrides.begin(), overrides.end());
        if (!overrides.empty() && !scene.text.ends_with('\n')) scene.text += '\n';
        lines = int(std::count(scene.text.begin(), scene.text.end(), '\n'));
        for (const std::string& override : overrides) scene.text += fmt::format("{}{}\n", override_mark, override);
    } catch (const std::system_error& error) {
        throw SceneError(file, {},
                         {{"",
                           {},
                           "the scene cannot be read: " + error.code().message(),
                           "give the path of a scene file, such as benchmarks/gate_2d/scene.toml"}});
    }
    scene.name = result_name(scene.file);
    scene.title = scene.name;

    Complaints complaints;
    const CheckedDocument document = check_document(scene_table(), scene.text, complaints, scene.overrides, lines + 1);
    if (complaints.touch("case"))
        throw SceneError(
            file, scene.text,
            {{"", {}, "this is a study, not a scene", "give it to `aquagraph study`, or one of its scenes"}});
    // A file that is no TOML, or of another version, says nothing about what else may be wrong in it.
    if (!complaints.positions.empty() && !complaints.touch("schema_version")) {
        Filler(document, complaints, scene).everything();
        validate(scene, complaints);
    }
    if (!complaints.empty()) throw SceneError(file, scene.text, complaints.in_order_of_the_file());
    scene.positions = std::move(complaints.positions);
    return scene;
}

}  // namespace aquagraph::io
