// What the grid of panels says about lines of sight, against all panels asked one by one.
#include "physics/fluid/walls/panel_grid.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using aquagraph::fluid::test::Random;

namespace {

constexpr double reach = 0.2;

template <int D>
Vec<D> somewhere(Random& random) {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = random();
    return x;
}

// Panels that lie about at random, through each other.
template <int D>
Panels<D> jumble(std::size_t n, double size, Random& random) {
    Panels<D> panels;
    for (std::size_t k = 0; k < n; ++k) {
        std::vector<Vec<D>> points{somewhere<D>(random)};
        for (int v = 1; v < D; ++v) points.push_back(points[0] + size * somewhere<D>(random));
        const std::string name = "panel " + std::to_string(k);
        if constexpr (D == 2)
            panels.add_wall(name, points, false, false);
        else
            panels.add_wall(name, points, {{0, 1, 2}}, false);
    }
    panels.update_geometry();
    panels.find_joints();
    return panels;
}

// Where the segment from a to b meets panel k, 0 at a, 1 at b, or 2: a + t (b - a) = Σ weights × vertices, as a system
// of D equations.
template <int D>
double meets(const Panels<D>& panels, std::size_t k, const Vec<D>& a, const Vec<D>& b) {
    Mat<D> matrix;
    matrix.col(0) = a - b;
    for (int v = 1; v < D; ++v) matrix.col(v) = panels.vertex(k, std::size_t(v)) - panels.start(k);
    const Vec<D> solution = matrix.inverse() * (a - panels.start(k));
    const auto weights = solution.template tail<D - 1>();
    return solution[0] > 0 && solution[0] < 1 && weights.minCoeff() >= 0 && weights.sum() <= 1 ? solution[0] : 2;
}

// To the nearest of many points on panel k: not less than its distance, and by no more than `step` beyond it.
template <int D>
double sampled_distance(const Panels<D>& panels, std::size_t k, const Vec<D>& x, double* step) {
    constexpr int n = 40;
    double least = 1e300;
    const Vec<D> ab = panels.vertex(k, 1) - panels.start(k);
    const Vec<D> ac = D == 2 ? Vec<D>(Vec<D>::Zero()) : Vec<D>(panels.vertex(k, D - 1) - panels.start(k));
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= (D == 2 ? 0 : n - i); ++j)
            least = std::min(least, (x - panels.start(k) - (i * ab + j * ac) / n).norm());
    *step = (ab.norm() + ac.norm()) / n;
    return least;
}

template <int D>
void check_grid(std::size_t n, double size) {
    CAPTURE(D);
    Random random;
    const Panels<D> panels = jumble<D>(n, size, random);
    std::vector<int> patch(panels.size());
    for (std::size_t k = 0; k < patch.size(); ++k) patch[k] = int(k);
    Particles<D> particles;
    particles.resize(2, 0);
    for (std::size_t d = 0; d < D; ++d) {
        particles.x[d][0] = -0.5;
        particles.x[d][1] = 1.5;
    }
    PanelGrid<D> grid;
    grid.build(panels, patch, reach, Periodic<D>{}, particles);

    typename PanelGrid<D>::Cell near;
    int crossed = 0, crossed_beyond = 0, clear = 0;
    for (int pair = 0; pair < 15000; ++pair) {
        const Vec<D> a = 0.6 * somewhere<D>(random);
        Vec<D> along = somewhere<D>(random);
        along *= reach * std::fabs(random()) / along.norm();
        const Vec<D> b = a + along;
        int first = -1, second = -1;
        double at = 2, then = 2;
        for (std::size_t k = 0; k < panels.size(); ++k)
            if (const double t = meets(panels, k, a, b); t < at) {
                second = first;
                then = at;
                first = int(k);
                at = t;
            } else if (t < then) {
                second = int(k);
                then = t;
            }
        const auto* cell = grid.at(a);
        if (!cell) {
            CHECK(first == -1);
            continue;
        }
        if (cell->convex_room) continue;  // nobody asks there
        grid.gather(*cell, panels, a, near);
        for (const auto* asked : {cell, static_cast<decltype(cell)>(&near)}) {
            const auto crossing = PanelGrid<D>::first_crossing(*asked, a, b);
            CHECK((crossing.entry < 0 ? -1 : asked->panel[std::size_t(crossing.entry)]) == first);
            if (first < 0) continue;
            CHECK(crossing.along == doctest::Approx(at));
            const auto next = PanelGrid<D>::first_crossing(*asked, a, b, first);
            CHECK((next.entry < 0 ? -1 : asked->panel[std::size_t(next.entry)]) == second);
        }
        crossed += first >= 0;
        crossed_beyond += second >= 0;

        if (pair % 8 != 0) continue;
        const double clearance = grid.clearance(*cell, panels, a);
        double distance = reach, step = 0;
        for (std::size_t k = 0; k < panels.size(); ++k) {
            double own_step;
            distance = std::min(distance, sampled_distance(panels, k, a, &own_step));
            step = std::max(step, own_step);
        }
        CHECK(clearance <= distance + 1e-12);
        if (D == 2) CHECK(clearance >= distance - step);
        clear += clearance > along.norm();
    }
    CHECK(crossed > 400);
    CHECK(crossed_beyond > 40);
    CHECK(clear > 50);
}

}  // namespace

TEST_CASE("the first panel on a line of sight, and how far away panels are, as all of them asked one by one") {
    check_grid<2>(60, 0.15);
    check_grid<3>(300, 0.4);
}
