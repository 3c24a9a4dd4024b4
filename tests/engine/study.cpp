// Studies: the matrix, what is kept, what fails, tables, plots and markers, with the program as the child.
#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <sstream>

#include "engine/study.hpp"
#include "engine/study_plots.hpp"
#include "engine/study_report.hpp"
#include "engine/study_speedup.hpp"
#include "io/atomic_file.hpp"
#include "tests/engine/body_scenes.hpp"
#include "tests/engine/scenes.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// Flies freely and is over after a few steps.
const std::string patch = R"scene(schema_version = 1
title = "Patch"
gravity = [0, 0]
[time]
end = 0.01
[domain]
min = [-2, -2]
max = [3, 3]
[fluid]
spacing = 0.1
sound_speed = 10
[fluid.initial]
velocity = ["0.2", "0"]
[[fluid.box]]
min = [0, 0]
max = [1, 1]
[[integral]]
name = "discrete"
value = "x^2"
[[compare]]
column = "discrete"
formula = "1/3"
label = "integral of x squared"
window = [0, 1e-9]
[[compare]]
column = "fluid_kinetic_energy"
formula = "20"
label = "energy"
)scene";

const std::string matrix = R"scene(schema_version = 1
title = "Test of studies"
[[variant]]
name = "muscl"
label = "MUSCL"
[[variant]]
name = "first"
set = ["fluid.scheme.reconstruction=none"]
[[case]]
scene = "patch/scene.toml"
resolutions = [0.2, 0.1]
)scene";

struct Bench {
    ScratchFolder folder;
    std::filesystem::path file;

    explicit Bench(const std::string& text = matrix, const std::string& scene = patch) {
        std::filesystem::create_directories(folder / "patch");
        folder.write("patch/scene.toml", scene);
        file = folder.write("tiny.study.toml", text);
    }
    engine::StudyOptions options() const {
        engine::StudyOptions made;
        made.folder = folder / "runs";
        made.program = AQUAGRAPH_PROGRAM;
        made.threads = 1;
        return made;
    }
    std::string said;
    engine::ExitCode run(const engine::StudyOptions& options, std::string* printed = nullptr) {
        std::ostringstream out, err;
        const auto code = engine::study(io::read_study(file), options, out, err);
        said = err.str();
        if (printed) *printed = out.str();
        return code;
    }
    std::string results() const { return contents(folder / "RESULTS.md"); }
};

std::size_t lines_with(const std::string& text, const std::string& what) {
    std::istringstream lines(text);
    std::size_t found = 0;
    for (std::string line; std::getline(lines, line);) found += line.find(what) != std::string::npos;
    return found;
}

std::string refused(const std::string& study) {
    const Bench bench(study);
    return refusal_by([&] { io::read_study(bench.file); });
}

}  // namespace

TEST_CASE("a study writes a table with the errors, their order and the time of every run") {
    Bench bench;
    REQUIRE(bench.run(bench.options()) == engine::success);
    const std::string text = bench.results();
    CHECK(text.find("<!-- begin study tiny -->") != std::string::npos);
    CHECK(text.find("<!-- end study tiny -->") != std::string::npos);
    CHECK(text.find("## Test of studies") != std::string::npos);
    CHECK(lines_with(text, "| MUSCL |") == 2);
    CHECK(lines_with(text, "| first |") == 2);
    // The midpoint rule misses 1/3 by h²/12: 1 % and 0.25 %, order 2.
    CHECK(lines_with(text, "| 25 | 1 % |  |") == 2);
    CHECK(lines_with(text, "| 100 | 0.25 % | 2.0 |") == 2);
    if (std::system("gnuplot --version > /dev/null 2>&1") == 0) {
        CHECK(text.find("](plots/tiny_patch.svg)") != std::string::npos);
        CHECK(contents(bench.folder / "plots/tiny_patch.svg").find("MUSCL") != std::string::npos);
    }
}

TEST_CASE("a comparison with nothing to compare says so") {
    Bench bench(matrix, with(patch, "label = \"energy\"", "label = \"energy\"\nwindow = [5, 6]"));
    std::string printed;
    REQUIRE(bench.run(bench.options(), &printed) == engine::success);
    const std::string text = bench.results();
    CHECK(lines_with(text, "| outside the run |") == 4);
    CHECK(text.find("nan") == std::string::npos);
    CHECK((printed + bench.said).find("energy: outside the run") != std::string::npos);
    CHECK((printed + bench.said).find("nan") == std::string::npos);
}

