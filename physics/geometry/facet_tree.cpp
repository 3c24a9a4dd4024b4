#include "physics/geometry/facet_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace aquagraph::geometry {

namespace {

constexpr int facets_per_leaf = 4;

// A place of a facet and which part of it that is: 0 its inside, 1 a side, 2 a vertex; and which of them.
template <int D>
struct Foot {
    Vec<D> place;
    std::array<int, 2> part;
};

Foot<2> nearest_on(const Surface<2>& s, std::size_t f, const Vec<2>& x) {
    const Vec<2>&a = s.vertex(f, 0), &b = s.vertex(f, 1);
    const double t = (x - a).dot(b - a) / (b - a).squaredNorm();
    if (t <= 0) return {a, {2, 0}};
    if (t >= 1) return {b, {2, 1}};
    return {a + t * (b - a), {0, 0}};
}

// By the seven Voronoi regions of a triangle.
Foot<3> nearest_on(const Surface<3>& s, std::size_t f, const Vec<3>& x) {
    const Vec<3>&a = s.vertex(f, 0), &b = s.vertex(f, 1), &c = s.vertex(f, 2);
    const Vec<3> ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
    const double a1 = ab.dot(ax), a2 = ac.dot(ax);
    if (a1 <= 0 && a2 <= 0) return {a, {2, 0}};
    const double b1 = ab.dot(bx), b2 = ac.dot(bx);
    if (b1 >= 0 && b2 <= b1) return {b, {2, 1}};
    const double c1 = ab.dot(cx), c2 = ac.dot(cx);
    if (c2 >= 0 && c1 <= c2) return {c, {2, 2}};
    const double on_ab = a1 * b2 - b1 * a2;
    if (on_ab <= 0 && a1 >= 0 && b1 <= 0) return {a + a1 / (a1 - b1) * ab, {1, 0}};
    const double on_ca = c1 * a2 - a1 * c2;
    if (on_ca <= 0 && a2 >= 0 && c2 <= 0) return {a + a2 / (a2 - c2) * ac, {1, 2}};
    const double on_bc = b1 * c2 - c1 * b2;
    if (on_bc <= 0 && b2 - b1 >= 0 && c1 - c2 >= 0) return {b + (b2 - b1) / ((b2 - b1) + (c1 - c2)) * (c - b), {1, 1}};
    const double sum = on_ab + on_ca + on_bc;
    return {a + on_ca / sum * ab + on_ab / sum * ac, {0, 0}};
}

template <int D>
double distance2_to_box(const Vec<D>& x, const Vec<D>& low, const Vec<D>& high) {
    return (low - x).cwiseMax(x - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace

template <int D>
FacetTree<D>::FacetTree(const Surface<D>& surface) : surface_(surface) {
    const std::size_t n = surface_.facets.size();
    low_.resize(n);
    high_.resize(n);
    normal_.resize(n);
    for (std::size_t f = 0; f < n; ++f) {
        low_[f] = high_[f] = surface_.vertex(f, 0);
        for (std::size_t k = 1; k < D; ++k) {
            low_[f] = low_[f].cwiseMin(surface_.vertex(f, k));
            high_[f] = high_[f].cwiseMax(surface_.vertex(f, k));
        }
        normal_[f] = surface_.front(f).normalized();
    }
    pseudo_normals();
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), 0);
    if (n > 0) build(0, int(n));
}

template <int D>
void FacetTree<D>::pseudo_normals() {
    const std::size_t n = surface_.facets.size(), vertices = surface_.vertices.size();
    vertex_normal_.assign(vertices, Vec<D>::Zero());
    vertex_on_rim_.assign(vertices, false);
    if constexpr (D == 2) {
        std::vector<int> uses(vertices);
        for (std::size_t f = 0; f < n; ++f)
            for (const int v : surface_.facets[f]) {
                vertex_normal_[std::size_t(v)] += normal_[f];
                ++uses[std::size_t(v)];
            }
        for (std::size_t v = 0; v < vertices; ++v) vertex_on_rim_[v] = uses[v] < 2;
    } else {
        std::map<std::array<int, 2>, std::pair<Vec<3>, int>> edges;
        const auto edge = [&](std::size_t f, std::size_t k) {
            const int a = surface_.facets[f][k], b = surface_.facets[f][(k + 1) % 3];
            return std::array{std::min(a, b), std::max(a, b)};
        };
        for (std::size_t f = 0; f < n; ++f)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec<3> to_next = (surface_.vertex(f, (k + 1) % 3) - surface_.vertex(f, k)).normalized(),
                             to_last = (surface_.vertex(f, (k + 2) % 3) - surface_.vertex(f, k)).normalized();
                const double angle = std::acos(std::clamp(to_next.dot(to_last), -1.0, 1.0));
                vertex_normal_[std::size_t(surface_.facets[f][k])] += angle * normal_[f];
                auto& [sum, uses] = edges.try_emplace(edge(f, k), Vec<3>(Vec<3>::Zero()), 0).first->second;
                sum += normal_[f];
                ++uses;
            }
        edge_normal_.resize(n);
        edge_on_rim_.resize(n);
        for (std::size_t f = 0; f < n; ++f)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& [sum, uses] = edges.at(edge(f, k));
                edge_normal_[f][k] = sum;
                edge_on_rim_[f][k] = uses < 2;
                if (uses < 2)
                    for (const int v : edge(f, k)) vertex_on_rim_[std::size_t(v)] = true;
            }
    }
}

