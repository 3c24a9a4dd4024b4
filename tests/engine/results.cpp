// What a run leaves: names, units, times and numbers that hang together.
#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

std::string header_of(const Finished& run) {
    const std::string text = contents(run.results.path / "history.csv");
    return text.substr(0, text.find('\n'));
}

// A row or a frame is due at every multiple of the interval and comes with the first cycle that reaches it; besides
// there is one at the start and one at the end.
void check_due_times(std::span<const double> times, double interval, double end, double longest_cycle) {
    REQUIRE(times.size() >= 2);
    CHECK(times.front() == 0);
    CHECK(times.back() == end);
    std::size_t k = 1;
    for (double due = interval; due < end * (1 - 1e-9); due += interval, ++k) {
        CAPTURE(due);
        REQUIRE(k < times.size());
        CHECK(times[k] >= due * (1 - 1e-9));
        CHECK(times[k] <= due + longest_cycle);
    }
    CHECK(times.size() == k + 1);
}

}  // namespace

TEST_CASE("history.csv names its columns with units") {
    CHECK(header_of(Finished(gate)) ==
          "time[s],step_size[s],tip_x[m],tip_y[m],gate_force_x[N/m],gate_force_y[N/m],fluid_kinetic_energy[J/m],"
          "fluid_potential_energy[J/m],solid_kinetic_energy[J/m],solid_strain_energy[J/m],solid_external_work[J/m],"
          "particles[-],fastest_particle[m/s]");
    CHECK(header_of(Finished(column)) ==
          "time[s],step_size[s],fluid_kinetic_energy[J/m],fluid_potential_energy[J/m],particles[-],"
          "fastest_particle[m/s]");
}

TEST_CASE("rows and frames come when they are due, and the last at the end") {
    for (const auto& [name, text, rows, frames, end] :
         {std::tuple{"gate, CPS", with_coupling(gate, "cps", 1), 0.001, 0.005, 0.02},
          std::tuple{"gate, CPS, p = 3", with_coupling(gate, "cps", 3), 0.001, 0.005, 0.02},
          std::tuple{"gate, CSS, p = 3", with_coupling(gate, "css", 3), 0.001, 0.005, 0.02},
          std::tuple{"column", column, 0.01, 0.02, 0.1},
          // An interval that does not divide the end time.
          std::tuple{"column, odd", with(column, "history_interval = 0.01", "history_interval = 0.03"), 0.03, 0.02,
                     0.1}}) {
        CAPTURE(name);
        const Finished run(text);
        REQUIRE(run.code == engine::success);
        const io::History history = run.results.history();
        double longest = 0;
        for (const double step : history.column("step_size")) longest = std::max(longest, step);
        const double cycle = longest * (std::string(name).find("p = 3") != std::string::npos ? 3 : 1) * 1.1;
        check_due_times(history.time(), rows, end, cycle);

        const auto list = run.results.frames("fluid");
        std::vector<double> times;
        for (const FrameOnDisk& frame : list) times.push_back(frame.time);
        check_due_times(times, frames, end, cycle);
        CHECK(run.results.frames_on_disk("fluid") == list.size());
        CHECK(run.results.summary().at("time_s") == end);
    }
}

TEST_CASE("without an interval every cycle has its row") {
    const Finished run(with(gate, "history_interval = 0.001\n", ""));
    CHECK(run.results.history().rows() == run.results.summary().at("coupling_cycles").get<std::size_t>() + 1);
}

