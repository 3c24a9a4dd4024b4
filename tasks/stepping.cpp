#include "tasks/stepping.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::tasks {

namespace {

template <int D>
fluid::StepLimits largest_step(const fluid::Fluid<D>& fluid, std::vector<fluid::StepLimits>& scratch) {
    scratch.resize(fluid.blocks());
    return reduce_blocks(
        fluid.blocks(), fluid::StepLimits{},
        [&](std::size_t block) {
            return step_limits(fluid.particles, fluid.cfl, fluid.kernel.radius(), fluid.lanes(block),
                               fluid.viscous_rate());
        },
        fluid::combine, std::span<fluid::StepLimits>(scratch), blocks_without_pairs);
}

// `steps` of `wanted` each, or shorter ones to the end of the run.
void set_step(Clock& clock, double wanted, const fluid::StepLimits& limits, int steps) {
    const double left = (clock.end - clock.time) / steps;
    clock.step = std::min(wanted, left);
    clock.limiter = left < wanted ? "end of run" : limits.name();
    if (left < wanted) return;  // cut short: says nothing about the rule
    clock.use.taken += steps * clock.step;
    clock.use.allowed += steps * limits.step();
}

}  // namespace

template <int D>
Task time_step(fluid::Fluid<D>& fluid, Clock& clock, coupling::HeldStep* held, bool first_of_cycle,
               const std::string& label) {
    auto scratch = std::make_shared<std::vector<fluid::StepLimits>>();
    return {.name = "time step (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_rates},
            .writes = {resource::clock},
            .body = [&fluid, &clock, held, first_of_cycle, scratch] {
                const fluid::StepLimits limits = largest_step(fluid, *scratch);
                const double wanted = limits.step();
                set_step(clock, held ? held->next(wanted, wanted) : wanted, limits, 1);
                clock.cycle = (first_of_cycle ? 0 : clock.cycle) + clock.step;
            }};
}

template <int D>
Task cycle_step(fluid::Fluid<D>& fluid, Clock& clock, coupling::CycleStep& rule, int steps) {
    auto scratch = std::make_shared<std::vector<fluid::StepLimits>>();
    return {.name = "time step",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_rates},
            .writes = {resource::clock},
            .body = [&fluid, &clock, &rule, steps, scratch] {
                const fluid::StepLimits limits = largest_step(fluid, *scratch);
                set_step(clock, rule.next(limits.step(), steps), limits, steps);
                if (rule.overstep > 0) ++clock.use.overlong;
                clock.cycle = steps * clock.step;
            }};
}

Task advance_clock(Clock& clock, const std::string& label) {
    return {.name = "clock (" + label + ")", .reads = {}, .writes = {resource::clock_step}, .body = [&clock] {
                clock.time += clock.step;
                // The last step was cut to end there; a sum of steps may miss it by a rounding.
                if (std::fabs(clock.end - clock.time) < 1e-9 * clock.step) clock.time = clock.end;
                clock.elapsed += clock.step;
                ++clock.steps;
            }};
}

template <int D>
Task examine(fluid::Fluid<D>& fluid, const std::string& label) {
    auto found = std::make_shared<std::vector<fluid::Diagnosis>>();
    return {.name = "examine (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state},
            .writes = {},
            .body = [&fluid, found] {
                found->resize(fluid.blocks());
                for_each_block(fluid.blocks(), blocks_without_pairs, [&](std::size_t block) {
                    (*found)[block] = examine(fluid.particles, fluid.tait.reference_density, fluid.domain, fluid.closed,
                                              fluid.lanes(block));
                });
                for (const fluid::Diagnosis& diagnosis : *found) {
                    switch (diagnosis.ailment) {
                        case fluid::Ailment::none:
                        case fluid::Ailment::passed_wall:  // the neighbour search finds those
                            break;
                        case fluid::Ailment::not_finite:
                            throw SickParticle(diagnosis, "a particle's state is not a number");
                        case fluid::Ailment::no_volume:
                            throw SickParticle(diagnosis,
                                               "a particle's density has fallen below a tenth of ρ0: its "
                                               "volume turns negative");
                        case fluid::Ailment::left_domain:
                            throw SickParticle(diagnosis, "a particle has left the closed domain");
                    }
                }
            }};
}

template Task time_step(fluid::Fluid<2>&, Clock&, coupling::HeldStep*, bool, const std::string&);
template Task time_step(fluid::Fluid<3>&, Clock&, coupling::HeldStep*, bool, const std::string&);
template Task cycle_step(fluid::Fluid<2>&, Clock&, coupling::CycleStep&, int);
template Task cycle_step(fluid::Fluid<3>&, Clock&, coupling::CycleStep&, int);
template Task examine(fluid::Fluid<2>&, const std::string&);
template Task examine(fluid::Fluid<3>&, const std::string&);

}  // namespace aquagraph::tasks
