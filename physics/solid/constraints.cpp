#include "physics/solid/constraints.hpp"

#include <stdexcept>
#include <string>

namespace aquagraph::solid {

template <int D>
std::vector<bool> held_freedoms(const Mesh<D>& mesh, const Options<D>& options) {
    std::vector<bool> held(D * mesh.nodes.size(), false);
    for (const Clamp<D>& clamp : options.clamps)
        for (const NodeIndex node : mesh.node_set(clamp.set))
            for (std::size_t i = 0; i < D; ++i)
                if (clamp.fixed[i]) held[D * std::size_t(node) + i] = true;
    const auto hold = [&](NodeIndex node, std::size_t i, const std::string& what) {
        if (held[D * std::size_t(node) + i])
            throw std::invalid_argument("solid: node " + std::to_string(node) + " is held twice along " + "xyz"[i] +
                                        ", the second time by " + what + "; take it out of one of the sets");
        held[D * std::size_t(node) + i] = true;
    };
    for (const Motion<D>& motion : options.motions)
        for (const NodeIndex node : mesh.node_set(motion.set))
            for (std::size_t i = 0; i < D; ++i)
                if (motion.displacement[i]) hold(node, i, "the motion of '" + motion.set + "'");
    for (const RigidBody<D>& body : options.rigid_bodies)
        for (const NodeIndex node : mesh.node_set(body.set))
            for (std::size_t i = 0; i < D; ++i) hold(node, i, "the rigid body '" + body.set + "'");
    return held;
}

template <int D>
PrescribedMotions<D>::PrescribedMotions(const Mesh<D>& mesh, const std::vector<Motion<D>>& motions) {
    for (const Motion<D>& motion : motions)
        for (std::size_t i = 0; i < D; ++i) {
            if (!motion.displacement[i]) continue;
            const std::size_t first = freedoms_.size();
            for (const NodeIndex node : mesh.node_set(motion.set)) freedoms_.push_back(D * std::size_t(node) + i);
            groups_.push_back({*motion.displacement[i], first, freedoms_.size()});
        }
}

template <int D>
void PrescribedMotions<D>::place(double t, std::span<double> u, std::span<double> v, std::span<double> a) const {
    ramp(t, 1, u, u);
    set_rates(t, v, a);
}

template <int D>
void PrescribedMotions<D>::set_rates(double t, std::span<double> v, std::span<double> a) const {
    for (const Group& group : groups_) {
        const ValueAndRates now = group.displacement.at(t);
        for (std::size_t k = group.first; k < group.last; ++k) {
            v[freedoms_[k]] = now.rate;
            a[freedoms_[k]] = now.acceleration;
        }
    }
}

template <int D>
void PrescribedMotions<D>::ramp(double t, double part, std::span<const double> start, std::span<double> u) const {
    for (const Group& group : groups_) {
        const double target = group.displacement.at(t).value;
        for (std::size_t k = group.first; k < group.last; ++k) {
            const std::size_t f = freedoms_[k];
            u[f] = part == 1 ? target : start[f] + part * (target - start[f]);
        }
    }
}

#define AQUAGRAPH_INSTANTIATE(D)                                                 \
    template std::vector<bool> held_freedoms(const Mesh<D>&, const Options<D>&); \
    template class PrescribedMotions<D>;
AQUAGRAPH_INSTANTIATE(2)
AQUAGRAPH_INSTANTIATE(3)
#undef AQUAGRAPH_INSTANTIATE

}  // namespace aquagraph::solid