TEST_CASE("no two of many variants are drawn alike") {
    std::set<std::string> styles, colours;
    for (std::size_t k = 0; k < 36; ++k) styles.insert(engine::line_style(k));
    for (std::size_t k = 0; k < 12; ++k) colours.insert(engine::line_style(k).substr(0, 24));
    CHECK(styles.size() == 36);
    CHECK(colours.size() == 12);
}

TEST_CASE("a logarithmic axis has labels where it is drawn") {
    using Values = std::vector<double>;
    const auto near = [](const Values& found, const Values& wanted) {
        REQUIRE(found.size() == wanted.size());
        for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k] == doctest::Approx(wanted[k]));
    };
    near(engine::logarithmic_tics(0.3, 30), {0.5, 1, 2, 5, 10, 20});
    near(engine::logarithmic_tics(7.7, 14.5), {8, 10, 12});
    near(engine::logarithmic_tics(25, 45), {25, 30, 35, 40});
    near(engine::logarithmic_tics(0.0118, 0.0132), {0.012, 0.013});
}

TEST_CASE("names in a plot leave out what all of them say") {
    using Labels = std::vector<std::string>;
    CHECK(engine::telling_labels({"css, p = 1, fixed", "css, p = 2, fixed"}) == Labels{"p = 1", "p = 2"});
    CHECK(engine::telling_labels({"css, p = 1", "cps, p = 2"}) == Labels{"css, p = 1", "cps, p = 2"});
    CHECK(engine::telling_labels({"Riemann, RK3", "Riemann"}) == Labels{"Riemann, RK3", "Riemann"});
    CHECK(engine::telling_labels({"same", "same"}) == Labels{"same", "same"});
    CHECK(engine::telling_labels({"css, p = 1"}) == Labels{"css, p = 1"});
    CHECK(engine::telling_labels({}) == Labels{});
}

TEST_CASE("a plot keeps its size with many variants: their names stand below it") {
    if (std::system("gnuplot --version > /dev/null 2>&1") != 0) {
        MESSAGE("gnuplot is not there");
        return;
    }
    ScratchFolder scratch;
    const std::filesystem::path folder = scratch / "it's a folder";
    const auto drawn = [&](std::size_t variants, bool coarse) {
        io::Study study;
        study.name = "many";
        study.cases.resize(1);
        study.cases[0].name = "gate";
        std::vector<engine::StudyResult> results;
        for (std::size_t v = 0; v < variants; ++v) {
            study.variants.push_back({"v" + std::to_string(v), "cps, p = " + std::to_string(v), {}, "", {}, true});
            study.cases[0].variants.push_back(study.variants[v].name);
            engine::StudyResult& result = results.emplace_back();
            result.run.variant = v;
            result.repeats.resize(1);
            result.repeats[0].wall_seconds = 2 + double(v);
            result.repeats[0].errors = {{"force", "force", 0.1 / double(v + 1)}};
        }
        const auto files = engine::draw_plots(study, results, folder, coarse);
        REQUIRE(files.size() == 1);
        CHECK(files[0].filename() == (coarse ? "many_gate-coarse.svg" : "many_gate.svg"));
        CHECK(std::filesystem::exists(folder / "many_gate.gnuplot") == false);
        return contents(files[0]);
    };
    const auto height = [](const std::string& svg) { return std::stoi(svg.substr(svg.find("height=\"") + 8)); };
    const std::string one = drawn(1, true), many = drawn(18, false);
    for (int v = 0; v < 18; ++v) CHECK(many.find(">p = " + std::to_string(v)) != std::string::npos);
    CHECK(one.find("p = 0") == std::string::npos);  // nothing to tell apart
    CHECK(height(many) > height(one) + 50);
}

