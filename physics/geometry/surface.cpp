#include "physics/geometry/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace aquagraph::geometry {

namespace {

// D times the volume between a facet and the origin, positive where its front looks away from the origin.
double cone(const Vec<2>& a, const Vec<2>& b) {
    return -(a.x() * b.y() - a.y() * b.x());
}
double cone(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
    return a.dot(b.cross(c)) / 2;
}

double cone(const Surface<2>& s, std::size_t f, const Vec<2>& origin) {
    return cone(s.vertex(f, 0) - origin, s.vertex(f, 1) - origin);
}
double cone(const Surface<3>& s, std::size_t f, const Vec<3>& origin) {
    return cone(s.vertex(f, 0) - origin, s.vertex(f, 1) - origin, s.vertex(f, 2) - origin);
}

// The part of a facet below a level, as a polygon (2D: two points) of at most D + 1 corners.
template <int D>
std::vector<Vec<D>> clipped(const Surface<D>& s, std::size_t f, double level) {
    std::vector<Vec<D>> kept;
    const std::size_t sides = D == 2 ? 1 : 3;
    const auto cut = [&](const Vec<D>& a, const Vec<D>& b) -> Vec<D> {
        return a + (level - a[D - 1]) / (b[D - 1] - a[D - 1]) * (b - a);
    };
    for (std::size_t k = 0; k < sides; ++k) {
        const Vec<D>&a = s.vertex(f, k), &b = s.vertex(f, (k + 1) % D);
        const bool below_a = a[D - 1] < level, below_b = b[D - 1] < level;
        if (below_a) kept.push_back(a);
        if (below_a != below_b) kept.push_back(cut(a, b));
        if (D == 2 && below_b) kept.push_back(b);
    }
    return kept;
}

template <int D>
struct CellHash {
    std::size_t operator()(const std::array<std::int64_t, D>& cell) const {
        std::uint64_t h = 0x9e3779b97f4a7c15ULL;
        for (const std::int64_t c : cell) {
            h ^= std::uint64_t(c);
            h *= 0xff51afd7ed558ccdULL;
            h ^= h >> 32;
        }
        return std::size_t(h);
    }
};

}  // namespace

template <int D>
Vec<D> Surface<D>::centroid(std::size_t facet) const {
    Vec<D> sum = Vec<D>::Zero();
    for (std::size_t k = 0; k < D; ++k) sum += vertex(facet, k);
    return sum / D;
}

template <int D>
Vec<D> Surface<D>::front(std::size_t facet) const {
    if constexpr (D == 2) {
        const Vec<2> along = vertex(facet, 1) - vertex(facet, 0);
        return {-along.y(), along.x()};
    } else {
        return (vertex(facet, 1) - vertex(facet, 0)).cross(vertex(facet, 2) - vertex(facet, 0));
    }
}

template <int D>
double Surface<D>::measure(std::size_t facet) const {
    return front(facet).norm() / (D - 1);
}

template <int D>
void Surface<D>::append(const Surface& other) {
    const int base = int(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (Facet facet : other.facets) {
        for (int& v : facet) v += base;
        facets.push_back(facet);
    }
}

template <int D>
void Surface<D>::flip() {
    for (Facet& facet : facets) std::swap(facet[0], facet[1]);
}

template <int D>
void Surface<D>::drop_unused_vertices() {
    std::vector<int> place(vertices.size(), -1);
    for (const Facet& facet : facets)
        for (const int v : facet) place[std::size_t(v)] = 0;
    std::vector<Vec<D>> kept;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        if (place[v] < 0) continue;
        place[v] = int(kept.size());
        kept.push_back(vertices[v]);
    }
    for (Facet& facet : facets)
        for (int& v : facet) v = place[std::size_t(v)];
    vertices = std::move(kept);
}

template <int D>
double measure(const Surface<D>& surface) {
    double sum = 0;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) sum += surface.measure(f);
    return sum;
}

template <int D>
double enclosed_volume(const Surface<D>& surface) {
    if (surface.facets.empty()) return 0;
    const Vec<D> origin = surface.vertex(0, 0);  // near the surface, or digits are lost
    double sum = 0;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) sum += cone(surface, f, origin);
    return sum / D;
}

template <int D>
double enclosed_volume_below(const Surface<D>& surface, double level) {
    if (surface.facets.empty()) return 0;
    // Seen from a point on the plane of the level, the lid that closes the rest there has no cone.
    Vec<D> origin = surface.vertex(0, 0);
    origin[D - 1] = level;
    double sum = 0;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const std::vector<Vec<D>> piece = clipped(surface, f, level);
        if constexpr (D == 2) {
            if (piece.size() == 2) sum += cone(piece[0] - origin, piece[1] - origin);
        } else {
            for (std::size_t k = 2; k < piece.size(); ++k)
                sum += cone(piece[0] - origin, piece[k - 1] - origin, piece[k] - origin);
        }
    }
    return sum / D;
}

template <int D>
std::pair<Vec<D>, Vec<D>> bounds(const Surface<D>& surface) {
    Vec<D> low = surface.vertices.front(), high = low;
    for (const Vec<D>& x : surface.vertices) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    return {low, high};
}

template <int D>
void weld(Surface<D>& surface, double tolerance) {
    if (surface.vertices.empty() || !(tolerance > 0)) return;
    using Cell = std::array<std::int64_t, D>;
    const Vec<D> origin = bounds(surface).first;
    const auto cell_of = [&](const Vec<D>& x) {
        Cell cell;
        for (std::size_t d = 0; d < D; ++d)
            cell[d] = std::int64_t(std::floor((x[Eigen::Index(d)] - origin[Eigen::Index(d)]) / tolerance));
        return cell;
    };
    std::unordered_map<Cell, std::vector<int>, CellHash<D>> cells;
    std::vector<int> place(surface.vertices.size());
    std::vector<Vec<D>> kept;
    constexpr int around = D == 2 ? 9 : 27;
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        const Vec<D>& x = surface.vertices[v];
        const Cell centre = cell_of(x);
        int twin = -1;
        for (int n = 0; n < around; ++n) {
            Cell cell = centre;
            for (int d = 0, rest = n; d < D; ++d, rest /= 3) cell[std::size_t(d)] += rest % 3 - 1;
            const auto found = cells.find(cell);
            if (found == cells.end()) continue;
            for (const int other : found->second)
                if ((kept[std::size_t(other)] - x).norm() <= tolerance && (twin < 0 || other < twin)) twin = other;
        }
        if (twin < 0) {
            twin = int(kept.size());
            kept.push_back(x);
            cells[centre].push_back(twin);
        }
        place[v] = twin;
    }
    for (auto& facet : surface.facets)
        for (int& v : facet) v = place[std::size_t(v)];
    surface.vertices = std::move(kept);
}

template struct Surface<2>;
template struct Surface<3>;
template double measure(const Surface<2>&);
template double measure(const Surface<3>&);
template double enclosed_volume(const Surface<2>&);
template double enclosed_volume(const Surface<3>&);
template double enclosed_volume_below(const Surface<2>&, double);
template double enclosed_volume_below(const Surface<3>&, double);
template std::pair<Vec<2>, Vec<2>> bounds(const Surface<2>&);
template std::pair<Vec<3>, Vec<3>> bounds(const Surface<3>&);
template void weld(Surface<2>&, double);
template void weld(Surface<3>&, double);

}  // namespace aquagraph::geometry
