#include "engine/calculix_solver.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "engine/calculix_results.hpp"
#include "engine/child_process.hpp"
#include "physics/solid/calculix_export.hpp"

namespace aquagraph::engine {

namespace {

constexpr double longest_run = 600;  // [s], after which ccx is taken to hang

std::filesystem::path make_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "aquagraph_calculix_XXXXXX").string();
    if (!mkdtemp(name.data()))
        throw std::system_error(errno, std::generic_category(), "cannot make a folder for CalculiX, " + name);
    return name;
}

// What ccx says has gone wrong: the first *ERROR with the lines that belong to it.
std::string complaint_in(const std::filesystem::path& log) {
    std::ifstream said(log);
    std::string text;
    for (std::string line; std::getline(said, line);) {
        const std::size_t from = line.find_first_not_of(" \t");
        if (text.empty() ? line.find("*ERROR") == std::string::npos : from == std::string::npos) {
            if (!text.empty()) break;
            continue;
        }
        if (!text.empty()) text += ' ';
        text.append(line, from);
    }
    return text;
}

double total(const solid::Energies& energies) {
    return energies.kinetic + energies.strain + energies.gravity_potential;
}

}  // namespace

template <int D>
CalculixSolver<D>::CalculixSolver(solid::Solver<D>& same, std::string program)
    : same_(same), program_(std::move(program)), folder_(make_folder()) {
    same_.save(state_);
    try {
        std::ostringstream deck;  // refuses what ccx does not know
        write_calculix_start(deck, same_.mesh(), same_.options(), {}, false);
        run_child(program_, {"-v"}, folder_ / "version.log", longest_run, [] { return false; }, {folder_, true});
    } catch (const std::system_error& error) {
        std::filesystem::remove_all(folder_);
        throw solid::SolverError(fmt::format("CalculiX cannot be started: {}", error.what()));
    } catch (...) {
        std::filesystem::remove_all(folder_);
        throw;
    }
    std::ifstream said(folder_ / "version.log");
    const std::string text{std::istreambuf_iterator<char>(said), {}};
    if (text.find("Version") == std::string::npos) {
        std::filesystem::remove_all(folder_);
        throw solid::SolverError(fmt::format("'{} -v' does not answer with a version, as ccx does", program_));
    }
}

template <int D>
CalculixSolver<D>::~CalculixSolver() {
    std::error_code ignored;
    if (!failed_) std::filesystem::remove_all(folder_, ignored);
}

template <int D>
void CalculixSolver<D>::fail(const std::string& what, const std::string& why) {
    failed_ = true;
    throw solid::SolverError(
        fmt::format("CalculiX failed in {}: {}; its files are step.* in {}", what, why, folder_.string()));
}

// One run of ccx; afterwards the body is where it has ended, and goes on from there.
template <int D>
void CalculixSolver<D>::run(const std::string& deck, const std::string& what) {
    for (const char* old : {"step.dat", "step.rout", "step.rin"}) std::filesystem::remove(folder_ / old);
    std::ofstream(folder_ / "step.inp") << deck;
    if (!state_.files.empty())
        std::ofstream(folder_ / "step.rin", std::ios::binary)
            .write(state_.files.data(), std::streamsize(state_.files.size()));
    ChildEnd end;
    try {
        end = run_child(program_, {"-i", "step"}, folder_ / "step.log", longest_run, [] { return false; },
                        {folder_, true});
    } catch (const std::system_error& error) {
        fail(what, error.what());
    }
    const std::string complaint = complaint_in(folder_ / "step.log");
    if (end.timed_out) fail(what, fmt::format("it had not ended after {} s", longest_run));
    if (end.signal != 0) fail(what, fmt::format("it was ended by signal {}", end.signal));
    if (end.code != 0 || !complaint.empty())
        fail(what, complaint.empty() ? fmt::format("it ended with code {}", end.code) : complaint);
    take_results(what);
}

template <int D>
void CalculixSolver<D>::take_results(const std::string& what) {
    CalculixResults results;
    try {
        std::ifstream dat(folder_ / "step.dat");
        results = read_calculix_results<D>(dat, same_.mesh().nodes.size());
    } catch (const CalculixResultsError& error) {
        fail(what, fmt::format("its results cannot be used: {}", error.what()));
    }
    std::ifstream restart(folder_ / "step.rout", std::ios::binary);
    std::vector<char> files{std::istreambuf_iterator<char>(restart), {}};
    if (files.empty()) fail(what, "it has written no restart file");
    state_.displacements = std::move(results.displacements);
    state_.velocities = std::move(results.velocities);
    state_.files = std::move(files);
}

template <int D>
void CalculixSolver<D>::solve_static(std::span<const double> external_forces, BlockLoop) {
    std::ostringstream deck;
    write_calculix_start(deck, same_.mesh(), same_.options(), external_forces, true);
    const std::vector<char> before = std::exchange(state_.files, {});
    try {
        run(deck.str(), "the equilibrium");
    } catch (...) {
        state_.files = before;
        throw;
    }
    std::fill(state_.velocities.begin(), state_.velocities.end(), 0.0);
    state_.external_forces.assign(external_forces.begin(), external_forces.end());
    state_.accelerations_known = false;
    state_.loads = state_.external_forces;
    state_.external_work = state_.load_work = state_.numerical_dissipation = 0;
    same_.restore(state_);
}

template <int D>
void CalculixSolver<D>::advance(double dt, std::span<const double> external_forces, BlockLoop) {
    const std::string what = fmt::format("step {}", state_.statistics.steps + 1);
    if (state_.files.empty()) {  // from rest: a file to go on from
        std::ostringstream deck;
        write_calculix_start(deck, same_.mesh(), same_.options(), {}, false);
        run(deck.str(), "the start");
    }
    const bool first = !state_.accelerations_known;
    std::ostringstream deck;
    write_calculix_step(
        deck, same_.mesh(), same_.options(),
        {.size = dt, .first = first, .forces = external_forces, .forces_before = state_.external_forces});
    const double before = total(same_.energies());
    const std::vector<double> from = state_.displacements;
    run(deck.str(), what);
    double work = 0;
    for (std::size_t f = 0; f < from.size(); ++f)
        work += 0.5 * ((first ? external_forces[f] : state_.external_forces[f]) + external_forces[f]) *
                (state_.displacements[f] - from[f]);
    state_.external_work += work;
    state_.load_work += work;
    state_.external_forces.assign(external_forces.begin(), external_forces.end());
    state_.accelerations_known = true;
    state_.time += dt;
    ++state_.statistics.steps;
    same_.restore(state_);
    // What the loads have put in and the body has not.
    state_.numerical_dissipation += work - (total(same_.energies()) - before);
    same_.restore(state_);
}

template <int D>
void CalculixSolver<D>::set_time(double time) {
    state_.time = time;
    same_.set_time(time);
}

template <int D>
void CalculixSolver<D>::restore(const solid::State& state) {
    same_.restore(state);
    state_ = state;
}

template class CalculixSolver<2>;
template class CalculixSolver<3>;

}  // namespace aquagraph::engine
