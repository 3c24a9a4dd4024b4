// Which p a staggered coupling bears in a scene, forecast before its first step.
#pragma once
#include <optional>
#include <string>

#include "engine/model.hpp"
#include "io/scene.hpp"

namespace aquagraph::engine {

struct Staggering {
    int largest_ratio = 0;        // with the wet surfaces that water touches at the start; 0: not even p = 1
    int largest_ratio_under = 0;  // with all of them under water
    int most = 0;                 // what was looked at: no bound was found below
    double mass_ratio = 0;        // z of a fluid step and the lowest mode, all under water: staggered_stability.hpp
};

// For fluid steps that the sound at rest limits. Nothing for what is iterated, for central differences and for bodies
// whose modes cannot be computed. The model is only read: modes are those of a body of its own, as drawn, and take
// seconds where it has ten thousand nodes.
std::optional<Staggering> forecast_staggering(const io::Scene& scene, const Model<2>& model);

// In a few words.
std::string text_of(const Staggering& staggering);
// What there is to say before a run of this scene; empty: nothing.
std::string warning_of(const Staggering& staggering, const io::Scene& scene);

}  // namespace aquagraph::engine
