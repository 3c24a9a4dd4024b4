// What regulates a coupled run: p by the force, the step by its trend, ε by the energies, the iterations by what they
// teach.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "physics/coupling/cycle_step.hpp"
#include "physics/coupling/fixed_point.hpp"
#include "physics/coupling/interface_energy.hpp"
#include "physics/coupling/loads/energy_conservative.hpp"
#include "physics/coupling/ratio_control.hpp"

using namespace aquagraph::coupling;
using doctest::Approx;

namespace {

RatioControl control(int most, int p, double force) {
    RatioControl made{.regulated = true, .most = most, .p = p};
    made.begin({force, 0});
    return made;
}

}  // namespace

TEST_CASE("p follows the change of the force: (6.2)") {
    struct Case {
        double now;
        int p, expected;
    };
    // From a force of 100 with at most 8.
    for (const Case& c : {Case{107.4, 3, 4}, Case{107.4, 8, 8}, Case{92.6, 3, 4}, Case{107.6, 3, 2}, Case{114.9, 3, 2},
                          Case{107.6, 1, 1}, Case{115.1, 7, 1}, Case{84.9, 7, 1}, Case{-100, 7, 1}}) {
        CAPTURE(c.now);
        CAPTURE(c.p);
        RatioControl regulated = control(8, c.p, 100);
        regulated.update({c.now, 0});
        CHECK(regulated.p == c.expected);
    }
    // Directions count: a force that turns changes.
    RatioControl turning = control(8, 5, 100);
    turning.update({100 * std::cos(0.2), 100 * std::sin(0.2)});
    CHECK(turning.p == 1);
    RatioControl hardly = control(8, 5, 100);
    hardly.update({100 * std::cos(0.05), 100 * std::sin(0.05)});
    CHECK(hardly.p == 6);
}

TEST_CASE("p is guarded where there is no force to compare with") {
    RatioControl before_water = control(4, 1, 0);
    for (int k = 0; k < 10; ++k) before_water.update({0, 0});
    CHECK(before_water.p == 4);   // nothing changes: nothing to be careful about
    before_water.update({1, 0});  // the water arrives
    CHECK(before_water.p == 1);
    // Through zero: small changes on the scale of what has been stay small.
    RatioControl through = control(4, 1, 1000);
    for (const double f : {1000.0, 1000.0, 1000.0}) through.update({f, 0});
    REQUIRE(through.p == 4);
    through.update({0.1, 0});
    CHECK(through.p == 1);
    for (const double f : {-0.1, 0.2, -0.3, 0.1}) through.update({f, 0});
    CHECK(through.p == 4);
    through.update({std::nan(""), 0});
    CHECK(through.p == 1);
}

TEST_CASE("the fixed step is 0.8 of the limit, the predicted one follows it") {
    CycleStep fixed;
    CHECK(fixed.next(2.0, 4) == 1.6);
    CHECK(fixed.next(1.0, 4) == 0.8);
    for (const int p : {1, 2, 8, 20}) {
        CAPTURE(p);
        CycleStep steady{.rule = StepRule::predicted, .fraction = 1};
        for (int k = 0; k < 5; ++k) CHECK(steady.next(2.0, p) == 2.0);
        // A limit that falls by 0.1 % a step: no step is longer than what is allowed where it begins.
        CycleStep falling{.rule = StepRule::predicted, .fraction = 1};
        double limit = 1, taken = 0, allowed = 0;
        for (int cycle = 0; cycle < 40; ++cycle) {
            const double step = falling.next(limit, p);
            for (int k = 0; k < p; ++k, limit *= 0.999) {
                if (cycle > 1) CHECK(step <= limit * (1 + 1e-3));
                taken += step;
                allowed += limit;
            }
        }
        CHECK(taken > (p < 20 ? 0.97 : 0.93) * allowed);
        // One that rises is not run after: the present limit is the most.
        CycleStep rising{.rule = StepRule::predicted, .fraction = 1};
        rising.next(1.0, p);
        CHECK(rising.next(1.1, p) == 1.1);
    }
}

TEST_CASE("a limit that jumps about makes the predicted step careful, up to the margin of the fixed one") {
    CycleStep rule{.rule = StepRule::predicted, .fraction = 1};
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> uniform(0.9, 1.0);
    double least = 2;
    for (int k = 0; k < 200; ++k) {
        const double limit = uniform(generator), step = rule.next(limit, 8);
        CHECK(step <= limit);
        CHECK(step >= 0.8 * 0.8 * limit);
        least = std::min(least, step / limit);
    }
    CHECK(rule.margin > 0.02);
    CHECK(least < 0.97);
    for (int k = 0; k < 100; ++k) rule.next(1.0, 8);  // it is forgotten again
    CHECK(rule.next(1.0, 8) > 0.999);
}

