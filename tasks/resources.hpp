// The names by which tasks say what they read and write.
#pragma once

namespace aquagraph::tasks::resource {

inline constexpr const char* clock = "clock";                      // both of the following
inline constexpr const char* clock_step = "clock.step";            // time, Δt, time since the last exchange
inline constexpr const char* clock_cycle = "clock.cycle";          // length of the coupling cycle
inline constexpr const char* fluid = "fluid";                      // all of the following fluid.*
inline constexpr const char* fluid_lists = "fluid.lists";          // order of particles, ghosts, neighbour lists
inline constexpr const char* fluid_state = "fluid.state";          // x, v, ρ, p, Z, ω of fluid particles
inline constexpr const char* fluid_ghosts = "fluid.ghosts";        // the same of ghosts
inline constexpr const char* fluid_gradients = "fluid.gradients";  // of fluid particles
inline constexpr const char* ghost_gradients = "fluid.ghost_gradients";
inline constexpr const char* fluid_rates = "fluid.rates";            // dv/dt, dρ/dt, with mass exchange dm/dt
inline constexpr const char* fluid_surface = "fluid.surface";        // free surface: who, normals, crowding
inline constexpr const char* fluid_ledger = "fluid.ledger";          // energies since the start
inline constexpr const char* fluid_shift = "fluid.shift";            // δv, what particles move with besides v
inline constexpr const char* walls = "walls";                        // places and velocities of panels
inline constexpr const char* wall_gamma = "wall.gamma";              // normal flux method: γ …
inline constexpr const char* wall_moments = "wall.moments";          // … and what its sums lack near walls
inline constexpr const char* interface_motion = "interface.motion";  // wet nodes as last exchanged
inline constexpr const char* interface_loads = "interface.loads";    // what the fluid does to the solid now
inline constexpr const char* interface_energy = "interface.energy";  // across the interface, and ε of the load
inline constexpr const char* interface_guess = "interface.guess";    // of the end of a cycle that is iterated
inline constexpr const char* interface_ratio = "interface.ratio";    // p of the next cycle
inline constexpr const char* solid_loads = "solid.loads";            // what it did at the last exchange
inline constexpr const char* solid_state = "solid.state";
inline constexpr const char* results = "results";  // files

}  // namespace aquagraph::tasks::resource
