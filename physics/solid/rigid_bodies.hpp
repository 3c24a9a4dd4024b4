// Rigid bodies made of nodes of the mesh, such as the rim of a wheel. Node a of a body is at
//   x_a = C + c + r_a,   r_a = R (X_a - C),
//   v_a = c' + ω × r_a,  a_a = c'' + ω' × r_a + ω × (ω × r_a),
// C being its point. The coordinates of a body are the D components of c and those of the rotation, of which 2D has
// one. Time goes by Newmark's formulas on c and on the rotation of the step, R_n+1 = exp(ψ) R_n with
//   ψ = Δt ω_n + Δt² ((1/2 - β) ω'_n + β ω'_n+1),   ω_n+1 = ω_n + Δt ((1 - γ) ω'_n + γ ω'_n+1)
// (Simo & Vu-Quoc, Comput. Methods Appl. Mech. Eng. 66, 1988, in components fixed in space): exact in 2D and for one
// axis, of second order otherwise. Forces on the nodes act on a body as their sum and their moment about C + c:
//   Q = Tᵀ f,   T_a = [I, -r_a ×]
//
// Rotations are counted as arcs, angle × the body's largest |X_a - C|, so that all coordinates are lengths and all
// generalised forces are newtons. Vectors over coordinates: body after body, translations first.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/solid/mesh.hpp"
#include "physics/solid/newmark.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::solid {

template <int D>
class RigidBodies {
  public:
    static constexpr std::size_t freedoms = rigid_freedoms<D>;
    using Vector = Eigen::Matrix<double, D, 1>;
    using Rotation = Eigen::Matrix<double, D, D>;

    struct Motion {
        std::array<double, freedoms> q{}, velocity{}, acceleration{};
        Rotation rotation = Rotation::Identity();
        bool operator==(const Motion&) const = default;
    };

    // Throws std::invalid_argument for an unknown or empty set, a negative mass or inertia, and a body that can turn
    // although its nodes lie in its point (or, in 3D, on a line through it) and it has no inertia of its own.
    RigidBodies(const Mesh<D>& mesh, const Options<D>& options);

    bool empty() const { return bodies_.empty(); }
    std::size_t coordinates() const { return bodies_.size() * freedoms; }
    const std::vector<std::size_t>& unknowns() const { return unknowns_; }      // coordinates that are free
    const std::vector<std::size_t>& prescribed() const { return prescribed_; }  // the others
    const Motion& motion(std::size_t body) const { return now_[body]; }
    double arm(std::size_t body) const { return bodies_[body].arm; }  // of the arcs [m]

    // The state, to keep it, to go back to it, and to save it.
    const std::vector<Motion>& motions() const { return now_; }
    void set_motions(const std::vector<Motion>& motions) { now_ = motions; }

    // Dynamics. Prescribed coordinates are those of their laws at t; the free ones depend on their accelerations, in
    // the order of unknowns().
    void set_rates(double t);  // velocities and accelerations of prescribed coordinates only; free accelerations 0
    void keep_start() { step_start_ = now_; }  // of the step; before begin_step
    void begin_step(double t, double dt, const NewmarkCoefficients& newmark, bool from_rest);
    void correct(std::span<const double> accelerations);            // adds to the accelerations
    void add_accelerations(std::span<const double> accelerations);  // and leaves displacements and velocities

    // Statics: everything at rest.
    void come_to_rest();
    void forget_accelerations();
    void ramp(double t, double part, const std::vector<Motion>& start);  // prescribed coordinates
    void move(std::span<const double> displacements);                    // adds to the free coordinates
    void extrapolate(const std::vector<Motion>& before, double ratio);   // continues from `before` to now, ratio times

    // Nodes: D × all nodes of the mesh; those of bodies are written.
    void place(std::span<double> u) const;
    void place(std::span<double> u, std::span<double> v, std::span<double> a) const;

    // Over the coordinates.
    void gather(std::span<const double> nodal, std::span<double> generalised) const;         // Q = Tᵀ f
    void add_gravity(std::span<const double> gravity, std::span<double> generalised) const;  // D; of the own masses
    void loads(double t, std::span<double> generalised) const;
    void add_own_inertia(std::span<double> generalised) const;  // m c'', J ω' + ω × J ω

    // A column of T, of an unknown: the motion of the nodes by a unit of it. Only nodes of its body are written.
    void column(std::size_t unknown, const std::vector<Motion>& at, std::span<double> nodal) const;
    // Own mass or inertia between two unknowns.
    double own_mass(std::size_t row, std::size_t column, const std::vector<Motion>& at) const;
    // Energies of the own masses [J]. gravity: D
    double kinetic_energy() const;
    double gravity_potential(const std::vector<Motion>& at, std::span<const double> gravity) const;

  private:
    struct Body {
        RigidBody<D> options;
        std::vector<NodeIndex> nodes;
        std::vector<Vector> arms;  // X - C
        double arm = 1;            // the longest
        Eigen::Matrix<double, rotation_count<D>, rotation_count<D>> inertia(const Rotation& rotation) const;
    };
    void update(std::size_t coordinate);
    void turn(std::size_t body, const Motion& from);  // R = exp(ψ) R_from, ψ the difference of rotations

    std::vector<Body> bodies_;
    std::vector<Motion> now_, step_start_;
    std::vector<std::size_t> unknowns_, prescribed_;
    double dt_ = 0;
    NewmarkCoefficients newmark_;
};

}  // namespace aquagraph::solid
