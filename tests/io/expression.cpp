// Formulas of scene files: values against the same in C++, and what is refused.
#include "io/expression.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

using namespace aquagraph::io;

namespace {

std::string refused(const std::string& formula, const std::vector<std::string>& variables = {"x", "t"}) {
    try {
        Expression expression(formula, variables);
    } catch (const ExpressionError& error) {
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("a formula has the value that the same has in C++") {
    const Constants constants{{"U", 2.0}, {"L", 0.5}};
    const Expression wave("U * sin(2*pi*x/L) * exp(-t)", {"x", "t"}, constants);
    for (const double x : {0.0, 0.1, 0.4})
        for (const double t : {0.0, 1.5})
            CHECK(wave(std::array{x, t}) ==
                  doctest::Approx(2 * std::sin(2 * std::numbers::pi * x / 0.5) * std::exp(-t)).epsilon(1e-14));
    CHECK(Expression("x < 1 ? -x^2 : 3", {"x"})(std::array{0.5}) == -0.25);
    CHECK(Expression("x <= 1 && x != 0", {"x"})(std::array{1.0}) == 1.0);
    CHECK(wave.text() == "U * sin(2*pi*x/L) * exp(-t)");
}

TEST_CASE("a variable hides a constant of its name") {
    CHECK(Expression("x", {"x"}, {{"x", 5.0}})(std::array{2.0}) == 2.0);
}

TEST_CASE("a series is the sum of its terms, also inside another") {
    CHECK(constant_value("series(n, 1, 5, 1, n)", {}) == 15);
    CHECK(constant_value("series(n, 1, 5, 2, n^2)", {}) == 1 + 9 + 25);
    CHECK(constant_value("2*series(n, -1, 1, 1, n + 1)", {}) == 6);
    CHECK(constant_value("series(m, 1, 2, 1, series(n, 1, 3, 1, m*n))", {}) == 18);
    CHECK(constant_value("series(n, 1, 3, 1, max(n, 2))", {}) == 7);
    // A square wave: 4/π Σ sin(nx)/n over odd n.
    const Expression square("4/pi * series(n, 1, 999, 2, sin(n*x)/n)", {"x"});
    CHECK(square(std::array{1.0}) == doctest::Approx(1.0).epsilon(2e-3));
}

TEST_CASE("what is no formula is refused and says why") {
    CHECK(refused("x + t").empty());
    CHECK(refused("x + velocity").find("\"velocity\"") != std::string::npos);
    CHECK(refused("sin(x").size() > 0);
    CHECK(refused("").size() > 0);
    CHECK(refused("x +").find("ends too early") != std::string::npos);
    CHECK(refused("x, t").find("2 values") != std::string::npos);
    CHECK(refused("x = 3").find("==") != std::string::npos);
    CHECK(refused("x == 3").empty());
    CHECK(refused("sin(x, t)").size() > 0);
    CHECK(refused("series(n, 1, 5, n)").find("5 arguments") != std::string::npos);
    CHECK(refused("series(n, 1, 2.5, 1, n)").find("2.5") != std::string::npos);
    CHECK(refused("series(n, 5, 1, 1, n)").find("backwards") != std::string::npos);
    CHECK(refused("series(n, 1, 5, 0, n)").find("step") != std::string::npos);
    CHECK(refused("series(n, 1, 1000000000, 1, n)").find("fewer") != std::string::npos);
    CHECK(refused("series(n, 1, 5, 1, n").find("closed") != std::string::npos);
}

TEST_CASE("the name that nobody knows is handed on") {
    try {
        Expression expression("2*omega", {"x"});
        FAIL("accepted");
    } catch (const ExpressionError& error) {
        CHECK(error.unknown() == "omega");
    }
}

TEST_CASE("names of constants") {
    for (const char* good : {"U", "wave_number", "k2"}) CHECK(usable_as_constant(good));
    for (const char* bad : {"", "2k", "sin", "pi", "a b", "series", "_x"}) CHECK_FALSE(usable_as_constant(bad));
}