TEST_CASE("a plot of speedups has a line and its theory for every choice of the other axes") {
    if (std::system("gnuplot --version > /dev/null 2>&1") != 0) {
        MESSAGE("gnuplot is not there");
        return;
    }
    ScratchFolder scratch;
    io::Study study;
    study.name = "speed";
    study.axes = {{"p", "coupling.ratio", {"1", "4"}, 0}, {"algorithm", "coupling.algorithm", {"cps", "css"}, 0}};
    study.cases.resize(2);
    std::vector<engine::StudyResult> results;
    for (const std::size_t c : {0u, 1u}) {
        study.cases[c].name = c == 0 ? "gate" : "tank";
        study.cases[c].resolutions = {0.01};
    }
    study.cases[0].speedup = "p";  // of the other one nobody asks for it
    for (const int algorithm : {0, 1})
        for (const int p : {0, 1}) {
            const std::string& value = study.axes[0].values[std::size_t(p)];
            const std::string name = study.axes[1].values[std::size_t(algorithm)] + "_p" + value;
            study.variants.push_back(
                {name, (algorithm == 0 ? "cps, p = " : "css, p = ") + value, {}, "", {p, algorithm}, true});
            for (const std::size_t c : {0u, 1u}) {
                study.cases[c].variants.push_back(name);
                engine::StudyResult& result = results.emplace_back();
                result.run.study_case = c;
                result.run.variant = study.variants.size() - 1;
                result.run.resolution = 0.01;
                result.run.parallel = algorithm == 0;
                result.run.ratio = std::atoi(value.c_str());
                // A solve of 3 s beside fluid steps of 2 s of two threads: t_FE/t_SPH = 3.
                result.repeats.resize(1);
                result.repeats[0].wall_seconds = p == 0 ? 8 : 4;
                result.repeats[0].solves = result.repeats[0].steps = 10;
                result.repeats[0].solve_seconds = 30;
                result.repeats[0].other_seconds = 20;
            }
        }
    const engine::Speedup of = engine::speedup_of(study, results, results[6], 2);  // CSS, p = 4
    CHECK(of.solve == 3);
    CHECK(of.fluid_step == 1);
    CHECK(of.measured == 2);
    CHECK(of.theory == doctest::Approx(4 * (1 + 3.0) / (4 + 3)));  // (6.9)
    const auto files = engine::draw_speedups(study, results, scratch / "plots", 2, false);
    REQUIRE(files.size() == 2);
    CHECK(files[0].filename() == "speed_gate_speedup.svg");
    CHECK(files[1].empty());
    const std::string svg = contents(files[0]);
    CHECK(svg.find(">cps, 0.01<") != std::string::npos);
    CHECK(svg.find(">css, 0.01<") != std::string::npos);
}

TEST_CASE("finished runs are kept until the scene or the study wants something else") {
    Bench bench;
    bench.run(bench.options());
    CHECK(lines_with(bench.said, "(kept)") == 0);
    bench.run(bench.options());
    CHECK(lines_with(bench.said, "(kept)") == 4);
    auto fresh = bench.options();
    fresh.fresh = true;
    bench.run(fresh);
    CHECK(lines_with(bench.said, "(kept)") == 0);
    auto twice = bench.options();
    twice.repeats = 2;
    bench.run(twice);
    CHECK(lines_with(bench.said, "(kept)") == 4);
    CHECK(bench.results().find("medians of 2 runs") != std::string::npos);
    bench.folder.write("patch/scene.toml", with(patch, "0.2", "0.3"));
    bench.run(bench.options());
    CHECK(lines_with(bench.said, "(kept)") == 0);
}

TEST_CASE("other sections of the file survive") {
    Bench bench;
    const std::string before = "# Results\n\nbefore\n\n<!-- begin study other -->\nx\n<!-- end study other -->\n";
    bench.folder.write("RESULTS.md", before);
    bench.run(bench.options());
    bench.run(bench.options());
    const std::string text = bench.results();
    CHECK(text.starts_with(before));
    CHECK(lines_with(text, "begin study tiny") == 1);
    bench.folder.write("RESULTS.md", "<!-- begin study tiny -->\nhalf\n");
    CHECK_THROWS_WITH_AS(bench.run(bench.options()), doctest::Contains("end study tiny"), std::runtime_error);
}

TEST_CASE("the table of a case goes into the README beside its scene, once the whole study has run") {
    Bench bench(with(matrix, "title = \"Test of studies\"", "title = \"Test of studies\"\nreadme = [\"m*\"]"));
    const std::string before =
                          "# Patch\n\nprose\n\n<!-- begin study tiny/patch -->\nold\n<!-- end study tiny/patch -->",
                      after = "\n\nmore prose\n";
    const auto readme = [&] { return contents(bench.folder / "patch/README.md"); };
    bench.folder.write("patch/README.md", before + after);
    for (const auto& [part, elsewhere] : {std::pair{true, false}, {false, true}}) {
        auto options = bench.options();
        options.coarse = part;
        options.out = bench.folder / (elsewhere ? "other.md" : "RESULTS.md");
        REQUIRE(bench.run(options) == engine::success);
        CHECK(readme() == before + after);
    }
    REQUIRE(bench.run(bench.options()) == engine::success);
    const std::string text = readme();
    CHECK(text.starts_with("# Patch\n\nprose\n"));
    CHECK(text.ends_with(after));
    CHECK(text.find("old") == std::string::npos);
    CHECK(lines_with(text, "| MUSCL |") == 2);
    CHECK(lines_with(text, "| first |") == 0);
    CHECK(text.find("all variants and a plot in [RESULTS.md](../RESULTS.md)") != std::string::npos);
    // The same rows, and the coarse section beside the whole one.
    const std::string results = bench.results();
    const std::string row = text.substr(text.find("| MUSCL |"), text.find('\n', text.find("| MUSCL |")));
    CHECK(results.find(row.substr(0, row.find('\n'))) != std::string::npos);
    CHECK(lines_with(results, "begin study tiny -->") == 1);
    CHECK(lines_with(results, "begin study tiny-coarse -->") == 1);

    bench.folder.write("patch/README.md", before.substr(0, before.rfind("<!--")));
    bench.said.clear();
    CHECK_THROWS_WITH_AS(bench.run(bench.options()), doctest::Contains("end study tiny/patch"), std::runtime_error);
}

