#include "physics/fluid/walls/panels.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace aquagraph::fluid {

template <int D>
void Panels<D>::update_geometry() {
    normal.resize(size());
    tangent.resize(size());
    centroid.resize(size());
    measure.resize(size());
    for (std::size_t k = 0; k < size(); ++k) {
        const Vec<D> along = vertex(k, 1) - start(k);
        const double length = along.norm();
        tangent[k] = along / length;
        if constexpr (D == 2) {
            measure[k] = length;
            normal[k] = Vec2(-tangent[k].y(), tangent[k].x());
            centroid[k] = 0.5 * (start(k) + end(k));
        } else {
            const Vec3 twice_area = along.cross(Vec3(vertex(k, 2) - start(k)));
            const double norm = twice_area.norm();
            measure[k] = 0.5 * norm;
            normal[k] = twice_area / norm;
            centroid[k] = (vertex(k, 0) + vertex(k, 1) + vertex(k, 2)) / 3;
        }
    }
}

template <int D>
std::array<double, D> Panels<D>::shape_functions(std::size_t panel, const Vec<D>& x) const {
    if constexpr (D == 2) {
        const double s = (x - start(panel)).dot(tangent[panel]) / measure[panel];
        return {1 - s, s};
    } else {
        const Vec3 &a = vertex(panel, 0), &b = vertex(panel, 1), &c = vertex(panel, 2), &n = normal[panel];
        const double inverse = 0.5 / measure[panel];
        const double at_b = Vec3(x - a).cross(Vec3(c - a)).dot(n) * inverse,
                     at_c = Vec3(b - a).cross(Vec3(x - a)).dot(n) * inverse;
        return {1 - at_b - at_c, at_b, at_c};
    }
}

template <int D>
std::array<double, D> Panels<D>::shape_functions_on(std::size_t panel, const Vec<D>& x) const {
    std::array<double, D> shape = shape_functions(panel, x);
    if constexpr (D == 2) {
        const double s = std::clamp(shape[1], 0.0, 1.0);
        return {1 - s, s};
    } else {
        double sum = 0;
        for (double& value : shape) sum += value = std::max(0.0, value);
        for (double& value : shape) value /= sum;
        return shape;
    }
}

template <int D>
bool Panels<D>::is_over(std::size_t panel, const Vec<D>& x) const {
    if constexpr (D == 2) {
        const double s = (x - start(panel)).dot(tangent[panel]);
        return s >= 0 && s <= measure[panel];
    } else {
        const auto shape = shape_functions(panel, x);
        return std::min({shape[0], shape[1], shape[2]}) >= -1e-6;  // or a foot could slip between two triangles
    }
}

namespace {

// Vertices in the same place get the same number: the smallest of theirs. The same place is closer than a millionth of
// the shortest side that ends there.
template <int D>
std::vector<int> places(const Panels<D>& panels) {
    const std::size_t n = panels.position.size();
    std::vector<double> tolerance(n, 0);
    for (std::size_t k = 0; k < panels.size(); ++k)
        for (std::size_t a = 0; a < D; ++a)
            for (std::size_t b = 0; b < D; ++b) {
                if (a == b) continue;
                double& of = tolerance[std::size_t(panels.panels[k].vertex[a])];
                const double side = 1e-6 * (panels.vertex(k, b) - panels.vertex(k, a)).norm();
                of = of == 0 ? side : std::min(of, side);
            }
    const double widest = n == 0 ? 0 : *std::max_element(tolerance.begin(), tolerance.end());
    std::vector<int> order(n), place(n);
    std::iota(order.begin(), order.end(), 0);
    std::iota(place.begin(), place.end(), 0);
    const auto x = [&](int v) { return panels.position[std::size_t(v)].x(); };
    std::sort(order.begin(), order.end(), [&](int a, int b) { return x(a) < x(b) || (x(a) == x(b) && a < b); });
    const auto root = [&](int v) {
        while (place[std::size_t(v)] != v) v = place[std::size_t(v)];
        return v;
    };
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = k + 1; l < n && x(order[l]) - x(order[k]) < widest; ++l) {
            const auto a = std::size_t(order[k]), b = std::size_t(order[l]);
            if ((panels.position[a] - panels.position[b]).norm() >= std::min(tolerance[a], tolerance[b])) continue;
            const int p = root(int(a)), q = root(int(b));
            place[std::size_t(std::max(p, q))] = std::min(p, q);
        }
    for (std::size_t v = 0; v < n; ++v) place[v] = root(int(v));
    return place;
}

}  // namespace

