#include "physics/fluid/filling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/fluid/time_integration.hpp"
#include "physics/geometry/facet_tree.hpp"
#include "physics/geometry/inside.hpp"

namespace aquagraph::fluid {

namespace {
// Cells along one edge; an edge that is a whole number of cells but for rounding counts whole.
std::size_t cells(double length, double spacing) {
    return std::size_t(std::floor(length / spacing * (1 + 1e-9) + 1e-9));
}
}  // namespace

double hydrostatic_deviation(const Tait& tait, double gravity, double depth) {
    if (depth <= 0) return 0;
    const double head = (tait.exponent - 1) * gravity * depth / (tait.sound_speed * tait.sound_speed);
    return tait.reference_density * std::expm1(std::log1p(head) / (tait.exponent - 1));
}

template <int D>
std::size_t particles_in(const FillBox<D>& box, double spacing) {
    std::size_t n = 1;
    for (std::size_t d = 0; d < D; ++d) n *= cells(box.max[d] - box.min[d], spacing);
    return n;
}

template <int D>
Places<D> places_in(const FillBox<D>& box, double spacing) {
    std::array<std::size_t, D> n;
    for (std::size_t d = 0; d < D; ++d) n[d] = cells(box.max[d] - box.min[d], spacing);
    Places<D> places{.x = {}, .volume = std::pow(spacing, D)};
    places.x.resize(particles_in(box, spacing));
    for (std::size_t k = 0; k < places.x.size(); ++k) {
        std::size_t rest = k;
        for (std::size_t d = D; d-- > 0;) {
            places.x[k][Eigen::Index(d)] = box.min[d] + (double(rest % n[d]) + 0.5) * spacing;
            rest /= n[d];
        }
    }
    return places;
}

template <int D>
double Region<D>::volume() const {
    return std::fabs(level ? enclosed_volume_below(boundary, *level) : enclosed_volume(boundary));
}

template <int D>
double Region<D>::top() const {
    const double highest = bounds(boundary).second[D - 1];
    return level ? std::min(*level, highest) : highest;
}

namespace {

// Calls visit(x) for every point of the region's lattice inside its bounding box, and `beyond` cells around it.
template <int D, class Visit>
void each_lattice_point(const Region<D>& region, double spacing, int beyond, const Visit& visit) {
    auto [low, high] = bounds(region.boundary);
    if (region.level) {
        high[D - 1] = std::min(high[D - 1], *region.level);
        low[D - 1] = high[D - 1] - spacing * std::ceil((high[D - 1] - low[D - 1]) / spacing * (1 - 1e-9));
    }
    std::array<std::size_t, D> n;
    std::size_t total = 1;
    for (std::size_t d = 0; d < D; ++d) {
        const double width = std::max(0.0, high[Eigen::Index(d)] - low[Eigen::Index(d)]);
        n[d] = std::size_t(std::ceil(width / spacing * (1 - 1e-9))) + 2 * std::size_t(beyond);
        total *= n[d];
    }
    for (std::size_t k = 0; k < total; ++k) {
        std::size_t rest = k;
        geometry::Vec<D> x;
        for (std::size_t d = D; d-- > 0;) {
            x[Eigen::Index(d)] = low[Eigen::Index(d)] + (double(rest % n[d]) - beyond + 0.5) * spacing;
            rest /= n[d];
        }
        visit(x);
    }
}

}  // namespace

template <int D>
Places<D> places_in(const Region<D>& region, double spacing) {
    const geometry::FacetTree<D> tree(region.boundary);
    const geometry::InsideTest<D> inside(region.boundary);
    Places<D> places{.x = {}, .volume = std::pow(spacing, D)};
    each_lattice_point(region, spacing, 0, [&](const geometry::Vec<D>& x) {
        if (!inside(x) || (region.level && x[D - 1] >= *region.level)) return;
        if (tree.nearest(x, region.clearance - 1e-6 * spacing).facet < 0) places.x.push_back(x);
    });
    return places;
}

template <int D>
Places<D> full_places_in(const Region<D>& region, double spacing) {
    const geometry::FacetTree<D> tree(region.boundary);
    const geometry::InsideTest<D> inside(region.boundary);
    struct Candidate {
        double depth;
        geometry::Vec<D> x;
    };
    std::vector<Candidate> candidates;
    each_lattice_point(region, spacing, 1, [&](const geometry::Vec<D>& x) {
        const bool is_inside = inside(x);
        const auto nearest = tree.nearest(x, is_inside ? std::numeric_limits<double>::infinity() : spacing);
        if (nearest.facet < 0) return;
        double depth = is_inside ? nearest.distance : -nearest.distance;
        if (region.level) depth = std::min(depth, *region.level - x[D - 1]);
        candidates.push_back({depth, x});
    });
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.depth > b.depth; });
    const double volume = region.volume();
    const auto wanted = std::size_t(std::llround(volume / std::pow(spacing, D)));
    Places<D> places;
    for (std::size_t k = 0; k < std::min(wanted, candidates.size()); ++k) places.x.push_back(candidates[k].x);
    if (!places.x.empty()) places.volume = volume / double(places.x.size());
    return places;
}