TEST_CASE("a run that fails is a row that says so") {
    // At a tenth of the sound speed's pressure the water would have no volume; the fine run's domain is too small.
    const std::string text = with(matrix, "set = [\"fluid.scheme.reconstruction=none\"]",
                                  "set = [\"fluid.initial.velocity=['1000', '0']\", \"time.end=0.5\"]");
    Bench bench(text);
    REQUIRE(bench.run(bench.options()) == engine::success);
    CHECK(lines_with(bench.results(), "failed: ") == 2);
    // Short in its cell, in full where the run is.
    std::istringstream lines(bench.results());
    for (std::string line; std::getline(lines, line);)
        if (line.find("failed: ") != std::string::npos) CHECK(line.size() < 200);
    CHECK(lines_with(bench.results(), "`said.txt` of its folder") == 1);
    CHECK(contents(bench.folder / "runs" / "patch" / "first_0.2" / "said.txt").find("likely cause") !=
          std::string::npos);
    CHECK(lines_with(bench.results(), "| MUSCL |") == 2);
    CHECK(bench.said.find("2 runs have failed") != std::string::npos);
}

TEST_CASE("the reason in a cell is what went wrong, without where, numbers and remedy") {
    CHECK(engine::short_reason(
              "in task 'FE Newton solve, exchange': solid: Newton failed in step 12 of size 0.0009 s: the system "
              "matrix is not positive definite (residual 444 N at first). Reduce the time step of the solid (or the "
              "ratio p); if it fails at any step, look at the loads (t = 0.01 s, step 89)") ==
          "solid: Newton failed in step 12 of size 0.0009 s: the system matrix is not positive definite");
    CHECK(engine::short_reason("stopped after 0.3 s") == "stopped after 0.3 s");
    CHECK(engine::short_reason("in task 'unended") == "in task 'unended");
    CHECK(engine::short_reason("") == "");
}

TEST_CASE("a run that takes too long is stopped") {
    Bench bench(with(matrix, "[[variant]]\nname = \"muscl\"", "time_limit = 0.3\n[[variant]]\nname = \"muscl\""),
                with(with(patch, "end = 0.01", "end = 1e6"), "[\"0.2\", \"0\"]", "[\"0\", \"0\"]"));
    auto options = bench.options();
    options.only = {"patch/first"};
    options.coarse = true;
    std::string printed;
    REQUIRE(bench.run(options, &printed) == engine::success);
    CHECK(printed.find("stopped after 0.3 s") != std::string::npos);
}

TEST_CASE("a file for the results that cannot be written is found out before anything is computed") {
    Bench bench;
    auto options = bench.options();
    for (const char* place : {"patch/scene.toml/RESULTS.md", "patch"}) {
        options.out = bench.folder / place;
        CHECK_THROWS_AS(bench.run(options), std::system_error);
        CHECK_FALSE(std::filesystem::exists(bench.folder / "runs"));
    }
}

TEST_CASE("a part of a study is printed, not written") {
    Bench bench;
    auto options = bench.options();
    options.coarse = true;
    std::string printed;
    bench.run(options, &printed);
    CHECK(lines_with(printed, "| MUSCL |") == 1);
    options = bench.options();
    options.only = {"first"};
    bench.run(options, &printed);
    CHECK(lines_with(printed, "| MUSCL |") == 0);
    CHECK(lines_with(printed, "| first |") == 2);
    options.only = {"nothing"};
    CHECK_THROWS_AS(bench.run(options), std::invalid_argument);
    options.only.clear();
    options.list = true;
    bench.run(options, &printed);
    CHECK(lines_with(printed, "patch/") == 4);
    CHECK_FALSE(std::filesystem::exists(bench.folder / "RESULTS.md"));
}

