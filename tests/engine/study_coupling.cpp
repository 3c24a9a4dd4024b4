// Studies whose runs are compared with each other: axes, curves, speedup, verdicts.
#include <doctest/doctest.h>

#include <cmath>
#include <sstream>

#include "engine/study.hpp"
#include "engine/study_curves.hpp"
#include "tests/engine/scenes.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

const std::string axes = R"study(schema_version = 1
title = "Test of axes"
[[axis]]
name = "algorithm"
key = "coupling.algorithm"
values = ["cps", "css"]
[[axis]]
name = "p"
key = "coupling.ratio"
values = ["1", "3", "2"]
coarse = 2
[[axis]]
name = "alpha"
key = "solid.scheme.alpha"
values = ["-0.3"]
[[case]]
scene = "gate/scene.toml"
resolutions = [0.005]
variants = ["css_*", "cps_p1_*", "cps_p3_*"]
curve = "tip_x"
reference = "css_p1_alpham0_3"
speedup = "p"
)study";

struct Bench {
    ScratchFolder folder;
    std::filesystem::path file;
    explicit Bench(const std::string& text) {
        std::filesystem::create_directories(folder / "gate");
        folder.write("gate/scene.toml", gate);
        file = folder.write("tiny.study.toml", text);
    }
    std::string run(bool list) {
        engine::StudyOptions options;
        options.folder = folder / "runs";
        options.program = AQUAGRAPH_PROGRAM;
        options.threads = 1;
        options.coarse = true;
        options.list = list;
        std::ostringstream out, err;
        REQUIRE(engine::study(io::read_study(file), options, out, err) == engine::success);
        return out.str();
    }
};

std::vector<std::string> cells(const std::string& text, const std::string& row) {
    const std::size_t at = text.find("\n| " + row + " |");
    REQUIRE(at != std::string::npos);
    std::vector<std::string> found;
    std::istringstream line(text.substr(at + 3, text.find('\n', at + 1) - at - 3));
    for (std::string cell; std::getline(line, cell, '|');) {
        const std::size_t from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
        found.push_back(from == std::string::npos ? "" : cell.substr(from, to - from + 1));
    }
    return found;
}

}  // namespace

TEST_CASE("axes are multiplied, patterns choose among the products, coarse takes the first values") {
    Bench bench(axes);
    const io::Study study = io::read_study(bench.file);
    REQUIRE(study.variants.size() == 6);
    CHECK(study.variants[0].name == "cps_p1_alpham0_3");
    CHECK(study.variants[0].label == "cps, p = 1, alpha = -0.3");
    CHECK(study.variants[0].set ==
          std::vector<std::string>{"coupling.algorithm=cps", "coupling.ratio=1", "solid.scheme.alpha=-0.3"});
    CHECK(study.cases[0].variants == std::vector<std::string>{"css_p1_alpham0_3", "css_p3_alpham0_3",
                                                              "css_p2_alpham0_3", "cps_p1_alpham0_3",
                                                              "cps_p3_alpham0_3"});
    const std::string list = bench.run(true);
    CHECK(count(list, "coupling.ratio=") == 4);
    CHECK(list.find("coupling.ratio=2") == std::string::npos);

    const auto refused = [&](const std::string& from, const std::string& to, const std::string& why) {
        CAPTURE(to);
        Bench other(with(axes, from, to));
        CHECK_THROWS_WITH_AS(io::read_study(other.file), doctest::Contains(why.c_str()), io::SceneError);
    };
    refused("\"css_*\"", "\"cs_*\"", "there is no variant \"cs_*\"");
    refused("reference = \"css_p1_alpham0_3\"", "reference = \"cps_p2_alpham0_3\"", "the case has no variant");
    refused("speedup = \"p\"", "speedup = \"q\"", "there is no axis \"q\"");
    refused("curve = \"tip_x\"\n", "", "there is no `curve`");
    refused("values = [\"-0.3\"]", "values = []", "the axis has no values");
    refused("values = [\"-0.3\"]", "values = [\"-0.3\", \"-0.3\"]", "\"-0.3\" is named twice");
}

