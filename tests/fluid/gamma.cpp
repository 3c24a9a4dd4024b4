// γ against closed forms, rays and samples that know nothing of panels.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "physics/fluid/walls/gamma.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double pi = std::numbers::pi, R = 0.7;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;

double segment(const KernelMass<2>& mass, const Vector2d& x, const Vector2d& a, const Vector2d& b) {
    const Vector2d t = (b - a).normalized();
    return missing_mass(mass, {a - x, b - x}, Vector2d(-t.y(), t.x()));
}

double triangle(const KernelMass<3>& mass, const Vector3d& x, const Triangle& of) {
    const Vector3d n = (of[1] - of[0]).cross(of[2] - of[0]).normalized();
    return missing_mass(mass, {of[0] - x, of[1] - x, of[2] - x}, n);
}

// Composite Gauss–Legendre with five points on each of n equal parts.
template <class F>
double integral(double from, double to, int n, F&& f) {
    constexpr double node[] = {0, 0.5384693101056831, 0.9061798459386640};
    constexpr double weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    const double h = (to - from) / n;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
        const double middle = from + (k + 0.5) * h;
        sum += weight[0] * f(middle);
        for (int g = 1; g < 3; ++g) sum += weight[g] * (f(middle - 0.5 * h * node[g]) + f(middle + 0.5 * h * node[g]));
    }
    return 0.5 * h * sum;
}

template <class Kernel>
double beyond_plane_2d(const Kernel& kernel, double d) {  // kernel mass beyond a straight wall, by strips
    return integral(d, R, 200, [&](double y) {
        const double end = std::sqrt(R * R - y * y);
        return integral(-end, end, 200, [&](double x) { return kernel.value(std::hypot(x, y)); });
    });
}

template <class Kernel>
double beyond_plane_3d(const Kernel& kernel, double d) {  // by discs
    return integral(d, R, 200, [&](double y) {
        return integral(0, std::sqrt(R * R - y * y), 200,
                        [&](double s) { return 2 * pi * s * kernel.value(std::hypot(s, y)); });
    });
}

// Möller–Trumbore, as an independent judge: distance along the ray, or infinity. front: > 0 seen from its front.
double hit(const Vector3d& x, const Vector3d& e, const Triangle& of, double& front) {
    const Vector3d u = of[1] - of[0], v = of[2] - of[0], n = u.cross(v);
    const double det = -e.dot(n);
    if (det == 0) return INFINITY;
    const Vector3d s = x - of[0], q = s.cross(e);
    const double t = s.dot(n) / det, b = v.dot(q) / det, c = -u.dot(q) / det;
    front = det;
    return b >= 0 && c >= 0 && b + c <= 1 && t > 0 ? t : INFINITY;
}

// Sum over all crossings of n rays, evenly spread over the sphere.
double by_rays(const KernelMass<3>& mass, const Vector3d& x, const std::vector<Triangle>& triangles, int n) {
    double sum = 0;
    const double golden = pi * (3 - std::sqrt(5.0));
    for (int k = 0; k < n; ++k) {
        const double z = 1 - (2 * k + 1.0) / n, s = std::sqrt(1 - z * z);
        const Vector3d e(s * std::cos(golden * k), s * std::sin(golden * k), z);
        for (const Triangle& of : triangles) {
            double front = 0;
            const double t = hit(x, e, of, front);
            if (t < mass.radius && front > 0) sum += mass(t);
        }
    }
    return 4 * pi * sum / n;
}

double by_panels(const KernelMass<3>& mass, const Vector3d& x, const std::vector<Triangle>& triangles) {
    double sum = 0;
    for (const Triangle& of : triangles)
        if ((x - of[0]).dot((of[1] - of[0]).cross(of[2] - of[0])) > 0) sum += triangle(mass, x, of);
    return sum;
}

void add_quad(std::vector<Triangle>& to, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    to.push_back({a, b, c});
    to.push_back({a, c, d});
}

// Faces of a box, fluid outside.
std::vector<Triangle> box(const Vector3d& low, const Vector3d& high) {
    std::vector<Triangle> faces;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const bool top : {false, true}) {
            std::array<Vector3d, 4> c;
            for (int k = 0; k < 4; ++k) {
                Vector3d& x = c[std::size_t(k)];
                x[axis] = top ? high[axis] : low[axis];
                x[u] = k == 1 || k == 2 ? high[u] : low[u];
                x[v] = k >= 2 ? high[v] : low[v];
            }
            if (top)
                add_quad(faces, c[0], c[1], c[2], c[3]);
            else
                add_quad(faces, c[0], c[3], c[2], c[1]);
        }
    }
    return faces;
}