TEST_CASE("the correction makes both energies run together, within its limit") {
    // The body gives what it is asked for times 1 + ε; the fluid gets `share` of what the uncorrected force gives.
    const auto run = [](double share, int cycles, double& epsilon) {
        EnergyCorrection correction;
        double to_fluid = 0, from_body = 0;
        for (int k = 0; k < cycles; ++k) {
            const double power = 3 + std::sin(0.02 * k), given = correction.factor() * power, gained = share * power;
            to_fluid += gained;
            from_body += given;
            correction.update(gained, given, to_fluid - from_body);
        }
        epsilon = correction.epsilon;
        return (to_fluid - from_body) / to_fluid;
    };
    double epsilon = 0;
    CHECK(std::fabs(run(1.0, 1000, epsilon)) < 1e-12);
    CHECK(std::fabs(epsilon) < 1e-12);
    CHECK(std::fabs(run(0.95, 1000, epsilon)) < 1e-4);
    CHECK(epsilon == Approx(-0.05).epsilon(0.05));
    CHECK(std::fabs(run(1.1, 1000, epsilon)) < 1e-4);
    CHECK(epsilon == Approx(0.1).epsilon(0.05));
    CHECK(run(1.4, 1000, epsilon) == Approx(0.25 / 1.4).epsilon(1e-3));  // out of reach
    CHECK(epsilon == 0.15);
    run(0.5, 1000, epsilon);
    CHECK(epsilon == -0.15);
}

TEST_CASE("the correction keeps still where energy goes to and fro") {
    EnergyCorrection correction;
    for (int k = 0; k < 2000; ++k) {
        const double given = std::cos(2.5 * k);
        correction.update(given, given, 0.5);  // a drift that no power can make good
        CHECK(std::fabs(correction.epsilon) <= 0.15);
    }
    CHECK(std::isfinite(correction.epsilon));
    EnergyCorrection quiet;
    for (int k = 0; k < 10; ++k) quiet.update(0, 0, 0);
    CHECK(quiet.epsilon == 0);
}

TEST_CASE("what the interface makes is what the fluid gets less what the body gives") {
    InterfaceEnergy energy;
    CHECK(energy.book(1.0) == -1.0);
    CHECK(energy.book(3.0) == -2.0);
    CHECK(energy.from_body == -3.0);
    energy.to_fluid = -2.5;
    CHECK(energy.of_interface() == 0.5);
}

namespace {

// A body in water: S(y) = b - A y, A being mass of the water over that of the body, in several modes: Λ between two
// reflections H = 1 - 2 v vᵀ.
struct AddedMass {
    std::vector<double> values, v, b;
    AddedMass(std::size_t n, double largest) : values(n), v(n), b(n) {
        std::mt19937 generator(3);
        std::normal_distribution<double> normal;
        double length2 = 0;
        for (std::size_t k = 0; k < n; ++k) {
            values[k] = largest / double(1 + k);
            v[k] = normal(generator);
            b[k] = normal(generator);
            length2 += v[k] * v[k];
        }
        for (double& x : v) x /= std::sqrt(length2);
    }
    std::vector<double> reflected(std::span<const double> x) const {
        double along = 0;
        for (std::size_t k = 0; k < v.size(); ++k) along += v[k] * x[k];
        std::vector<double> made(x.begin(), x.end());
        for (std::size_t k = 0; k < v.size(); ++k) made[k] -= 2 * along * v[k];
        return made;
    }
    // H f(Λ) H x
    template <class F>
    std::vector<double> apply(std::span<const double> x, F&& f) const {
        std::vector<double> made = reflected(x);
        for (std::size_t k = 0; k < v.size(); ++k) made[k] *= f(values[k]);
        return reflected(made);
    }
    std::vector<double> operator()(std::span<const double> y) const {
        std::vector<double> made = apply(y, [](double a) { return -a; });
        for (std::size_t k = 0; k < v.size(); ++k) made[k] += b[k];
        return made;
    }
    std::vector<double> solution() const {
        return apply(b, [](double a) { return 1 / (1 + a); });
    }
};

double norm_of_difference(std::span<const double> x, std::span<const double> y) {
    double sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += (x[k] - y[k]) * (x[k] - y[k]);
    return std::sqrt(sum);
}

// Iterations of `cycles` cycles whose b drifts; the error of the last one.
struct Outcome {
    int most = 0;
    int last = 0;
    double error = 0;
    long unconverged = 0;
};
Outcome iterate(Relaxation relaxation, double added_mass, int cycles) {
    AddedMass problem(12, added_mass);
    FixedPoint fixed_point;
    fixed_point.choices = {.relaxation = relaxation, .tolerance = 1e-6, .most = 60};
    std::vector<double> y(12, 0.0);
    Outcome outcome;
    for (int cycle = 0; cycle < cycles; ++cycle) {
        for (double& b : problem.b) b += 0.1;
        fixed_point.begin(y, y);
        do {
            y = problem(fixed_point.guess());
            fixed_point.update(y);
        } while (!fixed_point.finished());
        fixed_point.end();
        outcome.last = fixed_point.iterations();
        outcome.most = std::max(outcome.most, outcome.last);
    }
    const std::vector<double> right = problem.solution(), zero(12, 0.0);
    outcome.error = norm_of_difference(y, right) / norm_of_difference(right, zero);
    outcome.unconverged = fixed_point.unconverged;
    return outcome;
}

}  // namespace

