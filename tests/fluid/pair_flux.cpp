// The flux of one pair: what i gets, j loses, reconstruction included.
#include <doctest/doctest.h>

#include <cmath>

#include "physics/fluid/fluxes.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

template <int D, bool muscl>
void check_pairs(std::uint64_t seed) {
    CAPTURE(D);
    CAPTURE(muscl);
    Random random(seed);
    const double spacing = 0.1;
    const WendlandC2<D> kernel(4 * spacing);
    for (int k = 0; k < 300; ++k) {
        Point<D> a, b;
        for (auto* x : {&a, &b})
            for (double& component : *x) component = 1.3 * spacing * random();
        Particles<D> s = place<D>({a, b}, spacing);
        disorder(s, spacing, random);
        const FluxFields<D> fields(s);
        const PairState<D> i = fields.load(0), j = fields.load(1);
        double there[D], back[D];
        const RiemannPair<D, WendlandC2<D>, muscl, RiemannSolver::acoustic> pair{kernel, water};
        const PairFlux ij = pair(i, fields, 1, s.volume[1], there);
        const PairFlux ji = pair(j, fields, 0, s.volume[0], back);

        // Force on i by j: -ω_i 2 p_e ∇W_ij ω_j.
        for (std::size_t d = 0; d < D; ++d) {
            const double on_i = -s.volume[0] * ij.pressure * there[d], on_j = -s.volume[1] * ji.pressure * back[d];
            CHECK(std::fabs(on_i + on_j) <= 1e-14 * std::fabs(on_i));
        }
        // Both see the same interface velocity: v_e·(x_j - x_i) from either dilation.
        const double r = distance(s, 0, 1), slope = kernel.slope(r / kernel.radius());
        double U_i = 0, U_j = 0, magnitude = 0;
        for (std::size_t d = 0; d < D; ++d) {
            U_i += i.v[d] * there[d];
            U_j += j.v[d] * there[d];
            magnitude += (std::fabs(i.v[d]) + std::fabs(j.v[d])) * std::fabs(there[d]);
        }
        const double U_e_of_i = ij.dilation / (2 * slope * s.volume[1]) + U_i,
                     U_e_of_j = -ji.dilation / (2 * slope * s.volume[0]) + U_j;
        CHECK(std::fabs(U_e_of_i - U_e_of_j) <= 2e-14 * magnitude);

        // What j gets, from i's side: twice the rate of closing less what i gets.
        CHECK(std::fabs((2 * ij.closing - ij.dilation) * s.volume[0] - ji.dilation * s.volume[1]) <=
              2e-14 * magnitude * slope * s.volume[0] * s.volume[1]);

        // Hidden by a wall, or out of reach: nothing.
        const PairFlux hidden = pair(i, fields, 1, 0.0, there);
        CHECK(hidden.pressure == 0);
        CHECK(hidden.dilation == 0);
        const decltype(pair) narrow{WendlandC2<D>(r / 1.001), water};
        const PairFlux far = narrow(i, fields, 1, s.volume[1], there);
        CHECK(far.pressure == 0);
        CHECK(far.dilation == 0);
    }
}

}  // namespace

TEST_CASE("what i gets in a pair, j loses") {
    check_pairs<2, false>(1);
    check_pairs<2, true>(2);
    check_pairs<3, false>(3);
    check_pairs<3, true>(4);
}

TEST_CASE("a particle does nothing to itself") {
    Particles<2> s = place<2>({{0.3, 0.2}}, 0.1);
    Random random;
    disorder(s, 0.1, random);
    const FluxFields<2> fields(s);
    double dx[2];
    const RiemannPair<2, WendlandC2<2>, true, RiemannSolver::acoustic> pair{WendlandC2<2>(0.4), water};
    const PairFlux flux = pair(fields.load(0), fields, 0, 1.0, dx);
    CHECK(flux.pressure * dx[0] == 0);
    CHECK(flux.pressure * dx[1] == 0);
    CHECK(flux.dilation == 0);
}

TEST_CASE("minmod: the smaller slope of two that agree, none of two that do not") {
    const auto minmod = [](double a, double b) { return 0.5 * twice_minmod(2 * a, b); };
    CHECK(minmod(1, 2) == 1);
    CHECK(minmod(3, 2) == 2);
    CHECK(minmod(-1, -2) == -1);
    CHECK(minmod(-3, -2) == -2);
    CHECK(minmod(-1, 2) == 0);
    CHECK(minmod(1, -2) == 0);
    CHECK(minmod(0, 2) == 0);
}