template <int D>
int FacetTree<D>::build(int begin, int end) {
    const int node = int(nodes_.size());
    nodes_.push_back({Vec<D>::Zero(), Vec<D>::Zero(), begin, end, -1});
    Vec<D> low = low_[std::size_t(order_[std::size_t(begin)])], high = high_[std::size_t(order_[std::size_t(begin)])];
    Vec<D> first = low + high, last = first;  // of twice the middles
    for (int k = begin; k < end; ++k) {
        const auto f = std::size_t(order_[std::size_t(k)]);
        low = low.cwiseMin(low_[f]);
        high = high.cwiseMax(high_[f]);
        first = first.cwiseMin(low_[f] + high_[f]);
        last = last.cwiseMax(low_[f] + high_[f]);
    }
    int right = -1;
    if (end - begin > facets_per_leaf) {
        Eigen::Index d = 0;
        (last - first).maxCoeff(&d);
        const int half = (begin + end) / 2;
        std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end, [&](int a, int b) {
            const double at_a = low_[std::size_t(a)][d] + high_[std::size_t(a)][d],
                         at_b = low_[std::size_t(b)][d] + high_[std::size_t(b)][d];
            return at_a < at_b || (at_a == at_b && a < b);
        });
        build(begin, half);
        right = build(half, end);
    }
    nodes_[std::size_t(node)] = {low, high, begin, end, right};
    return node;
}

template <int D>
void FacetTree<D>::look(int node, const Vec<D>& x, Nearest<D>& best, std::array<int, 2>& part) const {
    const Node& at = nodes_[std::size_t(node)];
    if (at.right < 0) {
        for (int k = at.begin; k < at.end; ++k) {
            const int f = order_[std::size_t(k)];
            const Foot<D> foot = nearest_on(surface_, std::size_t(f), x);
            const double distance = (x - foot.place).norm();
            if (distance < best.distance || (distance == best.distance && best.facet >= 0 && f < best.facet)) {
                best.facet = f;
                best.distance = distance;
                best.place = foot.place;
                part = foot.part;
            }
        }
        return;
    }
    const int left = node + 1;
    const auto far = [&](int child) {
        return distance2_to_box(x, nodes_[std::size_t(child)].low, nodes_[std::size_t(child)].high);
    };
    const double to_left = far(left), to_right = far(at.right);
    const bool left_first = to_left <= to_right;
    // A little more than the best, so that equal distances are all seen and the order of facets decides.
    const auto worth = [&](double distance2) { return distance2 <= best.distance * best.distance * (1 + 1e-14); };
    if (worth(left_first ? to_left : to_right)) look(left_first ? left : at.right, x, best, part);
    if (worth(left_first ? to_right : to_left)) look(left_first ? at.right : left, x, best, part);
}

template <int D>
Nearest<D> FacetTree<D>::nearest(const Vec<D>& x, double within) const {
    Nearest<D> best;
    best.distance = within;
    std::array<int, 2> part{};
    if (!nodes_.empty()) look(0, x, best, part);
    if (best.facet < 0) return best;
    const auto f = std::size_t(best.facet), k = std::size_t(part[1]);
    if (part[0] == 0) {
        best.normal = normal_[f];
    } else if (part[0] == 2) {
        const auto v = std::size_t(surface_.facets[f][k]);
        best.normal = vertex_normal_[v];
        best.rim = vertex_on_rim_[v];
    } else if constexpr (D == 3) {
        best.normal = edge_normal_[f][k];
        best.rim = edge_on_rim_[f][k];
    }
    best.side_ = (x - best.place).dot(best.normal);
    return best;
}

template <int D>
void FacetTree<D>::in_box(const Vec<D>& low, const Vec<D>& high, std::vector<int>& facets) const {
    if (nodes_.empty()) return;
    std::vector<int> open{0};
    const auto meets = [&](const Vec<D>& a, const Vec<D>& b) {
        return (a.array() <= high.array()).all() && (b.array() >= low.array()).all();
    };
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        const Node& at = nodes_[std::size_t(node)];
        if (!meets(at.low, at.high)) continue;
        if (at.right >= 0) {
            open.push_back(node + 1);
            open.push_back(at.right);
            continue;
        }
        for (int k = at.begin; k < at.end; ++k) {
            const int f = order_[std::size_t(k)];
            if (meets(low_[std::size_t(f)], high_[std::size_t(f)])) facets.push_back(f);
        }
    }
}

template class FacetTree<2>;
template class FacetTree<3>;

}  // namespace aquagraph::geometry