template <template <int> class Kernel>
void check_flat_walls() {
    const Kernel<2> two(R);
    const Kernel<3> three(R);
    const KernelMass<2> mass2(two);
    const KernelMass<3> mass3(three);
    CHECK(mass2(0) == doctest::Approx(1 / (2 * pi)).epsilon(1e-14));
    CHECK(mass3(0) == doctest::Approx(1 / (4 * pi)).epsilon(1e-14));
    CHECK(std::fabs(mass2(R * (1 - 1e-15))) < 1e-14);
    for (const double r : {0.2, 0.49, 0.51, 0.9})
        CHECK(mass3(r * R) ==
              doctest::Approx(integral(r * R, R, 400, [&](double s) { return three.value(s) * s * s; })).epsilon(1e-9));
    for (const double d : {0.02, 0.3, 0.49, 0.51, 0.8, 0.99}) {
        CAPTURE(d);
        const double s2 = segment(mass2, {0.1, d * R}, {-3, 0}, {3, 0});
        CHECK(std::fabs(s2 - beyond_plane_2d(two, d * R)) < 2e-7);
        std::vector<Triangle> plane;
        add_quad(plane, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
        CHECK(std::fabs(by_panels(mass3, {0.1, 0.2, d * R}, plane) - beyond_plane_3d(three, d * R)) < 2e-7);
    }
}

}  // namespace

TEST_CASE("a flat wall takes the kernel's cap, whichever the kernel") {
    check_flat_walls<WendlandC2>();
    check_flat_walls<CubicSpline>();
}

TEST_CASE("2D: the integral over the angle, by quadrature") {
    const KernelMass<2> mass{WendlandC2<2>(R)};
    Random random;
    for (int k = 0; k < 200; ++k) {
        const Vector2d a(random(), random()), b(random(), random());
        const Vector2d t = (b - a).normalized(), n(-t.y(), t.x());
        const double d = R * std::pow(10, 2 * random() - 2);  // 1e-4 … 1 of R
        const Vector2d x = 0.5 * (a + b) + random() * t + d * n;
        // With t = d sinh(s) the angle's element is ds/cosh(s): smooth however close the wall.
        const double end = d < R ? std::acosh(R / d) : 0.0;
        const auto at = [&](const Vector2d& corner) {
            return std::clamp(std::asinh((corner - x).dot(t) / d), -end, end);
        };
        const double expected =
            integral(at(a), at(b), 400, [&](double s) { return mass(d * std::cosh(s)) / std::cosh(s); });
        CHECK(std::fabs(segment(mass, x, a, b) - expected) < 1e-12);
    }
}

TEST_CASE("limits at walls, corners and edges; hardly behind a wall is on it") {
    const KernelMass<2> two{WendlandC2<2>(R)};
    const KernelMass<3> three{WendlandC2<3>(R)};
    for (const double d : {1e-3, 1e-8, 0.0, -1e-8, -0.01}) {
        CAPTURE(d);
        const double near = 2 * std::max(d, 0.0);  // kernel values next to the wall are about 1.5/R
        CHECK(std::fabs(segment(two, {0, d}, {-3, 0}, {3, 0}) - 0.5) <= 1.5 / R * near + 1e-12);
        const double corner = segment(two, {d, d}, {0, 3}, {0, 0}) + segment(two, {d, d}, {0, 0}, {3, 0});
        if (d > 0) CHECK(std::fabs(corner - 0.75) <= 3 / R * near + 1e-12);
    }
    CHECK(std::fabs(segment(two, {1e-9, 2e-9}, {0, 3}, {0, 0}) + segment(two, {1e-9, 2e-9}, {0, 0}, {3, 0}) - 0.75) <
          1e-7);
    // Inside a box, next to its corner and in the middle of an edge.
    std::vector<Triangle> room = box({0, 0, 0}, {3, 3, 3});
    for (Triangle& of : room) std::swap(of[1], of[2]);
    CHECK(std::fabs(1 - by_panels(three, {1e-9, 2e-9, 3e-9}, room) - 0.125) < 1e-7);
    CHECK(std::fabs(1 - by_panels(three, {1e-9, 2e-9, 1.5}, room) - 0.25) < 1e-7);
    CHECK(std::fabs(1 - by_panels(three, {1e-9, 1.4, 1.5}, room) - 0.5) < 1e-7);
    CHECK(by_panels(three, {1.5, 1.4, 1.6}, room) == 0);
    // Beside a panel, level with it: nothing of it is seen.
    CHECK(segment(two, {-3.1, 0}, {-3, 0}, {3, 0}) < 1e-12);
    CHECK(segment(two, {-3.1, -0.01}, {-3, 0}, {3, 0}) < 1e-12);
    CHECK(triangle(three, {-0.1, 0.2, -0.01}, {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}) < 1e-12);
}

