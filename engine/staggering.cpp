#include "engine/staggering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/body_parts.hpp"
#include "physics/coupling/staggered_stability.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::engine {

namespace {

// Higher ones are too short along the wall to radiate, and cost more to find.
constexpr int most_modes = 24;
constexpr int most_ratio = 100;  // a scene can ask for no more

// Whether there is water within R in front of each panel.
std::vector<bool> in_contact(const fluid::Fluid<2>& fluid, const fluid::Panels<2>& panels) {
    const double reach = fluid.kernel.radius();
    std::vector<std::size_t> wet;
    fluid::Vec2 low = fluid::Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        if (!panels.panels[k].wet) continue;
        wet.push_back(k);
        for (std::size_t end = 0; end < 2; ++end) {
            low = low.cwiseMin(panels.vertex(k, end) - fluid::Vec2::Constant(reach));
            high = high.cwiseMax(panels.vertex(k, end) + fluid::Vec2::Constant(reach));
        }
    }
    std::vector<bool> found(panels.size(), false);
    const auto& s = fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        const fluid::Vec2 x(s.x[0][i], s.x[1][i]);
        if ((x.array() < low.array()).any() || (x.array() > high.array()).any()) continue;
        for (const std::size_t k : wet) {
            if (found[k]) continue;
            const auto [a, b] = panels.shape_functions_on(k, x);
            const fluid::Vec2 foot = a * panels.vertex(k, 0) + b * panels.vertex(k, 1);
            found[k] = panels.height(k, x) > 0 && (x - foot).norm() < reach;
        }
    }
    return found;
}

std::vector<coupling::WetMode> wet_modes(const coupling::WetSurface& surface, const fluid::Panels<2>& panels,
                                         const std::vector<bool>& contact,
                                         const std::vector<solid::NaturalMode>& modes) {
    std::vector<coupling::WetMode> made;
    for (const solid::NaturalMode& mode : modes) {
        const double motion = surface.squared_normal_motion(panels, contact, mode.shape);
        if (motion > 0) made.push_back({std::sqrt(std::max(0.0, mode.eigenvalue)), mode.mass / motion});
    }
    return made;
}

std::string up_to(int ratio, int most) {
    if (ratio == 0) return "no p";
    return ratio < most ? fmt::format("p up to about {}", ratio) : "any p";
}

}  // namespace

std::optional<Staggering> forecast_staggering(const io::Scene& scene, const Model<2>& model) {
    if (!model.interface || scene.coupling.algorithm == io::CouplingAlgorithm::iterated ||
        scene.solid->scheme == solid::Scheme::central_difference)
        return {};
    const coupling::StaggeredScheme scheme{
        .side_by_side = scene.coupling.algorithm == io::CouplingAlgorithm::cps,
        .extrapolation = scene.coupling.extrapolation,
        .newmark = solid::newmark_coefficients(scene.solid->scheme, scene.solid->alpha)};
    std::vector<solid::NaturalMode> modes;
    try {
        solid::Solver<2> body = make_solid<2>(scene);
        const long free = 2 * long(body.mesh().nodes.size());
        modes = body.natural_modes(int(std::min<long>(most_modes, free / 4)), tasks::parallel_loop);
    } catch (const solid::SolverError&) {
        return {};
    } catch (const std::invalid_argument&) {  // fewer freedoms than modes
        return {};
    }
    const fluid::Panels<2>& panels = panels_of(model);
    const fluid::Tait& tait = model.fluid->tait;
    const double impedance = tait.reference_density * tait.sound_speed;
    const double fluid_step = (scheme.side_by_side ? scene.coupling.step_fraction : 1) * model.fluid->cfl *
                              model.fluid->kernel.radius() / tait.sound_speed;
    const auto under = wet_modes(model.interface->surface, panels, std::vector<bool>(panels.size(), true), modes);
    if (under.empty()) return {};
    const auto largest = [&](const std::vector<coupling::WetMode>& of) {
        return coupling::largest_stable_ratio(scheme, of, impedance, fluid_step, most_ratio);
    };
    Staggering made;
    made.most = most_ratio;
    made.mass_ratio = impedance * fluid_step / under.front().mass_per_area;
    made.largest_ratio_under = largest(under);
    made.largest_ratio = largest(wet_modes(model.interface->surface, panels, in_contact(*model.fluid, panels), modes));
    return made;
}

std::string text_of(const Staggering& staggering) {
    std::string text = up_to(staggering.largest_ratio, staggering.most) + " is stable by the forecast";
    if (staggering.largest_ratio_under != staggering.largest_ratio)
        text += fmt::format(", with all wet surfaces under water {}",
                            up_to(staggering.largest_ratio_under, staggering.most));
    return text + fmt::format(" (ρ0 c0 Δt is {:.2g} of the body's mass per wet area)", staggering.mass_ratio);
}

std::string warning_of(const Staggering& staggering, const io::Scene& scene) {
    if (scene.coupling.ratio <= staggering.largest_ratio) return {};
    return fmt::format(
        "p = {} may well be unstable: {}; look at the force on the body, and take a lower [coupling] ratio or "
        "[fluid] cfl, or algorithm = \"iterated\"",
        scene.coupling.ratio, text_of(staggering));
}

}  // namespace aquagraph::engine
