// What δ-SPH needs at least to keep water still next to walls of normal fluxes (normal_flux.hpp), measured on
// benchmarks/still_tank at 5 cm, R = 4 Δx: with less it rings at corners until pressure is wrong by 2 to 150 %.
#pragma once

namespace aquagraph::fluid {

inline constexpr double least_wall_delta = 0.1, least_wall_alpha = 0.2;

}  // namespace aquagraph::fluid
