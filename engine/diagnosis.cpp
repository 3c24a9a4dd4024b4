#include "engine/diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include "tasks/stepping.hpp"

namespace aquagraph::engine {

namespace {

template <int D>
std::array<double, D> at(const fluid::Vectors<D>& vectors, std::size_t i) {
    std::array<double, D> one;
    for (std::size_t d = 0; d < D; ++d) one[d] = vectors[d][i];
    return one;
}

template <int D>
double length(const std::array<double, D>& vector) {
    double squares = 0;
    for (const double component : vector) squares += component * component;
    return std::sqrt(squares);
}

template <int D>
std::string describe_particle(const Model<D>& model, const tasks::SickParticle& sick) {
    const fluid::Fluid<D>& fluid = *model.fluid;
    const auto& s = fluid.particles;
    const auto line = [&](std::size_t i) {
        return fmt::format("particle {:6d}  x ({:.6g}) m  v ({:.4g}) m/s  ρ {:.5g} kg/m³  p {:.4g} Pa", s.id[i],
                           fmt::join(at<D>(s.x, i), ", "), fmt::join(at<D>(s.v, i), ", "),
                           fluid.tait.reference_density + s.deviation[i], s.p[i]);
    };
    const std::size_t i = sick.diagnosis.particle;
    std::string text = fmt::format("{} at t = {:.6g} s, step {} (Δt {:.3g} s)\n  {}\n", sick.what(), model.clock.time,
                                   model.clock.steps, model.clock.step, line(i));

    // Where it was when the lists were built is known even if it is nowhere now.
    std::vector<std::pair<double, std::size_t>> around;
    for (std::size_t j = 0; j < s.count; ++j) {
        if (j == i) continue;
        std::array<double, D> away;
        for (std::size_t d = 0; d < D; ++d) away[d] = s.x_built[d][j] - s.x_built[d][i];
        const double r = length<D>(away);
        if (r < fluid.kernel.radius()) around.emplace_back(r, j);
    }
    std::sort(around.begin(), around.end());
    text += fmt::format("  {} neighbours within R = {:.4g} m; the nearest:\n", around.size(), fluid.kernel.radius());
    double fastest = 0;
    for (std::size_t k = 0; k < std::min<std::size_t>(5, around.size()); ++k)
        text += "    " + line(around[k].second) + "\n";
    for (std::size_t j = 0; j < s.count; ++j) {
        const double v = length<D>(at<D>(s.v, j));
        if (std::isfinite(v)) fastest = std::max(fastest, v);
    }

    text += "  likely cause: ";
    if (fastest > 0.3 * fluid.tait.sound_speed)  // then water behaves like a gas, and may pass walls that are closed
        text += fmt::format("the flow reaches {:.3g} m/s, Mach {:.2f}: raise sound_speed to ten times the fastest flow",
                            fastest, fastest / fluid.tait.sound_speed);
    else if (sick.diagnosis.ailment == fluid::Ailment::left_domain)
        text += "a wall is missing or has a hole there; close it, enlarge the domain, or set edge = \"open\"";
    else if (model.solid)
        text +=
            "the coupling is unstable or the step too long: make [solid.scheme] alpha (αs) more negative, or lower "
            "cfl or ratio";
    else
        text += "the step is too long: lower cfl";
    return text;
}

constexpr const char* load_grows =
    "  likely cause: the coupling is unstable, the load grows from step to step: make [solid.scheme] alpha (αs) more "
    "negative, or lower cfl "
    "or ratio; a light body in water needs ρ0 c0 Δt of a cycle well below its mass per area, or [coupling] "
    "algorithm = \"iterated\"";

// What was tried before it was given up.
template <int D>
std::string after_retreats(const Model<D>& model) {
    const int retreats = model.interface ? model.interface->fixed_point.retreats() : 0;
    if (retreats == 0) return {};
    return fmt::format("\n  this is so however small the guess of the cycle's end, which has been halved {} times",
                       retreats);
}

}  // namespace

template <int D>
std::string describe(const Model<D>& model, const tasks::TaskError& error) {
    const Clock& clock = model.clock;
    try {
        std::rethrow_exception(error.cause());
    } catch (const tasks::SickParticle& sick) {
        return describe_particle(model, sick) + after_retreats(model);
    } catch (const solid::ConvergenceError&) {
        if (model.structure)
            return fmt::format("{} (t = {:.6g} s, step {})", error.what(), clock.time, clock.steps + 1);
        return fmt::format("{} (t = {:.6g} s, step {})\n{}", error.what(), clock.time, clock.steps, load_grows) +
               after_retreats(model);
    } catch (...) {
        return fmt::format("{} (t = {:.6g} s, step {})", error.what(), clock.time, clock.steps);
    }
}

template std::string describe(const Model<2>&, const tasks::TaskError&);
template std::string describe(const Model<3>&, const tasks::TaskError&);

}  // namespace aquagraph::engine
