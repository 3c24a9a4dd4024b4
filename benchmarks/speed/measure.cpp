// Measures the pair passes against the yardstick beside this file, whole steps beside the open codes, and the cases'
// wall time and error; each is a section of benchmarks/RESULTS.md. Question: how much of what a core can do does a pass
// reach, and what does an error cost?
//
// Passes and yardstick run in turn, several times, and medians are compared: the machine's drift cancels.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "benchmarks/speed/block.hpp"
#include "benchmarks/speed/results_file.hpp"
#include "benchmarks/speed/solid.hpp"
#include "benchmarks/speed/steps.hpp"
#include "engine/run.hpp"
#include "io/scene_reader.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/fluxes.hpp"
#include "physics/fluid/gradients.hpp"

namespace {

using namespace aquagraph;
using aquagraph::benchmarks::seconds_of;

constexpr int rounds = 3;              // of passes and yardstick
constexpr int case_rounds = 3;         // of whole runs of the quick cases
constexpr double skin_of_step = 0.02;  // over R: a step at Mach 0.02

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct PassSpeed {
    double gradients = 0, fluxes = 0;        // Mpairs/s of one core
    double search = 0, tree = 0, prune = 0;  // ns per particle
};

// A disturbed lattice of n^D particles, as in the yardstick; lists with the skin that runs use.
template <int D>
class Lattice {
  public:
    Lattice(std::size_t n, double radius) : kernel_(radius) {
        std::size_t count = 1;
        for (int d = 0; d < D; ++d) count *= n;
        particles_.resize(count, 0);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> noise(-0.1, 0.1);
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t rest = i;
            for (std::size_t d = 0; d < D; ++d) {
                particles_.x[d][i] = double(rest % n) + noise(random);
                particles_.v[d][i] = noise(random);
                rest /= n;
            }
            particles_.id[i] = std::int64_t(i);
            particles_.mass[i] = 1000;
            particles_.volume[i] = 1;
            particles_.p[i] = noise(random);
            particles_.impedance[i] = 30;
        }
        reorder_.apply(particles_, order_.sort(particles_.x, count, 1.0));
        lists_.radius = radius;
        lists_.skin = fluid::skin_ratio<D>(true) * radius;
    }

    PassSpeed measure() {
        PassSpeed speed;
        const auto time = [](auto&& work) {
            double best = 1e30;
            for (int k = 0; k < 4; ++k) {
                const auto begin = std::chrono::steady_clock::now();
                work();
                best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
            }
            return best;
        };
        search_.method = fluid::SearchMethod::tree;
        speed.tree = seconds_of([&] { search_.build(particles_, lists_, nullptr, serial_loop); });
        search_.method = fluid::SearchMethod::cell_grid;
        const double search = time([&] { search_.build(particles_, lists_, nullptr, serial_loop); });
        const double prune = time([&] { fluid::prune(particles_, lists_, skin_of_step * lists_.radius, serial_loop); });
        const double pairs = double(lists_.pairs()) / 1e6;
        speed.search = 1e9 * search / double(particles_.count);
        speed.tree *= 1e9 / double(particles_.count);
        speed.prune = 1e9 * prune / double(particles_.count);
        const auto blocks = [&](auto&& pass) {
            for (std::size_t b = 0; b < particles_.blocks(); ++b) pass(lanes_of_block(particles_, b));
        };
        speed.gradients = pairs / time([&] {
                              blocks([&](auto lanes) { compute_gradients<D>(particles_, lists_, kernel_, lanes); });
                          });
        speed.fluxes = pairs / time([&] {
                           blocks([&](auto lanes) {
                               compute_fluxes<D>(particles_, lists_, kernel_, {}, fluid::Tait{1000, 30}, lanes);
                           });
                       });
        return speed;
    }

  private:
    fluid::Particles<D> particles_;
    fluid::NeighbourLists<D> lists_;
    fluid::WendlandC2<D> kernel_;
    fluid::SpatialOrder<D> order_;
    fluid::Reorder<D> reorder_;
    fluid::NeighbourSearch<D> search_;
};

