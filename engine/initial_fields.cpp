#include "engine/initial_fields.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "io/scene_formulas.hpp"
#include "io/scene_reader.hpp"
#include "physics/fluid/time_integration.hpp"

namespace aquagraph::engine {

namespace {

// Calls set(i, value) with the formula's value at every particle.
template <int D, class Set>
void evaluate(const fluid::Particles<D>& s, const io::Scene& scene, const std::string& key, const std::string& formula,
              double least, Set set) {
    const io::Expression expression(formula, io::names_of_position(), io::all_constants(scene));
    for (std::size_t i = 0; i < s.count; ++i) {
        std::array<double, 3> x{};
        for (std::size_t d = 0; d < D; ++d) x[d] = s.x[d][i];
        const double value = expression(x);
        if (!std::isfinite(value) || value < least)
            throw io::scene_error(scene, key,
                                  fmt::format("\"{}\" gives {} at ({}, {}, {}) m", formula, value, x[0], x[1], x[2]),
                                  std::isfinite(value) ? fmt::format("a pressure must stay above {} Pa", least)
                                                       : "it must be a finite number wherever there is water");
        set(i, value);
    }
}

}  // namespace

template <int D>
void set_initial_fields(fluid::Fluid<D>& fluid, const io::Scene& scene) {
    const io::InitialFields& initial = scene.fluid->initial;
    fluid::Particles<D>& s = fluid.particles;
    constexpr double any = -INFINITY;
    for (std::size_t d = 0; d < D && !initial.velocity.empty(); ++d)
        evaluate(s, scene, fmt::format("fluid.initial.velocity[{}]", d), initial.velocity[d], any,
                 [&](std::size_t i, double value) { s.v[d][i] = value; });
    if (initial.pressure.empty()) return;
    // Water with a tenth of its density left is none any more.
    const double least = fluid.tait.pressure(-0.9 * fluid.tait.reference_density);
    evaluate(s, scene, "fluid.initial.pressure", initial.pressure, least, [&](std::size_t i, double value) {
        const double volume = s.volume[i];
        s.deviation[i] = fluid.tait.deviation(value);
        s.mass[i] = (fluid.tait.reference_density + s.deviation[i]) * volume;
    });
    for (std::size_t block = 0; block < fluid.blocks(); ++block) update_state(s, fluid.tait, fluid.lanes(block));
}

template void set_initial_fields(fluid::Fluid<2>&, const io::Scene&);
template void set_initial_fields(fluid::Fluid<3>&, const io::Scene&);

}  // namespace aquagraph::engine