template <int D>
void Panels<D>::find_joints() {
    joints.clear();
    const std::vector<int> place = places(*this);
    // Sides by where they lie and which way they run: a panel meets those that run the other way.
    using Side = std::array<int, D - 1>;
    struct Entry {
        Side side;
        int panel;
    };
    const auto by_side = [](const Entry& a, const Entry& b) {
        return a.side < b.side || (a.side == b.side && a.panel < b.panel);
    };
    const auto place_of = [&](std::size_t k, std::size_t v) { return place[std::size_t(panels[k].vertex[v])]; };
    std::vector<Entry> begun;
    for (std::size_t k = 0; k < size(); ++k) {
        if constexpr (D == 2)
            begun.push_back({{place_of(k, 0)}, int(k)});
        else
            for (std::size_t v = 0; v < 3; ++v) begun.push_back({{place_of(k, (v + 1) % 3), place_of(k, v)}, int(k)});
    }
    std::sort(begun.begin(), begun.end(), by_side);
    const auto join = [&](std::size_t k, const Side& side, const Side& vertex) {
        for (auto other = std::lower_bound(begun.begin(), begun.end(), Entry{side, -1}, by_side);
             other != begun.end() && other->side == side; ++other)
            if (D == 2 ? other->panel != int(k) : other->panel > int(k))
                joints.push_back({{int(k), other->panel}, vertex});
    };
    for (std::size_t k = 0; k < size(); ++k) {
        const auto& vertex = panels[k].vertex;
        if constexpr (D == 2)
            join(k, {place_of(k, 1)}, {vertex[1]});
        else
            for (std::size_t v = 0; v < 3; ++v)
                join(k, {place_of(k, v), place_of(k, (v + 1) % 3)}, {vertex[v], vertex[(v + 1) % 3]});
    }
}

template <int D>
int Panels<D>::add_wall(const std::string& name, const std::vector<Vec<D>>& points, bool closed,
                        bool no_slip) requires(D == 2) {
    const int wall = int(names.size()), base = int(position.size()), n = int(points.size());
    names.push_back(name);
    for (const Vec2& point : points) {
        position.push_back(point);
        velocity.push_back(Vec2::Zero());
    }
    for (int i = 0; i + 1 < n; ++i) panels.push_back({{base + i, base + i + 1}, wall, no_slip, false});
    if (closed) panels.push_back({{base + n - 1, base}, wall, no_slip, false});
    return wall;
}

template <int D>
int Panels<D>::add_wall(const std::string& name, const std::vector<Vec<D>>& points,
                        const std::vector<std::array<int, 3>>& triangles, bool no_slip) requires(D == 3) {
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const auto at = [&](std::size_t v) {
            const int p = triangles[k][v];
            if (p < 0 || std::size_t(p) >= points.size())
                throw std::invalid_argument("triangle " + std::to_string(k) + " of wall '" + name + "' names point " +
                                            std::to_string(p) + ", but there are " + std::to_string(points.size()));
            return points[std::size_t(p)];
        };
        const Vec3 ab = at(1) - at(0), ac = at(2) - at(0);
        if (!(ab.cross(ac).norm() > 1e-12 * std::max(ab.squaredNorm(), ac.squaredNorm())))
            throw std::invalid_argument("triangle " + std::to_string(k) + " of wall '" + name + "' has no area");
    }
    const int wall = int(names.size()), base = int(position.size());
    names.push_back(name);
    position.insert(position.end(), points.begin(), points.end());
    velocity.resize(position.size(), Vec3::Zero());
    for (const auto& [a, b, c] : triangles) panels.push_back({{base + a, base + b, base + c}, wall, no_slip, false});
    return wall;
}

namespace {
template <int D>
std::vector<int> patches(const Panels<D>& panels, double largest_turn) {
    const double least_cosine = std::cos(largest_turn);
    std::vector<int> patch(panels.size());
    std::iota(patch.begin(), patch.end(), 0);
    const auto root = [&](int k) {
        while (patch[std::size_t(k)] != k) k = patch[std::size_t(k)];
        return k;
    };
    for (const Joint<D>& joint : panels.joints) {
        const auto k = std::size_t(joint.panel[0]), l = std::size_t(joint.panel[1]);
        if (panels.normal[k].dot(panels.normal[l]) <= least_cosine) continue;
        const int a = root(joint.panel[0]), b = root(joint.panel[1]);
        patch[std::size_t(std::max(a, b))] = std::min(a, b);
    }
    for (std::size_t k = 0; k < patch.size(); ++k) patch[k] = root(int(k));
    return patch;
}
}  // namespace

template <int D>
std::vector<int> smooth_patches(const Panels<D>& panels) {
    return patches(panels, std::numbers::pi / 6);
}

template <int D>
std::vector<int> flat_facets(const Panels<D>& panels) {
    return patches(panels, 1e-3);
}

template struct Panels<2>;
template struct Panels<3>;
template std::vector<int> smooth_patches(const Panels<2>&);
template std::vector<int> smooth_patches(const Panels<3>&);
template std::vector<int> flat_facets(const Panels<2>&);
template std::vector<int> flat_facets(const Panels<3>&);

}  // namespace aquagraph::fluid
