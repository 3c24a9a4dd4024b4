#include "engine/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace aquagraph::engine {

std::string describe(const Model& model, const tasks::SickParticle& sick) {
    const fluid::Fluid<2>& fluid = *model.fluid;
    const auto& s = fluid.particles;
    const auto line = [&](std::size_t i) {
        return fmt::format("particle {:6d}  x ({:.6g}, {:.6g}) m  v ({:.4g}, {:.4g}) m/s  ρ {:.5g} kg/m³  p {:.4g} Pa",
                           s.id[i], s.x[0][i], s.x[1][i], s.v[0][i], s.v[1][i],
                           fluid.tait.reference_density + s.deviation[i], s.p[i]);
    };
    const std::size_t i = sick.diagnosis.particle;
    std::string text = fmt::format("{} at t = {:.6g} s, step {} (Δt {:.3g} s)\n  {}\n", sick.what(), model.clock.time,
                                   model.clock.steps, model.clock.step, line(i));

    // Where it was when the lists were built is known even if it is nowhere now.
    std::vector<std::pair<double, std::size_t>> around;
    for (std::size_t j = 0; j < s.count; ++j) {
        if (j == i) continue;
        const double r = std::hypot(s.x_built[0][j] - s.x_built[0][i], s.x_built[1][j] - s.x_built[1][i]);
        if (r < fluid.kernel.radius()) around.emplace_back(r, j);
    }
    std::sort(around.begin(), around.end());
    text += fmt::format("  {} neighbours within R = {:.4g} m; the nearest:\n", around.size(), fluid.kernel.radius());
    double fastest = 0;
    for (std::size_t k = 0; k < std::min<std::size_t>(5, around.size()); ++k)
        text += "    " + line(around[k].second) + "\n";
    for (std::size_t j = 0; j < s.count; ++j) {
        const double v = std::hypot(s.v[0][j], s.v[1][j]);
        if (std::isfinite(v)) fastest = std::max(fastest, v);
    }

    text += "  likely cause: ";
    if (fastest > 0.3 * fluid.tait.sound_speed)  // then water behaves like a gas, and may pass walls that are closed
        text += fmt::format("the flow reaches {:.3g} m/s, Mach {:.2f}: raise sound_speed to ten times the fastest flow",
                            fastest, fastest / fluid.tait.sound_speed);
    else if (sick.diagnosis.ailment == fluid::Ailment::left_domain)
        text += "a wall is missing or has a hole there; close it, enlarge the domain, or set edge = \"open\"";
    else if (model.solid)
        text += "the coupling is unstable or the step too long: make αs more negative, or lower cfl or ratio";
    else
        text += "the step is too long: lower cfl";
    return text;
}

}  // namespace aquagraph::engine