TEST_CASE("observed order") {
    CHECK(engine::observed_order(0.04, 0.01, 0.2, 0.1) == doctest::Approx(2));
    CHECK(std::isnan(engine::observed_order(0, 0.01, 0.2, 0.1)));
    CHECK(std::isnan(engine::observed_order(0.04, NAN, 0.2, 0.1)));
}

TEST_CASE("mistakes in a study are named with their place") {
    CHECK(refused(matrix).empty());
    CHECK(refused(with(matrix, "resolutions = [0.2, 0.1]", "resolutions = [0.1, 0.2]")).find("coarse to fine") !=
          std::string::npos);
    CHECK(refused(with(matrix, "resolutions", "resolution")).find("did you mean `resolutions`") != std::string::npos);
    CHECK(refused(with(matrix, "patch/scene", "batch/scene")).find("tiny.study.toml:10:9") != std::string::npos);
    CHECK(refused(with(matrix, "schema_version = 1", "schema_version = 1\nreadme = [\"frst\"]"))
              .find("did you mean \"first\"") != std::string::npos);
    CHECK(refused(matrix + "variants = [\"musl\"]\n").find("did you mean \"muscl\"") != std::string::npos);
    CHECK(refused(with(matrix, "name = \"first\"", "name = \"muscl\"")).find("already taken") != std::string::npos);
    CHECK(refused("schema_version = 1\n").find("no [[case]]") != std::string::npos);
    CHECK(refused("schema_version = 2\n").find("reads a study") != std::string::npos);

    const auto refused_with_scene = [](const std::string& study, const char* says) {
        CAPTURE(study);
        Bench bench(study);
        CHECK_THROWS_WITH_AS(bench.run(bench.options()), doctest::Contains(says), io::SceneError);
        CHECK_FALSE(std::filesystem::exists(bench.folder / "runs"));
    };
    refused_with_scene(with(matrix, "fluid.scheme.reconstruction=none", "fluid.recon=none"),
                       "tiny.study.toml:8:8: error: scene.toml refuses fluid.recon=none: unknown key `recon`");
    refused_with_scene(with(matrix, "fluid.scheme.reconstruction=none", "fluid.cfl=7"),
                       "tiny.study.toml:8:8: error: scene.toml refuses fluid.cfl=7: `cfl` must be in ]0, 1]");
    refused_with_scene(matrix + "set = [\"fluid.cfl\"]\n", "tiny.study.toml:12:8: error: scene.toml refuses fluid.cfl");
    refused_with_scene(matrix + "resolution_key = \"fluid.spacin\"\n",
                       "tiny.study.toml:11:16: error: scene.toml refuses");
    refused_with_scene(matrix + "[[axis]]\nname = \"k\"\nkey = \"fluid.cfl\"\nvalues = [\"0.2\", \"-1\"]\n",
                       "tiny.study.toml:15:18: error: scene.toml refuses fluid.cfl=-1");
    refused_with_scene(matrix + "error = \"energi\"\n", "tiny.study.toml:12:9: error: the scene has no [[compare]]");
    refused_with_scene(matrix + "curve = \"discret\"\n",
                       "tiny.study.toml:12:9: error: history.csv will have no column \"discret\"");
}

TEST_CASE("a study of a body without water counts nodes and Newton iterations") {
    const std::string bar =
        elastic_box({.corner = "1, 0.1", .elements = "4, 1", .poissons_ratio = "0.0"}) + R"([[solid.clamp]]
set = "left"
[[solid.traction]]
surface = "right"
value = [1000.0, 0]
[[solid.track]]
name = "tip"
point = [1.0, 0.0]
[[compare]]
column = "tip_x"
formula = "1e-4 * t"
label = "bar"
)";
    Bench bench(
        "schema_version = 1\n[[case]]\nscene = \"patch/scene.toml\"\nresolution_key = \"solid.scheme.step\"\n"
        "resolutions = [1.0, 0.5]\n",
        bar);
    REQUIRE(bench.run(bench.options()) == engine::success);
    const std::string text = bench.results();
    CHECK(lines_with(text, "| solid.scheme.step | nodes |") == 1);
    CHECK(lines_with(text, "Newton iterations | CPU") == 1);
    CHECK(lines_with(text, "| 0.5 | 23 |") == 1);
    CHECK(text.find("particles") == std::string::npos);
}