// The yardstick's best figure in double precision, per "dimension/radius": one JSON object per line.
std::map<std::string, double> yardstick() {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(AQUAGRAPH_LIMIT, "r"), pclose);
    if (!pipe) throw std::runtime_error("cannot start " AQUAGRAPH_LIMIT);
    std::map<std::string, double> best;
    char line[2000];
    while (std::fgets(line, sizeof line, pipe.get())) {
        const auto figure = nlohmann::json::parse(line);
        if (figure["precision"] != "double") continue;
        double& value = best[fmt::format("{}D, R/Δx {:.2f}", figure["dimension"].get<int>(),
                                         figure["radius_over_spacing"].get<double>())];
        for (const char* form : {"gather_list_Mpairs_per_s", "cluster_Mpairs_per_s"})
            value = std::max(value, figure[form].get<double>());
    }
    return best;
}

std::string pass_table() {
    struct Measured {
        std::vector<double> limit, gradients, fluxes, search, tree, prune;
    };
    std::map<std::string, Measured> all;
    std::vector<std::pair<std::string, std::function<PassSpeed()>>> set_ups;
    for (const double radius : {2.11, 2.6, 3.0, 4.0}) {
        set_ups.push_back({fmt::format("2D, R/Δx {:.2f}", radius),
                           [lattice = std::make_shared<Lattice<2>>(200, radius)] { return lattice->measure(); }});
        set_ups.push_back({fmt::format("3D, R/Δx {:.2f}", radius),
                           [lattice = std::make_shared<Lattice<3>>(40, radius)] { return lattice->measure(); }});
    }
    for (int round = 0; round < rounds; ++round) {
        std::cerr << "passes, round " << round + 1 << " of " << rounds << "\n";
        for (const auto& [name, value] : yardstick()) all[name].limit.push_back(value);
        for (const auto& [name, measure] : set_ups) {
            const PassSpeed speed = measure();
            Measured& m = all[name];
            m.gradients.push_back(speed.gradients);
            m.fluxes.push_back(speed.fluxes);
            m.search.push_back(speed.search);
            m.tree.push_back(speed.tree);
            m.prune.push_back(speed.prune);
        }
    }
    std::string text =
        "| set-up | yardstick [Mpairs/s] | flux pass | of the yardstick | gradient pass | search [ns/particle] | the "
        "same by nanoflann | pruning |\n|---|---|---|---|---|---|---|---|\n";
    for (const auto& [name, m] : all) {
        if (m.fluxes.empty()) continue;
        text += fmt::format("| {} | {:.0f} | {:.0f} | {:.0f} % | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n", name,
                            median(m.limit), median(m.fluxes), 100 * median(m.fluxes) / median(m.limit),
                            median(m.gradients), median(m.search), median(m.tree), median(m.prune));
    }
    return text;
}

std::string case_table(int threads) {
    std::string text =
        "| scene | particles | steps | wall [s] | flux pass [Mpairs/s/core] | column, window | RMS error | of the peak "
        "| "
        "mean error |\n|---|---|---|---|---|---|---|---|---|\n";
    const std::filesystem::path root = AQUAGRAPH_SOURCE_DIR "/benchmarks",
                                scratch = std::filesystem::temp_directory_path() / "aquagraph-measure";
    for (const char* file :
         {"gate_2d/scene_fast.toml", "gate_2d/scene.toml", "gate_2d/scene_1mm.toml", "hydrostatic_plate/scene.toml"}) {
        const io::Scene scene = io::read_scene(root / file);
        const bool quick = scene.fluid->spacing > 0.0022;  // finer ones are run once
        engine::RunOptions options;
        options.folder = scratch;
        options.threads = threads;
        options.quiet = true;
        std::vector<double> wall;
        nlohmann::json summary;
        for (int round = 0; round < (quick ? case_rounds : 1); ++round) {
            std::cerr << file << ", run " << round + 1 << "\n";
            if (engine::run(scene, options, std::cout, std::cerr) != engine::success)
                throw std::runtime_error(std::string(file) + " has failed");
            std::ifstream(scratch / "summary.json") >> summary;
            wall.push_back(summary["wall_seconds"].get<double>());
        }
        const double flux = summary["tasks"]["fluxes"]["pairs_per_second_per_core"].get<double>() / 1e6;
        std::string lead = fmt::format("| {} | {} | {} | {:.1f} | {:.0f} |", file,
                                       summary["particles"].get<long>() + summary["particles_removed"].get<long>(),
                                       summary["steps"].get<long>(), median(wall), flux);
        for (const auto& c : summary["comparisons"]) {
            text += fmt::format("{} {}, {:g}–{:g} s | {:.3g} {} | {:.1f} % | {:+.2g} {} |\n", lead,
                                c["column"].get<std::string>(), c["window_s"][0].get<double>(),
                                c["window_s"][1].get<double>(), c["rms"].get<double>(), c["unit"].get<std::string>(),
                                100 * c["normalised_rms"].get<double>(), c["mean_error"].get<double>(),
                                c["unit"].get<std::string>());
            lead = "| | | | | |";
        }
    }
    std::filesystem::remove_all(scratch);
    return text;
}

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

