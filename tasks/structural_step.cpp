#include "tasks/structural_step.hpp"

#include <algorithm>
#include <cmath>

#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"
#include "tasks/statistics.hpp"

namespace aquagraph::tasks {

Task structural_time_step(Clock& clock, const double& longest) {
    return {.name = "time step", .reads = {}, .writes = {resource::clock}, .body = [&clock, &longest] {
                const double left = clock.end - clock.time;
                clock.step = left / std::max(1.0, std::ceil(left / longest * (1 - 1e-9)));
                clock.cycle = clock.step;
                clock.limiter = "solid";
            }};
}

Task dead_loads(const std::vector<solid::DeadLoad>& loads, const Clock& clock, std::vector<double>& forces) {
    return {.name = "loads",
            .reads = {resource::clock},
            .writes = {resource::solid_loads},
            .body = [&loads, &clock, &forces] { sum_at(loads, clock.time + clock.step, forces); }};
}

template <int D>
Task structural_step(solid::Structure<D>& solid, const std::vector<double>& forces, const Clock& clock) {
    return {.name = "FE Newton solve",
            .reads = {resource::clock, resource::solid_loads},
            .writes = {resource::solid_state},
            .body = [&solid, &forces, &clock] {
                solid.advance(clock.step, forces, parallel_loop);
                report_work(solid.mesh().elements.size());
            }};
}

template <int D>
Task structural_equilibrium(solid::Structure<D>& solid, const std::vector<double>& forces, const Clock& clock) {
    return {.name = "FE equilibrium",
            .reads = {resource::clock, resource::solid_loads},
            .writes = {resource::solid_state},
            .body = [&solid, &forces, &clock] {
                solid.set_time(clock.time + clock.step);
                solid.solve_static(forces, parallel_loop);
                report_work(solid.mesh().elements.size());
            }};
}

template Task structural_step(solid::Structure<2>&, const std::vector<double>&, const Clock&);
template Task structural_step(solid::Structure<3>&, const std::vector<double>&, const Clock&);
template Task structural_equilibrium(solid::Structure<2>&, const std::vector<double>&, const Clock&);
template Task structural_equilibrium(solid::Structure<3>&, const std::vector<double>&, const Clock&);

}  // namespace aquagraph::tasks
