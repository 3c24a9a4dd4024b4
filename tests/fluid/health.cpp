// Ailments are found, particles outside are removed in order, energies are sums.
#include "physics/fluid/health.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
const Domain<2> domain{{0, 0}, {1, 1}};

Particles<2> healthy() {
    Random random;
    return place<2>(lattice<2>({20, 10}, 0.05, 0, random), 0.05);
}

void check(const Particles<2>& s, Ailment ailment, std::size_t particle, bool closed = true) {
    Diagnosis first;
    for (std::size_t block = 0; block < s.blocks() && first.ailment == Ailment::none; ++block)
        first = examine(s, 1000, domain, closed, lanes_of_block(s, block));
    CHECK(first.ailment == ailment);
    CHECK(first.particle == particle);
}

}  // namespace

TEST_CASE("every ailment is found, and where") {
    check(healthy(), Ailment::none, 0);
    for (const double bad : {not_a_number, infinity, -infinity}) {
        for (const std::size_t sick : {std::size_t(0), std::size_t(131), std::size_t(199)}) {
            for (int field = 0; field < 6; ++field) {
                CAPTURE(field);
                Particles<2> s = healthy();
                Scalars* fields[] = {&s.x[0], &s.x[1], &s.v[0], &s.v[1], &s.deviation, &s.p};
                (*fields[field])[sick] = bad;
                check(s, Ailment::not_finite, sick);
                check(s, Ailment::not_finite, sick, false);
            }
        }
    }
    Particles<2> s = healthy();
    s.deviation[77] = -899;
    check(s, Ailment::none, 0);
    s.deviation[77] = -901;
    check(s, Ailment::no_volume, 77);
    s = healthy();
    for (const double y : {-1e-9, 1.0000001, 55.0}) {
        s.x[1][150] = y;
        check(s, Ailment::left_domain, 150);
        check(s, Ailment::none, 0, false);
    }
    s.x[1][150] = 1;  // the edge belongs to the domain
    check(s, Ailment::none, 0);
}

TEST_CASE("particles outside are removed, the others keep their order and all they carry") {
    Particles<2> s = healthy();
    Random random;
    disorder(s, 0.05, random);
    CHECK(remove_outside(s, domain) == 0);
    CHECK(s.count == 200);
    const Particles<2> before = s;
    for (const std::size_t out : {0, 3, 4, 100, 199}) s.x[out % 2][out] = out % 3 == 0 ? -0.1 : 7;
    s.x[0][50] = not_a_number;
    CHECK(remove_outside(s, domain) == 6);
    REQUIRE(s.count == 194);
    std::int64_t last = -1;
    for (std::size_t i = 0; i < s.count; ++i) {
        CHECK(s.id[i] > last);
        last = s.id[i];
        const auto was = static_cast<std::size_t>(s.id[i]);
        for (std::size_t d = 0; d < 2; ++d) {
            CHECK(s.x[d][i] == before.x[d][was]);
            CHECK(s.v[d][i] == before.v[d][was]);
            CHECK(s.x_built[d][i] == before.x_built[d][was]);
        }
        CHECK(s.mass[i] == before.mass[was]);
        CHECK(s.deviation[i] == before.deviation[was]);
        CHECK(s.volume[i] == before.volume[was]);
        CHECK(s.p[i] == before.p[was]);
    }
    for (const std::size_t gone : {0, 3, 4, 50, 100, 199})
        for (std::size_t i = 0; i < s.count; ++i) CHECK(s.id[i] != static_cast<std::int64_t>(gone));
    for (std::size_t i = s.count; i < s.size(); ++i) CHECK(s.volume[i] == 0);
    // All of them.
    const Domain<2> elsewhere{{5, 5}, {6, 6}};
    CHECK(remove_outside(s, elsewhere) == 194);
    CHECK(s.count == 0);
    CHECK(s.blocks() == 0);
}

TEST_CASE("energies are those of the sums") {
    Random random;
    Particles<3> s = place<3>(lattice<3>({7, 6, 5}, 0.1, 0.2, random), 0.1);
    disorder(s, 0.1, random);
    const double gravity[3] = {1, -2, -9.81};
    FluidEnergies whole;
    for (std::size_t block = 0; block < s.blocks(); ++block) {
        const FluidEnergies part = energies(s, gravity, lanes_of_block(s, block));
        whole.kinetic += part.kinetic;
        whole.potential += part.potential;
    }
    long double kinetic = 0, potential = 0;
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t d = 0; d < 3; ++d) {
            kinetic += 0.5L * s.mass[i] * s.v[d][i] * s.v[d][i];
            potential -= static_cast<long double>(s.mass[i]) * gravity[d] * s.x[d][i];
        }
    CHECK(whole.kinetic == doctest::Approx(static_cast<double>(kinetic)).epsilon(1e-13));
    CHECK(whole.potential == doctest::Approx(static_cast<double>(potential)).epsilon(1e-13));
}
