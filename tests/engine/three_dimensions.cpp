// Three-dimensional scenes: run to the end, leave the right files, are the same on any number of threads.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// Two blocks under pressure, one upon the other, that fly apart.
const std::string bursting_blocks = with(with(falling_block, "initial_pressure = \"zero\"\n", ""), "[output]",
                                         "[[fluid.box]]\nmin = [0.1, 0.1, 0.3]\nmax = [0.4, 0.3, 0.6]\n[output]");

std::string bits_of(const std::string& text, int threads) {
    const Finished run(text, threads);
    REQUIRE(run.code == engine::success);
    return contents(run.results.path / "history.csv") +
           numbers_of(run.results.open(run.results.frames("fluid").back()),
                      {"VTKHDF/Points", "VTKHDF/PointData/pressure", "VTKHDF/PointData/velocity",
                       "VTKHDF/PointData/density", "VTKHDF/PointData/id"});
}

}  // namespace

TEST_CASE("a block of water in space falls as it must") {
    const Finished run(falling_block);
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    const std::string csv = contents(run.results.path / "history.csv");
    CHECK(csv.substr(0, csv.find('\n')) ==
          "time[s],step_size[s],fluid_kinetic_energy[J],fluid_potential_energy[J],particles[-],fastest_particle[m/s]");
    const double mass = 60, v = 9.81 * 0.05;
    CHECK(history.column("fluid_kinetic_energy").back() == doctest::Approx(0.5 * mass * v * v).epsilon(1e-12));
    CHECK(history.column("fluid_potential_energy").back() ==
          doctest::Approx(mass * 9.81 * (0.15 - 0.5 * 9.81 * 0.05 * 0.05)).epsilon(1e-12));
    CHECK(history.column("fastest_particle").back() == doctest::Approx(v).epsilon(1e-12));

    const auto frames = run.results.frames("fluid");
    REQUIRE(frames.size() == 3);
    const std::size_t particles = 10 * 8 * 6;
    const io::Hdf5File first = run.results.open(frames.front()), last = run.results.open(frames.back());
    CHECK(last.type_name("VTKHDF/Points") == "float32");
    CHECK(last.shape("VTKHDF/Points") == std::vector<std::size_t>{particles, 3});
    CHECK(last.shape("VTKHDF/PointData/velocity") == std::vector<std::size_t>{particles, 3});
    const auto x0 = first.read<float>("VTKHDF/Points"), x = last.read<float>("VTKHDF/Points"),
               velocity = last.read<float>("VTKHDF/PointData/velocity");
    const auto id0 = first.read<std::int64_t>("VTKHDF/PointData/id"),
               id = last.read<std::int64_t>("VTKHDF/PointData/id");
    std::vector<std::size_t> start_of(particles);
    for (std::size_t i = 0; i < particles; ++i) start_of[std::size_t(id0[i])] = i;
    for (std::size_t i = 0; i < particles; ++i) {
        const std::size_t j = start_of[std::size_t(id[i])];
        REQUIRE(x[3 * i] == x0[3 * j]);
        REQUIRE(x[3 * i + 1] == x0[3 * j + 1]);
        REQUIRE(x[3 * i + 2] - x0[3 * j + 2] == doctest::Approx(-0.5 * 9.81 * 0.05 * 0.05).epsilon(1e-4));
        REQUIRE(velocity[3 * i + 2] == doctest::Approx(-v).epsilon(1e-6));
    }

    const nlohmann::json summary = run.results.summary();
    CHECK(summary.at("scene").at("dimension") == 3);
    CHECK(summary.at("scene").at("gravity") == nlohmann::json{0, 0, -9.81});
    CHECK(summary.at("particles") == particles);
}

TEST_CASE("the report plays a flow in space") {
    const Finished run(falling_block);
    const std::string page = run.results.report();
    const std::string opening = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = page.find(opening) + opening.size();
    const nlohmann::json flow =
        nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin)).at("flow");
    CHECK(flow.at("view").size() == 6);
    REQUIRE(flow.at("frames").size() == 3);
    // Three coordinates of two bytes each, in base64.
    CHECK(flow.at("frames")[0].at("at").get<std::string>().size() == 480 * 6 * 4 / 3);
    CHECK(page.find("<select id=\"side\"") != std::string::npos);
}

TEST_CASE("a scene in space has the same bits on 1, 2 and 4 threads") {
    const std::string reference = bits_of(bursting_blocks, 1);
    REQUIRE(reference.size() > 10000);
    for (const int threads : {1, 2, 4}) {
        CAPTURE(threads);
        CHECK(bits_of(bursting_blocks, threads) == reference);
    }
}

TEST_CASE("a particle that leaves a closed domain in space is described with three coordinates") {
    const Finished run(with(with(falling_block, "min = [-1, -1, -1]", "min = [-1, -1, 0]"), "[time]",
                            "gravity = [0, 0, -98.1]\n[time]"));
    CHECK(run.code == engine::run_failed);
    CHECK(run.err.str().find("a particle has left the closed domain") != std::string::npos);
    CHECK(run.err.str().find("x (0.") != std::string::npos);
}
