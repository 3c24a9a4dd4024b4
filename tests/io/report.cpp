// The report holds what it was given, loads nothing from elsewhere and survives odd content.
#include "io/report.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <regex>

#include "io/atomic_file.hpp"
#include "io/report_parts.hpp"
#include "io/scene_reader.hpp"
#include "scratch.hpp"

using namespace aquagraph;
using test::ScratchFolder;

namespace {

const double pi = std::acos(-1.0);

// A made-up gate: smooth curves near the measured ones, water that runs out, a plate that bends.
struct MadeUpRun {
    io::Scene scene = io::read_scene(std::filesystem::path(AQUAGRAPH_SOURCE_DIR) / "benchmarks/gate_2d/scene.toml");
    io::History history;
    std::vector<io::Comparison> comparisons;
    io::FlowRecord flow{0.002};
    io::Report report;

    MadeUpRun() {
        history.columns = {{"time", "s"},           {"tip_x", "m"},          {"tip_y", "m"},
                           {"force_x", "N/m"},      {"force_y", "N/m"},      {"energy_fluid", "J/m"},
                           {"energy_solid", "J/m"}, {"energy_total", "J/m"}, {"step_size", "s"},
                           {"particles", ""}};
        history.values.resize(history.columns.size());
        for (int i = 0; i <= 800; ++i) {
            const double t = 0.0005 * i,
                         x = 0.047 * std::sin(std::min(t / 0.16, 1.6) * pi / 2) * (1 + 0.02 * std::sin(90 * t)),
                         y = 7 * x * x;
            const double row[] = {t,
                                  x,
                                  y,
                                  60 * std::exp(-8 * t) + 3 * std::sin(300 * t) * std::exp(-9 * t),
                                  -4 * t,
                                  9 * std::exp(-5 * t),
                                  400 * x * x,
                                  9 * std::exp(-5 * t) + 400 * x * x,
                                  2.1e-5 * (1 + 0.1 * std::sin(20 * t)),
                                  3500 - 1500 * t};
            for (std::size_t c = 0; c < history.columns.size(); ++c) history.values[c].push_back(row[c]);
        }
        for (const io::Compare& compare : scene.comparisons) comparisons.push_back(io::compare_with(compare, history));
        for (int i = 0; i <= 100; ++i) flow_frame(0.004 * i);
        report.reached_time = 0.4;
        report.wall_seconds = 12.3;
        report.key_numbers = {{"Wall-clock time", "12.3", "s", "2 threads"},
                              {"Energy error", "0.42", "%", "of the initial energy, largest"},
                              {"Particles", "3500", "", "at t = 0"}};
        report.tasks = {{"fluxes", "fluid", 6.1, 64000, 9.1e8},  {"gradients", "fluid", 2.9, 64000, 9.1e8},
                        {"neighbours", "fluid", 1.1, 900, 0},    {"FE solve", "solid", 1.6, 16000, 2.5e6, "elements"},
                        {"exchange", "coupling", 0.3, 16000, 0}, {"frames", "output", 0.2, 101, 0}};
        report.summary = {{"scene", "gate_2d"}, {"wall_seconds", 12.3}};
    }

    void flow_frame(double t) {
        std::vector<double> x, y, p, v;
        const double level = 0.14 - 0.13 * std::min(t / 0.4, 1.0), reach = 0.1 + 4.5 * t * t / (0.2 + t);
        for (double a = 0.001; a < 0.1; a += 0.002)
            for (double b = 0.001; b < level; b += 0.002)
                x.push_back(a), y.push_back(b), p.push_back(9810 * (level - b)), v.push_back(t * a * 20);
        for (double a = 0.101; a < reach; a += 0.002)
            for (double b = 0.001; b < 0.03 * (reach - a) / (reach - 0.1); b += 0.002)
                x.push_back(a), y.push_back(b), p.push_back(200), v.push_back(1.5);
        std::vector<io::Point> outline;
        const double tip = 0.047 * std::sin(std::min(t / 0.16, 1.6) * pi / 2);
        const auto side = [&](double at, bool down) {
            for (int k = 0; k <= 40; ++k) {
                const double s = (down ? k : 40 - k) / 40.0;
                outline.push_back({at + tip * s * s * (3 - s) / 2, 0.079 * (1 - s) + 7 * tip * tip * s * s});
            }
        };
        side(0.1, true);
        side(0.105, false);
        flow.add({t, x, y, p, v, {outline}});
    }
};

std::string read(const std::filesystem::path& file) {
    return io::read_file(file);
}

}  // namespace

