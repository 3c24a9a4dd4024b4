#include "physics/fluid/walls/wall_points.hpp"

#include <cmath>
#include <numbers>

namespace aquagraph::fluid {

namespace {

std::array<double, 2> mean(const std::array<std::array<double, 2>, 2>& v) {
    return {0.5 * (v[0][0] + v[1][0]), 0.5 * (v[0][1] + v[1][1])};
}
std::array<double, 3> mean(const std::array<std::array<double, 3>, 3>& v) {
    std::array<double, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) c[k] = (v[0][k] + v[1][k] + v[2][k]) / 3;
    return c;
}

}  // namespace

template <int D>
void WallPoints<D>::cut(const Panels<D>& panels, double spacing) {
    cell.clear();
    share_.clear();
    for (std::size_t k = 0; k < panels.size(); ++k) {
        double longest = 0;
        for (std::size_t a = 0; a < D; ++a)
            longest = std::max(longest, (panels.vertex(k, (a + 1) % D) - panels.vertex(k, a)).norm());
        // Centres of right-angled triangles with two sides of one spacing are closer than that to each other.
        const double widest = D == 2 ? spacing : std::numbers::sqrt2 * spacing;
        const int n = std::max(1, int(std::ceil(longest / widest * (1 - 1e-9))));
        const double h = 1.0 / n;
        const auto add = [&](const std::array<std::array<double, D>, D>& vertex) {
            cell.push_back({std::int32_t(k), vertex, mean(vertex)});
            share_.push_back(D == 2 ? h : h * h);
        };
        if constexpr (D == 2) {
            for (int i = 0; i < n; ++i) add({{{1 - i * h, i * h}, {1 - (i + 1) * h, (i + 1) * h}}});
        } else {
            const auto at = [&](int i, int j) { return std::array<double, 3>{1 - (i + j) * h, i * h, j * h}; };
            for (int i = 0; i < n; ++i)
                for (int j = 0; i + j < n; ++j) {
                    add({at(i, j), at(i + 1, j), at(i, j + 1)});
                    if (i + j + 1 < n) add({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
                }
        }
    }
    const std::size_t entries = cell.size() + 1;
    area.resize(entries);
    area.back() = 0;
    for (std::size_t d = 0; d < D; ++d)
        for (Scalars* values : {&x[d], &normal[d], &velocity[d]}) {
            values->resize(entries);
            values->back() = values == &x[d] ? 1e9 : 0.0;
        }
    update(panels);
}

template <int D>
void WallPoints<D>::update(const Panels<D>& panels) {
    for (std::size_t s = 0; s < size(); ++s) {
        const std::size_t k = std::size_t(cell[s].panel);
        Vec<D> place = Vec<D>::Zero(), v = Vec<D>::Zero();
        for (std::size_t a = 0; a < D; ++a) {
            place += cell[s].centre[a] * panels.vertex(k, a);
            v += cell[s].centre[a] * panels.velocity[std::size_t(panels.panels[k].vertex[a])];
        }
        for (int d = 0; d < D; ++d) {
            x[std::size_t(d)][s] = place[d];
            normal[std::size_t(d)][s] = -panels.normal[k][d];
            velocity[std::size_t(d)][s] = v[d];
        }
        area[s] = share_[s] * panels.measure[k];
    }
}

template <int D>
Vec<D> WallPoints<D>::place(std::size_t point) const {
    Vec<D> at;
    for (int d = 0; d < D; ++d) at[d] = x[std::size_t(d)][point];
    return at;
}

template <int D>
Vec<D> WallPoints<D>::outward(std::size_t point) const {
    Vec<D> n;
    for (int d = 0; d < D; ++d) n[d] = normal[std::size_t(d)][point];
    return n;
}

template <int D>
Vec<D> WallPoints<D>::vertex(const Panels<D>& panels, std::size_t number, std::size_t k) const {
    Vec<D> at = Vec<D>::Zero();
    for (std::size_t a = 0; a < D; ++a)
        at += cell[number].vertex[k][a] * panels.vertex(std::size_t(cell[number].panel), a);
    return at;
}

template struct WallPoints<2>;
template struct WallPoints<3>;

}  // namespace aquagraph::fluid
