#include "physics/solid/rigid_bodies.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace aquagraph::solid {

namespace {

// Angular velocities, their rates and rotation vectors by components; D = 2 has one.
template <int D>
using Angular = Eigen::Matrix<double, rotation_count<D>, 1>;

template <int D, class V>
V cross(const Angular<D>& omega, const V& r) {
    if constexpr (D == 2)
        return {-omega[0] * r[1], omega[0] * r[0]};
    else
        return omega.cross(r);
}

template <int D, class V>
Angular<D> moment(const V& r, const V& f) {
    if constexpr (D == 2)
        return Angular<D>(r[0] * f[1] - r[1] * f[0]);
    else
        return r.cross(f);
}

template <int D>
Eigen::Matrix<double, D, D> exponential(const Angular<D>& psi) {
    if constexpr (D == 2) {
        return Eigen::Rotation2Dd(psi[0]).toRotationMatrix();
    } else {
        const double angle = psi.norm();
        if (angle == 0) return Eigen::Matrix3d::Identity();
        return Eigen::AngleAxisd(angle, psi / angle).toRotationMatrix();
    }
}

// Rotational part of coordinates, as angles.
template <int D>
Angular<D> angles(const std::array<double, rigid_freedoms<D>>& q, double arm) {
    Angular<D> psi;
    for (std::size_t i = 0; i < rotation_count<D>; ++i) psi[Eigen::Index(i)] = q[D + i] / arm;
    return psi;
}

template <int D>
void set(std::span<double> nodal, NodeIndex node, const Eigen::Matrix<double, D, 1>& value) {
    std::copy_n(value.data(), D, &nodal[D * std::size_t(node)]);
}

template <int D>
Eigen::Matrix<double, D, 1> translation(const std::array<double, rigid_freedoms<D>>& q) {
    Eigen::Matrix<double, D, 1> c;
    for (std::size_t i = 0; i < D; ++i) c[Eigen::Index(i)] = q[i];
    return c;
}

}  // namespace

template <int D>
RigidBodies<D>::RigidBodies(const Mesh<D>& mesh, const Options<D>& options) {
    for (const RigidBody<D>& given : options.rigid_bodies) {
        const std::string who = "solid: the rigid body '" + given.set + "' ";
        Body& body = bodies_.emplace_back();
        body.options = given;
        body.nodes = mesh.node_set(given.set);
        if (body.nodes.empty()) throw std::invalid_argument(who + "has no nodes");
        if (!(given.mass >= 0)) throw std::invalid_argument(who + "has a negative mass");
        for (const double J : given.inertia)
            if (!(J >= 0)) throw std::invalid_argument(who + "has a negative inertia");
        const auto at = [&](NodeIndex node) { return Eigen::Map<const Vector>(mesh.nodes[std::size_t(node)].data()); };
        Vector point = Vector::Zero();
        if (given.point) {
            point = Eigen::Map<const Vector>(given.point->data());
        } else {
            for (const NodeIndex node : body.nodes) point += at(node);
            point /= double(body.nodes.size());
        }
        double longest = 0;
        Eigen::Matrix<double, D, D> spread = Eigen::Matrix<double, D, D>::Zero();
        for (const NodeIndex node : body.nodes) {
            body.arms.push_back(at(node) - point);
            longest = std::max(longest, body.arms.back().norm());
            spread += body.arms.back() * body.arms.back().transpose();
        }
        // About which axes do the nodes resist a rotation? Without resistance it is no unknown.
        const double across =
            D == 2 ? spread.trace()
                   : Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>>(spread).eigenvalues()[D - 2];
        const bool turns = std::any_of(given.motion.begin() + D, given.motion.end(), [](const auto& m) { return !m; });
        const bool has_inertia =
            std::all_of(given.inertia.begin(), given.inertia.end(), [](double J) { return J > 0; });
        if (turns && !has_inertia && !(across > 1e-20 * spread.trace()))
            throw std::invalid_argument(who + "can turn, but its nodes lie " + (D == 2 ? "in its point" : "on a line") +
                                        ": prescribe its rotations or give it an inertia");
        if (longest > 0) body.arm = longest;
    }
    now_.resize(bodies_.size());
    step_start_ = now_;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        for (std::size_t i = 0; i < freedoms; ++i)
            (bodies_[b].options.motion[i] ? prescribed_ : unknowns_).push_back(b * freedoms + i);
}

template <int D>
Eigen::Matrix<double, rotation_count<D>, rotation_count<D>> RigidBodies<D>::Body::inertia(
    const Rotation& rotation) const {
    const Angular<D> principal = Eigen::Map<const Angular<D>>(options.inertia.data());
    if constexpr (D == 2)
        return principal;
    else
        return rotation * principal.asDiagonal() * rotation.transpose();
}