TEST_CASE("cutting a panel changes nothing") {
    const KernelMass<2> two{WendlandC2<2>(R)};
    const KernelMass<3> three{WendlandC2<3>(R)};
    Random random(3);
    for (int k = 0; k < 200; ++k) {
        const Vector2d a(random(), random()), b(random(), random()), x(random(), random());
        const Vector2d t = (b - a).normalized();
        if ((x - a).dot(Vector2d(-t.y(), t.x())) > 0) {
            const Vector2d m = a + 0.5 * (1 + random()) * (b - a);
            CHECK(std::fabs(segment(two, x, a, b) - segment(two, x, a, m) - segment(two, x, m, b)) < 1e-14);
        }
        const Triangle whole{Vector3d(random(), random(), random()), Vector3d(random(), random(), random()),
                             Vector3d(random(), random(), random())};
        const Vector3d n = (whole[1] - whole[0]).cross(whole[2] - whole[0]).normalized();
        const Vector3d foot =
            (whole[0] + whole[1] + whole[2]) / 3 + random() * (whole[1] - whole[0]) + random() * (whole[2] - whole[0]);
        const Vector3d y = foot + R * std::pow(10, 4 * random() - 4) * n;
        const Vector3d p = 0.2 * whole[0] + 0.5 * whole[1] + 0.3 * whole[2];
        double parts = 0;
        for (std::size_t e = 0; e < 3; ++e) parts += triangle(three, y, {whole[e], whole[(e + 1) % 3], p});
        CHECK(std::fabs(triangle(three, y, whole) - parts) < 1e-13);
    }
}

TEST_CASE("3D: rays from the particle, for plates, edges, corners and a sphere of triangles") {
    const KernelMass<3> mass{WendlandC2<3>(R)};
    const int rays = 200000;
    const auto agrees = [&](const Vector3d& x, const std::vector<Triangle>& triangles) {
        const double rayed = by_rays(mass, x, triangles, rays);
        CAPTURE(rayed);
        CHECK(rayed > 0.02);
        CHECK(std::fabs(by_panels(mass, x, triangles) - rayed) < 2e-4);
    };
    agrees({0.1, 0.1, 0.15}, box({-0.3, -0.4, -0.05}, {0.35, 0.2, 0.05}));  // a plate thinner than R
    agrees({-0.1, 0.3, 0.05}, box({0, -1, -1}, {1, 1, 0}));                 // off a convex edge
    std::vector<Triangle> room = box({0, 0, 0}, {3, 3, 3});
    for (Triangle& of : room) std::swap(of[1], of[2]);
    agrees({0.1, 0.2, 0.15}, room);
    // A sphere of radius 0.4.
    std::vector<Triangle> sphere = box({-1, -1, -1}, {1, 1, 1});
    for (int level = 0; level < 3; ++level) {
        std::vector<Triangle> finer;
        for (const Triangle& of : sphere) {
            const Vector3d ab = 0.5 * (of[0] + of[1]), bc = 0.5 * (of[1] + of[2]), ca = 0.5 * (of[2] + of[0]);
            for (const Triangle& part : {Triangle{of[0], ab, ca}, {ab, of[1], bc}, {ca, bc, of[2]}, {ab, bc, ca}})
                finer.push_back(part);
        }
        sphere = finer;
    }
    for (Triangle& of : sphere)
        for (Vector3d& x : of) x *= 0.4 / x.norm();
    agrees({0.3, 0.25, 0.25}, sphere);
}

TEST_CASE("3D: samples of the kernel, inside a cube's corner") {
    const WendlandC2<3> kernel(R);
    const KernelMass<3> mass{kernel};
    const Vector3d x(0.1, 0.2, 0.15);
    std::vector<Triangle> room = box({0, 0, 0}, {3, 3, 3});
    for (Triangle& of : room) std::swap(of[1], of[2]);
    const int n = 120;  // cells along the support's diameter
    const double h = 2 * R / n;
    double inside = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const Vector3d y((i + 0.5) * h - R, (j + 0.5) * h - R, (k + 0.5) * h - R);
                if (((x + y).array() > 0).all()) inside += kernel.value(y.norm()) * h * h * h;
            }
    CHECK(1 - by_panels(mass, x, room) == doctest::Approx(inside).epsilon(0.01));
}