TEST_CASE("the report holds what it was given and loads nothing") {
    ScratchFolder folder;
    const MadeUpRun run;
    // Where AQUAGRAPH_SAMPLE_REPORT names a file, it stays to be looked at.
    const char* sample = std::getenv("AQUAGRAPH_SAMPLE_REPORT");
    const std::filesystem::path file = sample ? std::filesystem::path(sample) : folder / "report.html";
    io::write_report(file, run.scene, run.report, run.history, run.comparisons, run.flow);
    const std::string page = read(file);
    CHECK(page.size() > 300'000);
    CHECK(page.size() < 4'500'000);
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK(page.find("Dam break through an elastic gate") != std::string::npos);
    CHECK(page.find("Antoci et al. 2007, experiment") != std::string::npos);
    CHECK(page.find("<td>FE solve</td>") != std::string::npos);
    CHECK(page.find("149 M pairs/s") != std::string::npos);
    CHECK(page.find("1.56 M elements/s") != std::string::npos);
    CHECK(page.find("6 MPa") != std::string::npos);
    CHECK(page.find("Chart.js v3") != std::string::npos);
    CHECK(page.find("class=\"banner") == std::string::npos);
    // Addresses stand in Chart.js's own notice alone; nothing is loaded from anywhere.
    CHECK(!std::regex_search(page.substr(0, page.find("Chart.js v3")), std::regex("https?://")));
    for (const char* load : {"src=", "href=", "@import", "url(", "fetch(", "XMLHttpRequest", "import("}) {
        CAPTURE(load);
        CHECK(page.find(load) == std::string::npos);
    }
}

TEST_CASE("under its title the report says what the command line has changed") {
    ScratchFolder folder;
    MadeUpRun run;
    const auto head = [&] {
        io::write_report(folder / "report.html", run.scene, run.report, run.history, run.comparisons, run.flow);
        const std::string page = read(folder / "report.html");
        return page.substr(page.find("<header>"), page.find("</header>") - page.find("<header>"));
    };
    run.scene.overrides.clear();
    CHECK(head().find("changed") == std::string::npos);
    run.scene.overrides = {"fluid.spacing=0.003", "title=a < b"};
    CHECK(head().find("changed: fluid.spacing=0.003, title=a &lt; b</p>") != std::string::npos);
}

TEST_CASE("an interrupted and a failed run say so at the top") {
    ScratchFolder folder;
    MadeUpRun run;
    run.report.outcome = io::RunOutcome::failed;
    run.report.message = "task \"fluxes\": a particle's density is <nan>";
    run.report.reached_time = 0.123;
    io::write_report(folder / "a.html", run.scene, run.report, run.history, run.comparisons, run.flow);
    std::string page = read(folder / "a.html");
    CHECK(page.find("This run went wrong.</strong> It reached t = 0.123 s of 0.4 s") != std::string::npos);
    CHECK(page.find("a particle's density is &lt;nan&gt;") != std::string::npos);
    CHECK(page.find("class=\"banner") < page.find("class=\"cards"));
    run.report.outcome = io::RunOutcome::interrupted;
    io::write_report(folder / "a.html", run.scene, run.report, run.history, run.comparisons, run.flow);
    CHECK(read(folder / "a.html").find("This run was interrupted.") != std::string::npos);
}

TEST_CASE("a run that produced nothing has a report too") {
    ScratchFolder folder;
    io::Scene scene;
    scene.title = "</script><b>&";
    scene.text = "<!-- & -->";
    io::write_report(folder / "a.html", scene, {}, {}, {}, io::FlowRecord(0.1));
    const std::string page = read(folder / "a.html");
    CHECK(page.find("&lt;/script&gt;&lt;b&gt;&amp;") != std::string::npos);
    CHECK(page.find("<canvas id=") == std::string::npos);
    CHECK(page.find("&lt;!-- &amp; --&gt;") != std::string::npos);
}

TEST_CASE("a blown-up run does not break its report") {
    ScratchFolder folder;
    MadeUpRun run;
    const double nan = std::nan("");
    run.history.values[1].back() = nan;
    const std::vector<double> x{0.1, nan}, p{INFINITY, nan};
    run.flow.add({0.5, x, x, p, p, {{{nan, 0}, {0, 1}, {1, INFINITY}}}});
    CHECK_NOTHROW(io::write_report(folder / "a.html", run.scene, run.report, run.history, run.comparisons, run.flow));
    CHECK(read(folder / "a.html").find("NaN") != 0);
}

TEST_CASE("plots keep spikes and group by unit") {
    const MadeUpRun run;
    const auto plots = io::plots(run.history, run.comparisons);
    REQUIRE(plots.size() == 6);
    CHECK(plots[0]["title"] == "tip_x");
    CHECK(plots[0]["series"].size() == 5);
    CHECK(plots[0]["windows"].size() == 2);  // one curve, compared over two windows, drawn once
    CHECK(plots[3]["unit"] == "J/m");
    CHECK(plots[3]["series"].size() == 3);

    io::History spiky{{{"time", "s"}, {"a", "Pa"}}, {{}, {}}};
    for (int i = 0; i < 100'000; ++i) spiky.values[0].push_back(i), spiky.values[1].push_back(i == 54'321 ? 7 : 0);
    const auto points = io::plots(spiky, {})[0]["series"][0]["points"];
    CHECK(points.size() < 4000);
    CHECK(std::find(points.begin(), points.end(), 7.0) != points.end());
}

TEST_CASE("the flow record stays within its limits however long the run") {
    io::FlowRecord::Limits limits;
    limits.bytes = 100'000;
    limits.frames = 20;
    limits.particles = 500;
    io::FlowRecord flow(0.1, limits);
    const std::vector<double> x(2000, 0.5);
    for (int i = 0; i < 1000; ++i) flow.add({0.1 * i, x, x, x, {}, {}});
    CHECK(flow.frames().size() <= 20);
    CHECK(flow.frames().size() >= 8);
    CHECK(flow.frames().front().time == 0);
    CHECK(flow.frames().back().time > 70);
    CHECK(flow.frames()[0].x.size() == 500);
    CHECK(flow.frames()[0].every == 4);
    CHECK(flow.frames()[2].time - flow.frames()[1].time == doctest::Approx(flow.frames()[1].time));
    CHECK_THROWS_AS(flow.add({0, x, {}, {}, {}, {}}), std::invalid_argument);
}

TEST_CASE("quantities are written with prefixes") {
    CHECK(io::quantity(0.00402, "m") == "4.02 mm");
    CHECK(io::quantity(-7.04e-5, "m") == "-70.4 µm");
    CHECK(io::quantity(67.5e9, "Pa") == "67.5 GPa");
    CHECK(io::quantity(0.9999, "m") == "1 m");
    CHECK(io::quantity(12345, "kg") == "1.23e+04 kg");
    CHECK(io::quantity(0.5, "") == "0.5");
    CHECK(io::quantity(1500, "N/m") == "1.5 kN/m");
    CHECK(io::quantity(std::nan(""), "m") == "–");
    CHECK(io::duration(0.1234) == "0.123 s");
    CHECK(io::duration(125) == "2 min 05 s");
    CHECK(io::duration(7800) == "2 h 10 min");
}
