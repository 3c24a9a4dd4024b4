// One moment of the run as files for ParaView.
#pragma once
#include <filesystem>

#include "physics/fluid/fluid.hpp"
#include "physics/solid/solver.hpp"

namespace aquagraph::engine {

// Particles in single precision, with pressure, velocity, density, volume, fullness and id.
// Both throw std::runtime_error naming the file where it cannot be written.
template <int D>
void write_fluid_frame(const std::filesystem::path& file, const fluid::Fluid<D>& fluid, double time);
// The deformed mesh in double precision, with displacement, velocity and von Mises stress.
template <int D>
void write_solid_frame(const std::filesystem::path& file, const solid::Solver<D>& solver, double time);

// A natural mode about the present state; `number` stands where frames have their time.
template <int D>
void write_mode_frame(const std::filesystem::path& file, const solid::Solver<D>& solver, const solid::NaturalMode& mode,
                      int number);

}  // namespace aquagraph::engine
