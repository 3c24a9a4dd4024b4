// Trials of an iterated cycle that fail: what is tried again, from where, and when it is given up.
#include "engine/trials.hpp"

#include <doctest/doctest.h>

#include "physics/solid/structure.hpp"
#include "tasks/stepping.hpp"
#include "tasks/task_error.hpp"
#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

template <class Error>
[[noreturn]] void fail(const Error& error) {
    try {
        throw error;
    } catch (const std::exception&) {
        throw tasks::TaskError("a task of the test", "it was told to fail");
    }
}
const tasks::SickParticle sick({}, "a particle's state is not a number");

// The gate, iterated with p = 3.
struct Iterated : Built {
    engine::CycleListing cycle;

    explicit Iterated(const std::string& more)
        : Built(with(with_coupling(gate, "iterated", 3), "sound_speed = 30.0", "sound_speed = 30.0" + more)),
          cycle(engine::coupling_cycle(*model, scene.coupling, 3)) {
        start();
    }
    void run_all(const std::vector<tasks::Task>& listing) {
        for (const tasks::Task& task : listing) executor.execute([&] { task.body(); });
    }
    void trials(const std::function<void()>& trial) { engine::run_trials(*model->interface, model->clock, trial); }
    void whole_cycle() {
        run_all(cycle.begin);
        trials([&] { run_all(cycle.steps); });
        run_all(cycle.end);
    }
    std::vector<double> state() const {
        const auto& s = model->fluid->particles;
        std::vector<double> all;
        for (const auto* field : {&s.x[0], &s.x[1], &s.v[0], &s.v[1], &s.deviation, &s.p})
            all.insert(all.end(), field->begin(), field->begin() + long(s.count));
        for (const auto values : {model->solid->positions(), model->solid->velocities()})
            all.insert(all.end(), values.begin(), values.end());
        return all;
    }
};

}  // namespace

TEST_CASE("after a trial that fails anywhere a cycle ends in the bits of one that began with half the guess") {
    std::string more;
    SUBCASE("between ghosts") {}
    SUBCASE("between walls of normal fluxes") {
        more = "\nwalls = \"normal_flux\"";
    }
    const std::size_t tasks = Iterated(more).cycle.steps.size();
    for (const std::size_t last : {std::size_t(1), tasks / 2, tasks - 2}) {  // that is still run
        CAPTURE(last);
        Iterated failing(more), halved(more);
        for (int cycle = 0; cycle < 2; ++cycle)
            for (Iterated* run : {&failing, &halved}) run->whole_cycle();
        REQUIRE(failing.state() == halved.state());
        const long rebuilds = failing.model->fluid->rebuilds;

        failing.run_all(failing.cycle.begin);
        bool failed = false;
        failing.trials([&] {
            for (std::size_t k = 0; k < failing.cycle.steps.size(); ++k) {
                failing.executor.execute([&] { failing.cycle.steps[k].body(); });
                if (k == last && !std::exchange(failed, true)) fail(sick);
            }
        });
        coupling::Interface& interface = *halved.model->interface;
        halved.run_all(halved.cycle.begin);
        const std::vector<double> whole(interface.fixed_point.guess().begin(), interface.fixed_point.guess().end());
        REQUIRE(interface.fixed_point.retreat());
        interface.surface.head_for(interface.fixed_point.guess(), halved.model->clock.cycle);
        halved.trials([&] { halved.run_all(halved.cycle.steps); });

        REQUIRE(failing.model->fluid->rebuilds == rebuilds);  // else the order of the particles has changed
        CHECK(failing.model->interface->fixed_point.failed_trials == 1);
        CHECK(failing.model->interface->fixed_point.iterations() == interface.fixed_point.iterations());
        CHECK(failing.model->clock.steps == 9);
        CHECK(failing.state() == halved.state());
        for (Iterated* run : {&failing, &halved}) {
            run->run_all(run->cycle.end);
            run->whole_cycle();
        }
        CHECK(failing.state() == halved.state());
    }
}

TEST_CASE("trials that fail again and again are given up, and what is no matter of the guess at once") {
    Iterated built("");
    built.run_all(built.cycle.begin);
    int tried = 0;
    CHECK_THROWS_AS(built.trials([&] {
        ++tried;
        fail(solid::ConvergenceError("Newton"));
    }),
                    tasks::TaskError);
    CHECK(tried == 9);
    CHECK(built.model->interface->fixed_point.retreats() == 8);
    tried = 0;
    built.run_all(built.cycle.begin);
    CHECK_THROWS_AS(built.trials([&] {
        ++tried;
        fail(std::runtime_error("a full disk"));
    }),
                    tasks::TaskError);
    CHECK(tried == 1);
}
