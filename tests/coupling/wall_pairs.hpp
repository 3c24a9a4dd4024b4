// Every pair of a fluid particle and a ghost, with the force between them, the slow and obvious way: a double loop over
// all particles and all ghosts and the Riemann problem as it stands in the paper.
#pragma once
#include <algorithm>
#include <cmath>

#include "engine/model.hpp"
#include "physics/fluid/riemann.hpp"

namespace aquagraph::test {

using fluid::Vec2;

inline double limited(double a, double b) {  // minmod
    if (a > 0 && b > 0) return std::min(a, b);
    if (a < 0 && b < 0) return std::max(a, b);
    return 0;
}

inline bool may_see(const engine::Model<2>& model, std::size_t i, std::size_t lane) {
    const fluid::Visibility<2>& visibility = model.walls->visibility;
    if (visibility.sees_everything(i)) return true;
    const auto bit = std::uint8_t(1u << (lane % fluid::W));
    return visibility.lanes_seen(i, lane / fluid::W, bit) != 0;
}

// Force of lane j on particle i [N/m]: -ω_i ω_j 2 p_e ∇W_ij with ∇W_ij = -W'(r) e_ij, and viscosity.
inline Vec2 pair_force(const fluid::Fluid<2>& fluid, std::size_t i, std::size_t j) {
    const auto& s = fluid.particles;
    const auto vector = [](const fluid::Vectors<2>& v, std::size_t k) { return Vec2(v[0][k], v[1][k]); };
    const Vec2 dx = vector(s.x, j) - vector(s.x, i);
    const double r = dx.norm();
    if (r >= fluid.kernel.radius()) return Vec2::Zero();
    const Vec2 e = dx / r;
    double p_L = s.p[i], p_R = s.p[j];
    Vec2 v_L = vector(s.v, i), v_R = vector(s.v, j);
    if (fluid.flux.muscl) {
        const double dp = p_R - p_L;
        p_L += 0.5 * limited(vector(s.grad_p, i).dot(dx), dp);
        p_R -= 0.5 * limited(vector(s.grad_p, j).dot(dx), dp);
        for (std::size_t d = 0; d < 2; ++d) {
            const double dv = s.v[d][j] - s.v[d][i];
            v_L[int(d)] += 0.5 * limited(vector(s.grad_v[d], i).dot(dx), dv);
            v_R[int(d)] -= 0.5 * limited(vector(s.grad_v[d], j).dot(dx), dv);
        }
    }
    const auto state = fluid::acoustic_riemann(v_L.dot(e), p_L, s.impedance[i], v_R.dot(e), p_R, s.impedance[j]);
    const double gradient = fluid.kernel.derivative(r) * s.volume[i] * s.volume[j];
    Vec2 force = 2 * state.pressure * gradient * e;
    // µ ω_i ω_j times 8 (x·v)/|x|² ∇W (Monaghan and Gingold) or 2 (x·∇W)/|x|² v (Morris), ∇W = -W' e
    const Vec2 dv = vector(s.v, j) - vector(s.v, i);
    if (fluid.viscosity.form == fluid::ViscousOperator::morris)
        force -= fluid.viscosity.dynamic * 2 / r * gradient * dv;
    else
        force -= fluid.viscosity.dynamic * 8 * dx.dot(dv) / (r * r) * gradient * e;
    return force;
}

// f(particle, ghost, force of the ghost on the particle) for all pairs within sight of each other.
template <class F>
void each_wall_pair(const engine::Model<2>& model, F&& f) {
    const fluid::Fluid<2>& fluid = *model.fluid;
    const auto& s = fluid.particles;
    const double radius2 = fluid.kernel.radius() * fluid.kernel.radius();
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t g = 0; g < model.walls->ghosts.size(); ++g) {
            const std::size_t lane = s.ghost_begin() + g;
            const double dx = s.x[0][lane] - s.x[0][i], dy = s.x[1][lane] - s.x[1][i];
            if (dx * dx + dy * dy < radius2 && may_see(model, i, lane)) f(i, g, pair_force(fluid, i, lane));
        }
}

}  // namespace aquagraph::test