TEST_CASE("frames hold the particles and the solid of their time") {
    const Finished run(gate);
    const io::History history = run.results.history();
    const auto fluid = run.results.frames("fluid"), solid = run.results.frames("solid");
    REQUIRE(fluid.size() == solid.size());
    const std::size_t particles = 20 * 28;
    for (std::size_t k = 0; k < fluid.size(); ++k) {
        CAPTURE(fluid[k].name);
        CHECK(fluid[k].time == solid[k].time);
        const io::Hdf5File water = run.results.open(fluid[k]), body = run.results.open(solid[k]);
        CHECK(water.read<double>("VTKHDF/FieldData/TimeValue") == std::vector<double>{fluid[k].time});
        CHECK(water.shape("VTKHDF/Points") == std::vector<std::size_t>{particles, 3});
        for (const char* scalar : {"pressure", "density", "volume", "fullness", "id"})
            CHECK(water.shape(std::string("VTKHDF/PointData/") + scalar) == std::vector<std::size_t>{particles});
        CHECK(water.shape("VTKHDF/PointData/velocity") == std::vector<std::size_t>{particles, 3});
        // Particles change places in memory, none is lost or doubled.
        const auto ids = water.read<std::int64_t>("VTKHDF/PointData/id");
        CHECK(std::set<std::int64_t>(ids.begin(), ids.end()).size() == particles);
        CHECK(body.shape("VTKHDF/CellData/von_mises_stress") == std::vector<std::size_t>{10});
        CHECK(body.shape("VTKHDF/PointData/displacement")[1] == 3);
    }
    // The tip of the last frame is where the last row says.
    const io::Hdf5File body = run.results.open(solid.back());
    const auto points = body.read<double>("VTKHDF/Points"), u = body.read<double>("VTKHDF/PointData/displacement");
    bool found = false;
    for (std::size_t n = 0; n < points.size(); n += 3)
        if (std::fabs(points[n] - u[n] - 0.1) < 1e-9 && std::fabs(points[n + 1] - u[n + 1]) < 1e-9) {
            found = true;
            CHECK(u[n] == history.column("tip_x").back());
            CHECK(u[n + 1] == history.column("tip_y").back());
        }
    CHECK(found);
}

TEST_CASE("summary.json says what was run and what it took") {
    const Finished run(gate, 2);
    const nlohmann::json summary = run.results.summary();
    CHECK(summary.at("outcome") == "finished");
    CHECK_FALSE(summary.contains("message"));
    CHECK(summary.at("version").get<std::string>().size() > 0);
    CHECK(summary.at("scene").at("title") == "Gate");
    // As resolved: what the file leaves out is there with its default.
    CHECK(summary.at("scene").at("fluid").at("cfl") == 0.375);
    CHECK(summary.at("scene").at("fluid").at("density") == 1000);
    CHECK(summary.at("scene").at("coupling").at("algorithm") == "cps");
    CHECK(summary.at("scene").at("solid").at("scheme").contains("alpha"));
    CHECK(summary.at("scene_file").at("name") == "scene.toml");
    CHECK(summary.at("scene_file").at("text") == gate);
    CHECK(summary.at("threads") == 2);
    CHECK(summary.at("particles") == 20 * 28);
    CHECK(summary.at("particles_removed") == 0);
    CHECK(summary.at("elements") == 10);
    CHECK(summary.at("nodes") == 53);  // 8-node quadrilaterals: 2·11 corners, 10·2 + 11 mid-sides
    CHECK(summary.at("wall_seconds").get<double>() > 0);
    CHECK(summary.at("bytes_per_particle").get<double>() > 200);
    const long steps = summary.at("steps"), cycles = summary.at("coupling_cycles");
    CHECK(steps > 50);
    CHECK(cycles == steps);
    CHECK(summary.at("solid").at("steps") == cycles);
    CHECK(summary.at("solid").at("newton_iterations").get<long>() >= cycles);
    CHECK(summary.at("solid").at("factorisations").get<long>() >= 1);

    const nlohmann::json& tasks = summary.at("tasks");
    CHECK(tasks.at("fluxes").at("calls") == 4 * steps);
    CHECK(tasks.at("gradients").at("calls") == 4 * steps + cycles);
    CHECK(tasks.at("FE Newton solve").at("calls") == cycles);
    CHECK(tasks.at("exchange").at("calls") == cycles);
    double thread_seconds = 0;
    for (const auto& [name, task] : tasks.items()) {
        CAPTURE(name);
        CHECK(task.at("wall_seconds").get<double>() >= 0);
        CHECK(task.at("thread_seconds").get<double>() >= 0);
        thread_seconds += task.at("thread_seconds").get<double>();
        const bool has_pairs = name == "fluxes" || name == "gradients" || name == "interface loads";
        CHECK(task.contains("pairs_per_second_per_core") == has_pairs);
        if (has_pairs) CHECK(task.at("pairs_per_second_per_core").get<double>() > 1e5);
    }
    CHECK(thread_seconds <= 2 * summary.at("wall_seconds").get<double>() * 1.01);
}

