#include "tasks/body_force.hpp"

#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::tasks {

template <int D>
Task central_force(fluid::Fluid<D>& fluid, const fluid::CentralForce<D>& force, const std::string& label) {
    return {.name = "central force (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state},
            .writes = {resource::fluid_rates},
            .body = [&fluid, &force] {
                for_each_block(fluid.blocks(), blocks_without_pairs, [&](std::size_t block) {
                    add_central_force(fluid.particles, force, fluid.lanes(block));
                });
            }};
}

template <int D>
Task driving_force(fluid::Fluid<D>& fluid, const std::array<double, D>& a, const std::string& label) {
    return {.name = "driving force (" + label + ")",
            .reads = {resource::fluid_lists},
            .writes = {resource::fluid_rates},
            .body = [&fluid, &a] {
                for_each_block(fluid.blocks(), blocks_without_pairs, [&](std::size_t block) {
                    add_driving_force<D>(fluid.particles, a, fluid.lanes(block));
                });
            }};
}

template Task driving_force<2>(fluid::Fluid<2>&, const std::array<double, 2>&, const std::string&);
template Task driving_force<3>(fluid::Fluid<3>&, const std::array<double, 3>&, const std::string&);
template Task central_force(fluid::Fluid<2>&, const fluid::CentralForce<2>&, const std::string&);
template Task central_force(fluid::Fluid<3>&, const fluid::CentralForce<3>&, const std::string&);

}  // namespace aquagraph::tasks