TEST_CASE("iterations find the fixed point where plain ones run away") {
    // A staggered scheme multiplies its error by the added mass ratio each time.
    for (const double added_mass : {0.2, 5.0, 50.0})
        for (const Relaxation relaxation : {Relaxation::aitken, Relaxation::quasi_newton}) {
            CAPTURE(added_mass);
            CAPTURE(static_cast<int>(relaxation));
            const Outcome outcome = iterate(relaxation, added_mass, 6);
            INFO("iterations at most ", outcome.most, ", last ", outcome.last, ", error ", outcome.error);
            if (relaxation == Relaxation::aitken && added_mass > 10) continue;  // many modes: more than 60
            CHECK(outcome.unconverged == 0);
            CHECK(outcome.error < 1e-4);
            if (relaxation == Relaxation::quasi_newton) {
                CHECK(outcome.most <= 14);           // as many as there are modes, and two
                CHECK(outcome.last < outcome.most);  // with what earlier cycles have taught
            }
        }
}

TEST_CASE("iterations that do not converge are counted") {
    FixedPoint fixed_point;
    fixed_point.choices.most = 3;
    const std::vector<double> start{0};
    fixed_point.begin(start, start);
    for (const double computed : {1.0, -7.0, 1e3}) {
        CHECK_FALSE(fixed_point.finished());
        fixed_point.update(std::vector<double>{computed});
    }
    CHECK(fixed_point.finished());
    CHECK_FALSE(fixed_point.converged());
    fixed_point.end();
    CHECK(fixed_point.unconverged == 1);
    CHECK(fixed_point.total_iterations == 3);
}

TEST_CASE("a guess that cannot be computed goes half the way back to the last one that could") {
    for (const Relaxation relaxation : {Relaxation::aitken, Relaxation::quasi_newton}) {
        CAPTURE(static_cast<int>(relaxation));
        FixedPoint fixed_point;
        fixed_point.choices = {.relaxation = relaxation, .tolerance = 1e-9, .most = 30};
        const std::vector<double> start{1, 2}, guess{5, -6};
        fixed_point.begin(start, guess);
        REQUIRE(fixed_point.retreat());  // nothing has been computed: towards the start
        CHECK(fixed_point.guess()[0] == 3);
        CHECK(fixed_point.guess()[1] == -2);
        REQUIRE(fixed_point.retreat());
        CHECK(fixed_point.guess()[0] == 2);
        CHECK(fixed_point.retreats() == 2);
        const std::vector<double> sound(fixed_point.guess().begin(), fixed_point.guess().end());
        fixed_point.update(std::vector<double>{12, 7});
        CHECK(fixed_point.retreats() == 0);
        const std::vector<double> next(fixed_point.guess().begin(), fixed_point.guess().end());
        int times = 0;
        while (fixed_point.retreat()) ++times;
        CHECK(times == 8);
        for (std::size_t k = 0; k < 2; ++k) {
            CHECK(next[k] != sound[k]);
            CHECK(fixed_point.guess()[k] - sound[k] == Approx((next[k] - sound[k]) / 256));
        }
        CHECK(fixed_point.failed_trials == 11);
        CHECK(fixed_point.iterations() == 1);
    }
}

TEST_CASE("iterations find a fixed point whose neighbourhood alone can be computed") {
    // S exists within 2 of the solution only, and its steps overshoot that by far.
    for (const Relaxation relaxation : {Relaxation::aitken, Relaxation::quasi_newton}) {
        CAPTURE(static_cast<int>(relaxation));
        AddedMass problem(12, 50.0);
        for (double& b : problem.b) b = 3;
        const std::vector<double> right = problem.solution();
        FixedPoint fixed_point;
        fixed_point.choices = {.relaxation = relaxation, .tolerance = 1e-6, .most = 400};
        std::vector<double> start = right, guess = right;
        start[0] += 1;
        guess[0] += 30;
        fixed_point.begin(start, guess);
        do {
            if (norm_of_difference(fixed_point.guess(), right) > 2)
                REQUIRE(fixed_point.retreat());
            else
                fixed_point.update(problem(fixed_point.guess()));
        } while (!fixed_point.finished());
        CHECK(fixed_point.failed_trials > 0);
        CHECK(fixed_point.converged());
        CHECK(norm_of_difference(fixed_point.guess(), right) < 1e-4);
    }
}