template <int D>
void RigidBodies<D>::turn(std::size_t b, const Motion& from) {
    const double arm = bodies_[b].arm;
    now_[b].rotation = exponential<D>(angles<D>(now_[b].q, arm) - angles<D>(from.q, arm)) * from.rotation;
}

template <int D>
void RigidBodies<D>::set_rates(double t) {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        for (std::size_t i = 0; i < freedoms; ++i) {
            now_[b].acceleration[i] = 0;
            if (!bodies_[b].options.motion[i]) continue;
            const ValueAndRates law = bodies_[b].options.motion[i]->at(t);
            const double scale = i < D ? 1 : bodies_[b].arm;
            now_[b].velocity[i] = scale * law.rate;
            now_[b].acceleration[i] = scale * law.acceleration;
        }
}

// Displacement and velocity of a free coordinate from its acceleration.
template <int D>
void RigidBodies<D>::update(std::size_t coordinate) {
    const std::size_t i = coordinate % freedoms;
    const Motion& old = step_start_[coordinate / freedoms];
    Motion& now = now_[coordinate / freedoms];
    now.q[i] = old.q[i] + dt_ * old.velocity[i] +
               dt_ * dt_ * ((0.5 - newmark_.beta) * old.acceleration[i] + newmark_.beta * now.acceleration[i]);
    now.velocity[i] =
        old.velocity[i] + dt_ * ((1 - newmark_.gamma) * old.acceleration[i] + newmark_.gamma * now.acceleration[i]);
}

template <int D>
void RigidBodies<D>::begin_step(double t, double dt, const NewmarkCoefficients& newmark, bool from_rest) {
    dt_ = dt;
    newmark_ = newmark;
    set_rates(t);
    for (const std::size_t k : prescribed_) {
        const Body& body = bodies_[k / freedoms];
        const std::size_t i = k % freedoms;
        now_[k / freedoms].q[i] = (i < D ? 1 : body.arm) * body.options.motion[i]->at(t).value;
    }
    for (const std::size_t k : unknowns_) {
        const std::size_t i = k % freedoms;
        const Motion& old = step_start_[k / freedoms];
        now_[k / freedoms].acceleration[i] =
            from_rest ? -(old.velocity[i] / dt + (0.5 - newmark.beta) * old.acceleration[i]) / newmark.beta
                      : old.acceleration[i];
        update(k);
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) turn(b, step_start_[b]);
}

template <int D>
void RigidBodies<D>::correct(std::span<const double> accelerations) {
    add_accelerations(accelerations);
    for (const std::size_t k : unknowns_) update(k);
    for (std::size_t b = 0; b < bodies_.size(); ++b) turn(b, step_start_[b]);
}

template <int D>
void RigidBodies<D>::add_accelerations(std::span<const double> accelerations) {
    for (std::size_t n = 0; n < unknowns_.size(); ++n)
        now_[unknowns_[n] / freedoms].acceleration[unknowns_[n] % freedoms] += accelerations[n];
}

template <int D>
void RigidBodies<D>::come_to_rest() {
    for (Motion& motion : now_) motion.velocity = motion.acceleration = {};
}

template <int D>
void RigidBodies<D>::forget_accelerations() {
    for (Motion& motion : now_) motion.acceleration = {};
}

template <int D>
void RigidBodies<D>::ramp(double t, double part, const std::vector<Motion>& start) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Motion from = now_[b];
        for (std::size_t i = 0; i < freedoms; ++i) {
            if (!bodies_[b].options.motion[i]) continue;
            const double target = (i < D ? 1 : bodies_[b].arm) * bodies_[b].options.motion[i]->at(t).value;
            now_[b].q[i] = part == 1 ? target : start[b].q[i] + part * (target - start[b].q[i]);
        }
        turn(b, from);
    }
}

template <int D>
void RigidBodies<D>::move(std::span<const double> displacements) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Motion from = now_[b];
        for (std::size_t n = 0; n < unknowns_.size(); ++n)
            if (unknowns_[n] / freedoms == b) now_[b].q[unknowns_[n] % freedoms] += displacements[n];
        turn(b, from);
    }
}

template <int D>
void RigidBodies<D>::extrapolate(const std::vector<Motion>& before, double ratio) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Motion from = now_[b];
        for (std::size_t i = 0; i < freedoms; ++i) now_[b].q[i] += ratio * (from.q[i] - before[b].q[i]);
        turn(b, from);
    }
}

template <int D>
void RigidBodies<D>::place(std::span<double> u) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Vector c = translation<D>(now_[b].q);
        const Rotation turned = now_[b].rotation - Rotation::Identity();
        for (std::size_t a = 0; a < bodies_[b].nodes.size(); ++a)
            set<D>(u, bodies_[b].nodes[a], c + turned * bodies_[b].arms[a]);
    }
}

