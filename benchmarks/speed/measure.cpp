// Measures the pair passes against the yardstick beside this file, and the cases' wall time and error, and writes
// benchmarks/RESULTS.md. Question: how much of what a core can do does a pass reach, and what does an error cost?
//
// Passes and yardstick run in turn, several times, and medians are compared: the machine's drift cancels.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "engine/run.hpp"
#include "io/scene_reader.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/fluxes.hpp"
#include "physics/fluid/gradients.hpp"

namespace {

using namespace aquagraph;

constexpr int rounds = 5;       // of passes and yardstick
constexpr int case_rounds = 3;  // of whole runs

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct PassSpeed {
    double gradients = 0, fluxes = 0, search = 0;  // Mpairs/s of one core; search: ns per particle
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
        lists_.skin = fluid::skin_ratio * radius;
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
        const double search = time([&] { search_.build(particles_, lists_, nullptr, serial_loop); });
        const double pairs = double(lists_.pairs()) / 1e6;
        speed.search = 1e9 * search / double(particles_.count);
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
    Lattice<2> plane(200, 4.0);
    Lattice<3> coarse(48, 2.11), space(48, 3.0);
    std::map<std::string, std::vector<double>> limit, gradients, fluxes, search;
    for (int round = 0; round < rounds; ++round) {
        std::cerr << "passes, round " << round + 1 << " of " << rounds << "\n";
        for (const auto& [name, value] : yardstick()) limit[name].push_back(value);
        const auto add = [&](const std::string& name, const PassSpeed& speed) {
            gradients[name].push_back(speed.gradients);
            fluxes[name].push_back(speed.fluxes);
            search[name].push_back(speed.search);
        };
        add("2D, R/Δx 4.00", plane.measure());
        add("3D, R/Δx 2.11", coarse.measure());
        add("3D, R/Δx 3.00", space.measure());
    }
    std::string text =
        "| set-up | yardstick [Mpairs/s] | flux pass | of the yardstick | gradient pass | neighbour search "
        "[ns/particle] "
        "|\n|---|---|---|---|---|---|\n";
    for (const auto& [name, values] : fluxes)
        text += fmt::format("| {} | {:.0f} | {:.0f} | {:.0f} % | {:.0f} | {:.0f} |\n", name, median(limit[name]),
                            median(values), 100 * median(values) / median(limit[name]), median(gradients[name]),
                            median(search[name]));
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
        const bool quick = scene.fluid->spacing > 0.0015;  // finer ones are run once
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

}  // namespace

int main() {
    try {
        const int threads = int(std::thread::hardware_concurrency());
        std::string text =
            "# Measured results\n\nWritten by `aquagraph-measure`; to repeat:\n\n"
            "    ./aquagraph build aquagraph-measure && build/release/benchmarks/aquagraph-measure\n\n";
        text += fmt::format("Machine: {}, {} threads; compiler GCC {}.\n\n", processor(), threads, __VERSION__);
        text += fmt::format(
            "## Pair passes\n\nOne core, double precision, disturbed lattice; the yardstick is "
            "`benchmarks/speed/pair_flux_limit.cpp` (its best form, lists without skin; ours have a skin of "
            "{:g} R). Medians of {} alternating rounds.\n\n",
            fluid::skin_ratio, rounds);
        text += pass_table();
        text += fmt::format(
            "\n## Cases: speed and error\n\nWall time of the whole run with all output on {} threads, "
            "median of {} (scenes finer than 1.5 mm: one run).\n\n",
            threads, case_rounds);
        text += case_table(threads);
        std::ofstream(AQUAGRAPH_SOURCE_DIR "/benchmarks/RESULTS.md") << text;
        std::cout << text;
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "aquagraph-measure: " << error.what() << "\n";
        return 1;
    }
}
