#include "physics/geometry/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

namespace aquagraph::geometry {

namespace {

constexpr double pi = std::numbers::pi;

double cross(const Vec<2>& a, const Vec<2>& b) {
    return a.x() * b.y() - a.y() * b.x();
}
double turn(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) {
    return cross(b - a, c - b);
}

double twice_area(std::span<const Vec<2>> corners) {
    double sum = 0;
    for (std::size_t k = 0; k < corners.size(); ++k)
        sum += cross(corners[k] - corners[0], corners[(k + 1) % corners.size()] - corners[0]);
    return sum;
}

void require_round(double radius, double chord_error) {
    if (!(radius > 0) || !std::isfinite(radius)) throw ShapeError("the radius must be positive");
    if (!(chord_error > 0)) throw ShapeError("the chord error must be positive");
}

template <int D>
void outward_to(FluidSide fluid, Surface<D>& surface) {
    if (fluid == FluidSide::inside) surface.flip();
}

// Two unit vectors u, v with u × v = axis.
std::pair<Vec<3>, Vec<3>> across(const Vec<3>& axis) {
    const Vec<3> u = axis.unitOrthogonal();
    return {u, axis.cross(u)};
}

struct Icosahedron {
    std::array<Vec<3>, 12> corner;
    std::array<std::array<int, 3>, 20> face{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                             {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                             {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                             {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
    Icosahedron() {
        const double g = std::numbers::phi;
        const double c[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
        for (std::size_t k = 0; k < 12; ++k) corner[k] = Vec<3>(c[k][0], c[k][1], c[k][2]).normalized();
    }
    // Corner (i, j) of face f divided n times, on the unit sphere.
    Vec<3> point(std::size_t f, int i, int j, int n) const {
        const auto& [a, b, c] = face[f];
        return (double(n - i - j) * corner[std::size_t(a)] + double(i) * corner[std::size_t(b)] +
                double(j) * corner[std::size_t(c)])
            .normalized();
    }
};

// Part of the radius by which the facets of an icosahedron divided n times cut the sphere short.
double shortfall_of_icosphere(int n) {
    const Icosahedron base;
    double nearest = 1;  // all faces are alike
    const auto look = [&](const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
        nearest = std::min(nearest, a.dot((b - a).cross(c - a).normalized()));
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            const Vec<3> a = base.point(0, i, j, n), b = base.point(0, i + 1, j, n), c = base.point(0, i, j + 1, n);
            look(a, b, c);
            if (i + j + 1 < n) look(b, base.point(0, i + 1, j + 1, n), c);
        }
    return 1 - nearest;
}

}  // namespace

Surface<2> polyline(std::span<const Vec<2>> points, bool closed) {
    Surface<2> made;
    const int n = int(points.size());
    if (n < 2) throw ShapeError("a polyline needs at least two points");
    made.vertices.assign(points.begin(), points.end());
    for (int k = 0; k + 1 < n; ++k) made.facets.push_back({k, k + 1});
    if (closed) made.facets.push_back({n - 1, 0});
    for (std::size_t f = 0; f < made.facets.size(); ++f)
        if (!(made.measure(f) > 0)) throw ShapeError("segment " + std::to_string(f + 1) + " has no length");
    return made;
}

template <int D>
Surface<D> box(const Vec<D>& min, const Vec<D>& max, FluidSide fluid, const OpenSides<D>& open) {
    if (!(min.array() < max.array()).all()) throw ShapeError("a box needs max beyond min in every direction");
    Surface<D> made;
    for (int corner = 0; corner < 1 << D; ++corner) {
        Vec<D> x;
        for (int d = 0; d < D; ++d) x[d] = corner >> d & 1 ? max[d] : min[d];
        made.vertices.push_back(x);
    }
    for (int d = 0; d < D; ++d) {
        for (int end = 0; end < 2; ++end) {
            if (open[std::size_t(d)][std::size_t(end)]) continue;
            const int at = end << d;
            if constexpr (D == 2) {
                const int step = 1 << (1 - d);
                // Outward front, the outside on the left: x = min walked upwards, x = max downwards, y = min leftwards.
                if ((d == 0) == (end == 0))
                    made.facets.push_back({at, at + step});
                else
                    made.facets.push_back({at + step, at});
            } else {
                const int u = 1 << (d + 1) % 3, v = 1 << (d + 2) % 3;
                if (end == 1) {
                    made.facets.push_back({at, at + u, at + u + v});
                    made.facets.push_back({at, at + u + v, at + v});
                } else {
                    made.facets.push_back({at, at + u + v, at + u});
                    made.facets.push_back({at, at + v, at + u + v});
                }
            }
        }
    }
    if (made.facets.empty()) throw ShapeError("a box with all its sides open is no wall");
    made.drop_unused_vertices();
    outward_to(fluid, made);
    return made;
}

Surface<3> rectangle(const Vec<3>& corner, const Vec<3>& a, const Vec<3>& b) {
    if (!(a.cross(b).norm() > 1e-12 * a.norm() * b.norm()))
        throw ShapeError("the two sides are parallel or have no length");
    Surface<3> made;
    made.vertices = {corner, corner + a, corner + a + b, corner + b};
    made.facets = {{0, 1, 2}, {0, 2, 3}};
    return made;
}

Surface<3> plane_polygon(std::span<const Vec<3>> corners) {
    if (corners.size() < 3) throw ShapeError("a face needs at least three corners");
    Vec<3> normal = Vec<3>::Zero(), low = corners[0], high = corners[0];
    for (std::size_t k = 0; k < corners.size(); ++k) {
        normal += (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
        low = low.cwiseMin(corners[k]);
        high = high.cwiseMax(corners[k]);
    }
    const double size = (high - low).norm();
    if (!(normal.norm() > 1e-12 * size * size)) throw ShapeError("the corners of the face lie on one line");
    normal.normalize();
    const auto [u, v] = across(normal);
    std::vector<Vec<2>> flat;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec<3> x = corners[k] - corners[0];
        if (std::fabs(x.dot(normal)) > 1e-6 * size)
            throw ShapeError("corner " + std::to_string(k + 1) + " of the face lies " +
                             std::to_string(std::fabs(x.dot(normal))) + " m off the plane of the others");
        flat.emplace_back(x.dot(u), x.dot(v));
    }
    Surface<3> made;
    made.vertices.assign(corners.begin(), corners.end());
    made.facets = triangles_of_polygon(flat);
    return made;
}

Surface<3> extrude(std::span<const Vec<2>> points, bool closed, int axis, double from, double to, bool caps) {
    if (!(to > from)) throw ShapeError("`to` must lie beyond `from`");
    if (caps && !closed) throw ShapeError("only a closed polyline can have caps");
    const Surface<2> line = polyline(points, closed);
    const int n = int(points.size()), first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    Surface<3> made;
    for (const double at : {from, to}) {
        for (const Vec<2>& p : points) {
            Vec<3> x;
            x[axis] = at;
            x[first] = p.x();
            x[second] = p.y();
            made.vertices.push_back(x);
        }
    }
    // For z the left of a -> b is seen at b(from) -> a(from) -> a(to); (x, z) is a left-handed pair about y.
    for (const auto& [a, b] : line.facets) {
        made.facets.push_back({b, a, a + n});
        made.facets.push_back({b, a + n, b + n});
    }
    if (caps) {
        // Triangles turn as the polygon does, so that one rule serves water inside and outside.
        for (const auto& [a, b, c] : triangles_of_polygon(points)) {
            made.facets.push_back({a, b, c});
            made.facets.push_back({a + n, c + n, b + n});
        }
    }
    if (axis == 1) made.flip();
    return made;
}

int segments_of_circle(double radius, double chord_error) {
    require_round(radius, chord_error);
    if (chord_error >= radius) return 8;
    const double n = std::ceil(pi / std::acos(1 - chord_error / radius) * (1 - 1e-12));
    if (n > 1e7) throw ShapeError("the chord error is too small: more than ten million segments");
    return std::max(8, int(n));
}

Surface<2> circle(const Vec<2>& centre, double radius, double chord_error, FluidSide fluid) {
    const int n = segments_of_circle(radius, chord_error);
    Surface<2> made;
    for (int k = 0; k < n; ++k) {
        const double angle = 2 * pi * k / n;
        made.vertices.push_back(centre + radius * Vec<2>(std::cos(angle), std::sin(angle)));
        made.facets.push_back({(k + 1) % n, k});
    }
    outward_to(fluid, made);
    return made;
}

Surface<3> cylinder(const Vec<3>& from, const Vec<3>& to, double radius, double chord_error, FluidSide fluid,
                    std::array<bool, 2> open) {
    const int n = segments_of_circle(radius, chord_error);
    if (!((to - from).norm() > 0)) throw ShapeError("the axis of the cylinder has no length");
    const auto [u, v] = across((to - from).normalized());
    Surface<3> made;
    for (const Vec<3>& end : {from, to})
        for (int k = 0; k < n; ++k) {
            const double angle = 2 * pi * k / n;
            made.vertices.push_back(end + radius * (std::cos(angle) * u + std::sin(angle) * v));
        }
    for (int k = 0; k < n; ++k) {
        const int next = (k + 1) % n;
        made.facets.push_back({k, next, next + n});
        made.facets.push_back({k, next + n, k + n});
    }
    for (int end = 0; end < 2; ++end) {
        if (open[std::size_t(end)]) continue;
        const int middle = int(made.vertices.size()), base = end * n;
        made.vertices.push_back(end == 0 ? from : to);
        for (int k = 0; k < n; ++k) {
            const int a = base + k, b = base + (k + 1) % n;
            if (end == 0)
                made.facets.push_back({middle, b, a});
            else
                made.facets.push_back({middle, a, b});
        }
    }
    outward_to(fluid, made);
    return made;
}

Surface<3> sphere(const Vec<3>& centre, double radius, double chord_error, FluidSide fluid) {
    require_round(radius, chord_error);
    int n = 1;
    while (shortfall_of_icosphere(n) * radius > chord_error) {
        if (++n > 400) throw ShapeError("the chord error is too small: more than three million triangles");
    }
    const Icosahedron base;
    Surface<3> made;
    // Corners on edges of the icosahedron are shared: found again by which corners they divide, and how.
    std::map<std::array<int, 6>, int> known;
    const auto corner = [&](std::size_t f, int i, int j) {
        std::array<std::array<int, 2>, 3> parts{
            {{base.face[f][0], n - i - j}, {base.face[f][1], i}, {base.face[f][2], j}}};
        for (auto& [of, weight] : parts)
            if (weight == 0) of = -1;
        std::sort(parts.begin(), parts.end());
        const auto [place, is_new] = known.try_emplace(
            {parts[0][0], parts[0][1], parts[1][0], parts[1][1], parts[2][0], parts[2][1]}, int(made.vertices.size()));
        if (is_new) made.vertices.push_back(centre + radius * base.point(f, i, j, n));
        return place->second;
    };
    for (std::size_t f = 0; f < 20; ++f)
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                const int a = corner(f, i, j), b = corner(f, i + 1, j), c = corner(f, i, j + 1);
                made.facets.push_back({a, b, c});
                if (i + j + 1 < n) made.facets.push_back({b, corner(f, i + 1, j + 1), c});
            }
    outward_to(fluid, made);
    return made;
}

// Ear clipping: cuts off corner after corner that no other corner lies in.
std::vector<std::array<int, 3>> triangles_of_polygon(std::span<const Vec<2>> corners) {
    if (corners.size() < 3) throw ShapeError("a polygon needs at least three corners");
    const double area = twice_area(corners), sign = area < 0 ? -1 : 1;
    if (!(std::fabs(area) > 0)) throw ShapeError("the polygon has no area");
    std::vector<int> left(corners.size());
    std::iota(left.begin(), left.end(), 0);
    const auto at = [&](int k) -> const Vec<2>& { return corners[std::size_t(k)]; };
    std::vector<int> reflex;  // only these can lie in an ear
    const auto is_ear = [&](int a, int b, int c) {
        if (sign * turn(at(a), at(b), at(c)) <= 0) return false;
        return std::none_of(reflex.begin(), reflex.end(), [&](int k) {
            if (k == a || k == b || k == c || at(k) == at(a) || at(k) == at(b) || at(k) == at(c)) return false;
            return sign * turn(at(a), at(b), at(k)) >= 0 && sign * turn(at(b), at(c), at(k)) >= 0 &&
                   sign * turn(at(c), at(a), at(k)) >= 0;
        });
    };
    std::vector<std::array<int, 3>> triangles;
    while (left.size() > 3) {
        const std::size_t n = left.size();
        const auto before = [&](std::size_t k) { return left[(k + n - 1) % n]; };
        const auto after = [&](std::size_t k) { return left[(k + 1) % n]; };
        reflex.clear();
        for (std::size_t k = 0; k < n; ++k)
            if (sign * turn(at(before(k)), at(left[k]), at(after(k))) <= 0) reflex.push_back(left[k]);
        std::size_t ear = n;
        double largest = 0;
        for (std::size_t k = 0; k < n; ++k) {  // the fattest one, or a round polygon ends in slivers
            const int a = before(k), b = left[k], c = after(k);
            const double longest =
                std::max({(at(a) - at(b)).squaredNorm(), (at(b) - at(c)).squaredNorm(), (at(c) - at(a)).squaredNorm()});
            const double fatness = sign * turn(at(a), at(b), at(c)) / longest;
            if (fatness > largest && is_ear(a, b, c)) {
                largest = fatness;
                ear = k;
            }
        }
        if (ear == n) throw ShapeError("the polygon crosses or touches itself");
        triangles.push_back({before(ear), left[ear], after(ear)});
        left.erase(left.begin() + std::ptrdiff_t(ear));
    }
    triangles.push_back({left[0], left[1], left[2]});
    double sum = 0;
    for (const auto& [a, b, c] : triangles) sum += std::fabs(turn(at(a), at(b), at(c)));
    if (std::fabs(sum - std::fabs(area)) > 1e-9 * std::fabs(area))
        throw ShapeError("the polygon crosses or touches itself");
    return triangles;
}

void transform(Surface<3>& surface, double scale, const Vec<3>& axis, double angle, const Vec<3>& translation) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (angle != 0) turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    for (Vec<3>& x : surface.vertices) x = turn * (scale * x) + translation;
}

template Surface<2> box<2>(const Vec<2>&, const Vec<2>&, FluidSide, const OpenSides<2>&);
template Surface<3> box<3>(const Vec<3>&, const Vec<3>&, FluidSide, const OpenSides<3>&);

}  // namespace aquagraph::geometry