template <int D>
void RigidBodies<D>::place(std::span<double> u, std::span<double> v, std::span<double> a) const {
    place(u);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Body& body = bodies_[b];
        const Motion& now = now_[b];
        const Vector c1 = translation<D>(now.velocity), c2 = translation<D>(now.acceleration);
        const Angular<D> omega = angles<D>(now.velocity, body.arm), alpha = angles<D>(now.acceleration, body.arm);
        for (std::size_t n = 0; n < body.nodes.size(); ++n) {
            const Vector r = now.rotation * body.arms[n], spin = cross<D>(omega, r);
            set<D>(v, body.nodes[n], c1 + spin);
            set<D>(a, body.nodes[n], c2 + cross<D>(alpha, r) + cross<D>(omega, spin));
        }
    }
}

template <int D>
void RigidBodies<D>::gather(std::span<const double> nodal, std::span<double> generalised) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Body& body = bodies_[b];
        Vector force = Vector::Zero();
        Angular<D> torque = Angular<D>::Zero();
        for (std::size_t n = 0; n < body.nodes.size(); ++n) {
            const Vector f = Eigen::Map<const Vector>(&nodal[D * std::size_t(body.nodes[n])]);
            force += f;
            torque += moment<D, Vector>(now_[b].rotation * body.arms[n], f);
        }
        for (std::size_t i = 0; i < D; ++i) generalised[b * freedoms + i] = force[Eigen::Index(i)];
        for (std::size_t i = 0; i < rotation_count<D>; ++i)
            generalised[b * freedoms + D + i] = torque[Eigen::Index(i)] / body.arm;
    }
}

template <int D>
void RigidBodies<D>::add_gravity(std::span<const double> gravity, std::span<double> generalised) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        for (std::size_t i = 0; i < D; ++i) generalised[b * freedoms + i] += bodies_[b].options.mass * gravity[i];
}

template <int D>
void RigidBodies<D>::loads(double t, std::span<double> generalised) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        for (std::size_t i = 0; i < freedoms; ++i)
            generalised[b * freedoms + i] = bodies_[b].options.load[i].at(t).value / (i < D ? 1 : bodies_[b].arm);
}

template <int D>
void RigidBodies<D>::add_own_inertia(std::span<double> generalised) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Body& body = bodies_[b];
        const Motion& now = now_[b];
        for (std::size_t i = 0; i < D; ++i) generalised[b * freedoms + i] += body.options.mass * now.acceleration[i];
        const auto J = body.inertia(now.rotation);
        Angular<D> torque = J * angles<D>(now.acceleration, body.arm);
        if constexpr (D == 3) {
            const Angular<D> omega = angles<D>(now.velocity, body.arm);
            torque += omega.cross(J * omega);
        }
        for (std::size_t i = 0; i < rotation_count<D>; ++i)
            generalised[b * freedoms + D + i] += torque[Eigen::Index(i)] / body.arm;
    }
}

template <int D>
void RigidBodies<D>::column(std::size_t unknown, const std::vector<Motion>& at, std::span<double> nodal) const {
    const std::size_t b = unknowns_[unknown] / freedoms, i = unknowns_[unknown] % freedoms;
    const Body& body = bodies_[b];
    for (std::size_t n = 0; n < body.nodes.size(); ++n) {
        if (i < D)
            set<D>(nodal, body.nodes[n], Vector::Unit(Eigen::Index(i)));
        else
            set<D>(nodal, body.nodes[n],
                   cross<D, Vector>(Angular<D>::Unit(Eigen::Index(i - D)), at[b].rotation * body.arms[n]) / body.arm);
    }
}

template <int D>
double RigidBodies<D>::own_mass(std::size_t row, std::size_t column, const std::vector<Motion>& at) const {
    const std::size_t b = unknowns_[row] / freedoms, i = unknowns_[row] % freedoms, j = unknowns_[column] % freedoms;
    if (unknowns_[column] / freedoms != b || (i < D) != (j < D)) return 0;
    const Body& body = bodies_[b];
    if (i < D) return i == j ? body.options.mass : 0;
    return body.inertia(at[b].rotation)(Eigen::Index(i - D), Eigen::Index(j - D)) / (body.arm * body.arm);
}

template <int D>
double RigidBodies<D>::kinetic_energy() const {
    double energy = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Angular<D> omega = angles<D>(now_[b].velocity, bodies_[b].arm);
        energy += 0.5 * bodies_[b].options.mass * translation<D>(now_[b].velocity).squaredNorm() +
                  0.5 * omega.dot(bodies_[b].inertia(now_[b].rotation) * omega);
    }
    return energy;
}

template <int D>
double RigidBodies<D>::gravity_potential(const std::vector<Motion>& at, std::span<const double> gravity) const {
    double energy = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        for (std::size_t i = 0; i < D; ++i) energy -= bodies_[b].options.mass * gravity[i] * at[b].q[i];
    return energy;
}

template class RigidBodies<2>;
template class RigidBodies<3>;

}  // namespace aquagraph::solid