TEST_CASE("comparisons with references reach the summary") {
    const ScratchFolder references;
    // The computed curve is compared with zero: the error is the curve itself.
    const auto file = references.write("zero.csv", "t,x\n0.005,0\n0.01,0\n0.015,0\n0.03,0\n");
    const Finished run(gate + "[[compare]]\ncolumn = \"tip_x\"\nfile = \"" + file.string() +
                       "\"\nlabel = \"nothing\"\nwindow = [0.004, 0.02]\n[[compare]]\ncolumn = \"tip_x\"\nfile = \"" +
                       file.string() + "\"\nlabel = \"drawn only\"\nerror = false\n");
    REQUIRE(run.code == engine::success);
    const nlohmann::json comparisons = run.results.summary().at("comparisons");
    REQUIRE(comparisons.size() == 1);
    const nlohmann::json& c = comparisons[0];
    CHECK(c.at("column") == "tip_x");
    CHECK(c.at("unit") == "m");
    CHECK(c.at("label") == "nothing");
    CHECK(c.at("points") == 3);
    CHECK(c.at("rms").get<double>() > 0);
    const auto tip = run.results.column("tip_x");
    CHECK(c.at("largest_error").get<double>() <= *std::max_element(tip.begin(), tip.end()));
    CHECK(run.results.report().find("nothing") != std::string::npos);
}

TEST_CASE("the report is one file that asks for no other") {
    for (const std::string& text : {gate, column}) {
        const Finished run(text);
        const std::string report = run.results.report();
        CHECK(report.find("<html") != std::string::npos);
        CHECK(report.find(run.results.summary().at("scene").at("title").get<std::string>()) != std::string::npos);
        for (const char* outside :
             {"src=\"http", "href=\"http", "src=\"//", "<link", "@import", "url(http", "fetch("}) {
            CAPTURE(outside);
            CHECK(count(report, outside) == 0);
        }
    }
}

TEST_CASE("numbers in the history hang together") {
    const Finished run(gate);
    const io::History history = run.results.history();
    const std::size_t last = history.rows() - 1;
    // The water pushes the gate outwards.
    double mean = 0;
    for (const double force : history.column("gate_force_x")) mean += force / double(history.rows());
    CHECK(mean > 0);
    CHECK(history.column("tip_x")[last] > 0);
    CHECK(history.column("particles")[last] == 560);
    // Potential energy is turned into motion and into the gate; numerical dissipation takes some, nothing adds any but
    // the compression of water at rest, ρ g² H³ L / 6c², for which there is no column.
    const double compression = 1000 * 9.81 * 9.81 * std::pow(0.14, 3) * 0.1 / (6 * 30.0 * 30.0);
    const auto energy = [&](std::size_t k) {
        return history.column("fluid_kinetic_energy")[k] + history.column("fluid_potential_energy")[k] +
               history.column("solid_kinetic_energy")[k] + history.column("solid_strain_energy")[k];
    };
    CHECK(history.column("fluid_kinetic_energy")[last] > 0);
    CHECK(history.column("solid_strain_energy")[last] > 0);
    CHECK(history.column("fluid_potential_energy")[last] < history.column("fluid_potential_energy")[0]);
    INFO("gained ", energy(last) - energy(0), " J/m of ", compression);
    CHECK(energy(last) < energy(0) + compression);
}

TEST_CASE("the solid knows the water's load from the start") {
    const Finished run(gate);
    const io::History history = run.results.history();
    // ½ ρ g (H² - (H - h)²) of still water in front of the gate, h its height: what the first solve of CPS reads.
    const double H = 0.14, h = 0.08;
    const double still = 0.5 * 1000 * 9.81 * (H * H - (H - h) * (H - h));
    CHECK(history.column("gate_force_x")[0] == doctest::Approx(still).epsilon(0.1));
}
