#include "tasks/stepping.hpp"

#include <cmath>
#include <vector>

#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::tasks {

template <int D>
Task time_step(fluid::Fluid<D>& fluid, Clock& clock, StepChoice choice, const std::string& label) {
    auto scratch = std::make_shared<std::vector<fluid::StepLimits>>();
    return {.name = label.empty() ? "time step" : "time step (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_rates},
            .writes = {resource::clock},
            .body = [&fluid, &clock, choice, scratch] {
                scratch->resize(fluid.blocks());
                const fluid::StepLimits limits = reduce_blocks(
                    fluid.blocks(), fluid::StepLimits{},
                    [&](std::size_t block) {
                        return step_limits(fluid.particles, fluid.cfl, fluid.kernel.radius(), fluid.lanes(block),
                                           fluid.viscosity_of_step());
                    },
                    fluid::combine, std::span<fluid::StepLimits>(*scratch));
                const double wanted = choice.fraction * limits.step(), left = (clock.end - clock.time) / choice.steps;
                clock.step = std::min(wanted, left);
                clock.limiter = left < wanted ? "end of run" : limits.name();
                if (choice.whole_cycle)
                    clock.cycle = choice.steps * clock.step;
                else
                    clock.cycle = (choice.first_of_cycle ? 0 : clock.cycle) + clock.step;
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
                for_each_block(fluid.blocks(), [&](std::size_t block) {
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

template Task time_step(fluid::Fluid<2>&, Clock&, StepChoice, const std::string&);
template Task time_step(fluid::Fluid<3>&, Clock&, StepChoice, const std::string&);
template Task examine(fluid::Fluid<2>&, const std::string&);
template Task examine(fluid::Fluid<3>&, const std::string&);

}  // namespace aquagraph::tasks
