// How long a run will take, told from its first particles and from the first steps of its body.
#pragma once
#include <string>

#include "engine/model.hpp"
#include "io/scene.hpp"
#include "tasks/executor.hpp"

namespace aquagraph::engine {

struct Forecast {
    double step = 0;            // Δt, of a body alone its own [s]
    double steps = 0;           // to the end of the run
    const char* limiter = "";   // of the fluid's step
    double fluid_seconds = 0;   // wall-clock time of all fluid steps on these threads, if there were nothing else [s]
    double solid_seconds = 0;   // of all steps of the body
    double seconds = 0;         // of the run, without what is written; iterated cycles count once
    std::size_t pairs = 0;      // in the lists of a step
    std::string no_solid_step;  // why the body could not be stepped; empty: it could
};

// Times evaluations of the fluid's rates and a step of the body, which moves in doing so: the model is used up. Its
// neighbour lists must be there.
template <int D>
Forecast forecast(const io::Scene& scene, Model<D>& model, tasks::Executor& executor);

}  // namespace aquagraph::engine