template <int D>
void fill(Particles<D>& particles, std::span<const Water<D>> bodies, const Tait& tait, double gravity) {
    std::size_t total = 0;
    for (const Water<D>& body : bodies) total += body.places.x.size();
    particles.resize(total, 0);
    std::size_t i = 0;
    for (const Water<D>& body : bodies) {
        for (const geometry::Vec<D>& x : body.places.x) {
            for (std::size_t d = 0; d < D; ++d) {
                particles.x[d][i] = particles.x_built[d][i] = x[Eigen::Index(d)];
                particles.v[d][i] = body.velocity[Eigen::Index(d)];
                particles.acceleration[d][i] = 0;
            }
            const double depth = body.surface_level ? *body.surface_level - x[D - 1] : 0;
            particles.id[i] = std::int64_t(i);
            particles.deviation[i] = hydrostatic_deviation(tait, gravity, depth);
            particles.deviation_rate[i] = 0;
            particles.fullness[i] = 1;
            particles.mass[i] = (tait.reference_density + particles.deviation[i]) * body.places.volume;
            ++i;
        }
    }
    for (std::size_t block = 0; block < particles.blocks(); ++block)
        update_state(particles, tait, lanes_of_block(particles, block));
}

template <int D>
void fill(Particles<D>& particles, const std::vector<FillBox<D>>& boxes, double spacing, const Tait& tait,
          double gravity, std::optional<double> surface_level) {
    std::vector<Water<D>> bodies;
    for (const FillBox<D>& box : boxes)
        bodies.push_back({.places = places_in(box, spacing), .surface_level = surface_level});
    fill<D>(particles, bodies, tait, gravity);
}

template struct Region<2>;
template struct Region<3>;
template Places<2> places_in(const FillBox<2>&, double);
template Places<3> places_in(const FillBox<3>&, double);
template Places<2> places_in(const Region<2>&, double);
template Places<3> places_in(const Region<3>&, double);
template Places<2> full_places_in(const Region<2>&, double);
template Places<3> full_places_in(const Region<3>&, double);
template void fill(Particles<2>&, std::span<const Water<2>>, const Tait&, double);
template void fill(Particles<3>&, std::span<const Water<3>>, const Tait&, double);
template std::size_t particles_in(const FillBox<2>&, double);
template std::size_t particles_in(const FillBox<3>&, double);
template void fill(Particles<2>&, const std::vector<FillBox<2>>&, double, const Tait&, double, std::optional<double>);
template void fill(Particles<3>&, const std::vector<FillBox<3>>&, double, const Tait&, double, std::optional<double>);

}  // namespace aquagraph::fluid
