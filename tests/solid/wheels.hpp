// Rings, and the balance of energies, for the tests of what holds and loads a solid.
#pragma once
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/solid/fixtures.hpp"

namespace aquagraph::solid::test {

inline TimeFunction law(const TimeLaw& change) {
    return {0, {change}};
}

// A ring in eight-node quadrilaterals; node sets and surfaces inner and outer.
inline Mesh<2> ring(double inner, double outer, int around, int across) {
    constexpr double seam = 1e-9;
    Mesh<2> flat = box_mesh({0, 0}, {1, 1}, around, across), mesh;
    std::vector<NodeIndex> kept(flat.nodes.size());
    for (std::size_t n = 0; n < flat.nodes.size(); ++n) {
        const auto [s, r] = flat.nodes[n];
        if (s > 1 - seam) continue;
        kept[n] = NodeIndex(mesh.nodes.size());
        const double angle = -2 * M_PI * s, radius = inner + (outer - inner) * r;  // clockwise: bottom is inside
        mesh.nodes.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    for (std::size_t n = 0; n < flat.nodes.size(); ++n)
        if (flat.nodes[n][0] > 1 - seam)
            for (std::size_t m = 0; m < flat.nodes.size(); ++m)
                if (flat.nodes[m][0] < seam && std::abs(flat.nodes[m][1] - flat.nodes[n][1]) < seam) kept[n] = kept[m];
    for (Element element : flat.elements) {
        for (NodeIndex& node : element) node = kept[std::size_t(node)];
        mesh.elements.push_back(element);
    }
    for (const auto& [name, from] : {std::pair{"inner", "bottom"}, std::pair{"outer", "top"}}) {
        for (Facet facet : flat.surfaces.at(from)) {
            for (NodeIndex& node : facet) node = kept[std::size_t(node)];
            mesh.surfaces[name].push_back(facet);
            for (const NodeIndex node : facet) mesh.node_sets[name].push_back(node);
        }
        auto& set = mesh.node_sets[name];
        std::sort(set.begin(), set.end());
        set.erase(std::unique(set.begin(), set.end()), set.end());
    }
    return mesh;
}

// |balance of energies - its value at first| / the largest energy, over the steps that `step` makes.
template <int D, class Step>
double imbalance(Solver<D>& solver, int steps, const Step& step) {
    const auto balance = [&] {
        const Energies e = solver.energies();
        return std::pair{e.stored() + e.friction + e.damping + e.numerical - e.external_work,
                         std::max({e.kinetic, e.strain, std::abs(e.external_work)})};
    };
    const double initial = balance().first;
    double worst = 0, largest = 0;
    for (int k = 0; k < steps; ++k) {
        step(k);
        const auto [now, size] = balance();
        worst = std::max(worst, std::abs(now - initial));
        largest = std::max(largest, size);
    }
    return worst / largest;
}

// A quarter of a ring, from angle 0 to 90°, on eight-node quadrilaterals: node sets and surfaces left (inner), right
// (outer), bottom (on y = 0), top (on x = 0). Gradings: powers of the distance from the outside and from angle 0.
inline Mesh<2> quarter_ring(double inner, double outer, int across, int around, double radial_grading = 1,
                            double angular_grading = 1) {
    // Mid-side nodes stay in the middle: only ends of elements are graded.
    const auto graded = [](double part, int elements, double power) {
        const double below = std::floor(part * elements + 1e-9) / elements,
                     above = std::ceil(part * elements - 1e-9) / elements;
        return 0.5 * (std::pow(below, power) + std::pow(above, power));
    };
    return mapped(box_mesh({0, 0}, {1, 1}, across, around), [=](std::array<double, 2> X) {
        const double r = outer - (outer - inner) * graded(1 - X[0], across, radial_grading),
                     angle = M_PI / 2 * graded(X[1], around, angular_grading);
        return std::array<double, 2>{r * std::cos(angle), r * std::sin(angle)};
    });
}

}  // namespace aquagraph::solid::test