TEST_CASE("runs are compared with their reference, and times with the first value of the axis") {
    Bench bench(axes);
    const std::string text = bench.run(false);
    INFO(text);
    // variant, resolution, steps, t_FE, t_SPH, speedup, theory, shared, wall, difference, growth, roughness, verdict
    const auto reference = cells(text, "css, p = 1, alpha = -0.3"), three = cells(text, "css, p = 3, alpha = -0.3"),
               parallel = cells(text, "cps, p = 3, alpha = -0.3");
    REQUIRE(reference.size() >= 13);
    CHECK(reference[5] == "1");  // speedup over itself
    CHECK(reference[6] == "1");
    CHECK(reference[7] == "1");
    CHECK(reference[9] == "0 %");
    CHECK(reference[11] == "1");
    CHECK(reference[12] == "stable");
    const double t = std::stod(reference[3]) / std::stod(reference[4]), p = 3;
    CHECK(std::stod(three[6]) == Approx(p * (t + 1) / (t + p)).epsilon(0.01));
    CHECK(three[7] == three[6]);
    CHECK(std::stod(three[9]) > 0);
    CHECK(std::stod(three[9]) < 10);
    // Both CPS runs take 0.8 of the CFL step.
    const auto alone = cells(text, "cps, p = 1, alpha = -0.3");
    CHECK(alone[6] == "1");
    CHECK(alone[7] == "1");
    const double t_cps = std::stod(alone[3]) / std::stod(alone[4]);
    CHECK(std::stod(parallel[6]) == Approx(std::min(p, std::max(t_cps, 1.0))).epsilon(0.01));
    CHECK(three[12] == "stable");
    CHECK(count(text, "| as it is |") == 0);
}

TEST_CASE("what is said of curves is what they are") {
    engine::Curve line, swing, late;
    for (int k = 0; k <= 1000; ++k) {
        const double t = 1e-3 * k;
        line.time.push_back(t);
        line.value.push_back(3 * t);
        swing.time.push_back(t);
        swing.value.push_back(std::exp(2 * t) * std::sin(200 * t));
    }
    CHECK(engine::total_variation(line) == Approx(3));
    CHECK(engine::growth(line) == Approx(1));
    CHECK(engine::growth(swing) == Approx(std::exp(1.0)).epsilon(0.03));
    CHECK(engine::difference(line, line) == 0);
    late.time = {0, 0.5, 1};  // the same line with other rows
    late.value = {0, 1.5, 3};
    CHECK(engine::difference(late, line) < 1e-12);
    late.value = {0.3, 1.8, 3.3};
    CHECK(engine::difference(late, line) == Approx(0.1));
    late.time.back() = 0.9;  // ends too early
    CHECK(std::isnan(engine::difference(late, line)));
    CHECK(std::isnan(engine::total_variation({})));
    swing.value[500] = NAN;
    CHECK(std::isnan(engine::total_variation(swing)));
}

TEST_CASE("the theory of the speedup: (6.7) to (6.9)") {
    CHECK(engine::speedup_theory(false, 1, 5, 0.8) == 1);
    CHECK(engine::speedup_theory(false, 4, 2, 0.8) == Approx(4 * 3.0 / 6));
    CHECK(engine::speedup_theory(true, 4, 10, 0.8) == Approx(3.2));
    CHECK(engine::speedup_theory(true, 4, 2, 0.8) == Approx(1.6));
    CHECK(engine::speedup_theory(true, 4, 0.1, 0.8) == Approx(0.8));
    // With a processor for itself, or on threads without number, the solve takes none of the fluid's time.
    for (const double t : {0.1, 2.0, 10.0}) {
        CHECK(engine::speedup_on_threads(false, 4, t, 1, 2) == engine::speedup_theory(false, 4, t, 1));
        CHECK(engine::speedup_on_threads(true, 4, t, 0.8, 1000000) ==
              Approx(engine::speedup_theory(true, 4, t, 0.8)).epsilon(1e-4));
        CHECK(engine::speedup_on_threads(true, 1, t, 1, 2) == Approx(1));
    }
    // On one thread nothing runs beside anything else: CSS.
    CHECK(engine::speedup_on_threads(true, 4, 2, 1, 1) == Approx(engine::speedup_theory(false, 4, 2, 1)));
    CHECK(engine::speedup_on_threads(true, 4, 4, 1, 2) == Approx(4 * 4.0 / 6));
}