std::string title(const char* name, const char* heading, int threads) {
    return fmt::format(
        "## {}\n\nWritten by `./aquagraph measure --only {}`.\n\nMachine: {}, {} threads; compiler GCC {}.\n\n",
        heading, name, processor(), threads, __VERSION__);
}

std::string passes(int threads) {
    return title("passes", "Pair passes and searches", threads) +
           fmt::format(
               "One core, double precision, disturbed lattice; the yardstick is `benchmarks/speed/pair_flux_limit.cpp` "
               "(its best form, lists without skin; ours are pruned to a skin of {:g} R). The search makes lists for a "
               "run, with a skin of {:g} R; pruning makes those of a step. Medians of {} alternating rounds.\n\n",
               skin_of_step, fluid::skin_ratio<2>(true), rounds) +
           pass_table();
}

std::string steps(int threads) {
    return title("steps", "Whole steps", threads) + benchmarks::step_tables(threads);
}

std::string finite_elements(int threads) {
    return title("solid", "Finite elements", threads) + benchmarks::solid_tables(threads);
}

std::string large_solid(int threads) {
    return title("solid-large", "Finite elements: linear solvers on a large mesh", threads) +
           benchmarks::large_solid_table(threads);
}

std::string cases(int threads) {
    return title("cases", "Cases: speed and error", threads) +
           fmt::format(
               "Wall time of the whole run with all output on {} threads, median of {} (scenes finer than 2.2 mm: one "
               "run).\n\n",
               threads, case_rounds) +
           case_table(threads);
}

constexpr struct {
    const char* name;
    std::string (*write)(int threads);
} sections[] = {
    {"passes", passes}, {"steps", steps}, {"solid", finite_elements}, {"solid-large", large_solid}, {"cases", cases}};

constexpr const char* usage =
    "usage: aquagraph-measure [--only passes|steps|solid|solid-large|cases] [--print]\n"
    "  --only   measure this section alone; the others stay in benchmarks/RESULTS.md as they are\n"
    "  --print  write to the terminal alone\n";

}  // namespace

int main(int argc, char** argv) {
    std::string only;
    bool print = false;
    for (int k = 1; k < argc; ++k) {
        const std::string argument = argv[k];
        const auto known = [&](const auto& section) {
            return k + 1 < argc && section.name == std::string(argv[k + 1]);
        };
        if (argument == "--help" || argument == "-h") {
            std::cout << usage;
            return 0;
        } else if (argument == "--print") {
            print = true;
        } else if (argument == "--only" && std::any_of(std::begin(sections), std::end(sections), known)) {
            only = argv[++k];
        } else {
            std::cerr << usage;
            return 2;
        }
    }
    try {
        const int threads = int(std::thread::hardware_concurrency());
        for (const auto& section : sections) {
            if (!only.empty() && only != section.name) continue;
            const std::string text = section.write(threads);
            std::cout << text << "\n" << std::flush;
            if (!print) benchmarks::write_section(AQUAGRAPH_SOURCE_DIR "/benchmarks/RESULTS.md", section.name, text);
        }
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "aquagraph-measure: " << error.what() << "\n";
        return 1;
    }
}
