// A body that CalculiX (ccx, G. Dhondt) takes through time: one run of it per step, each going on from the restart file
// of the one before, in a folder of temporary files. Slow, and a proof that the coupling needs nothing of a solver but
// solid::Structure. What the steps are and how far they are those of solid::Solver: CalculixStep.
//
// ccx prints displacements and velocities with seven digits; energies and stresses are those that the elements of
// solid::Solver have with them.
#pragma once
#include <filesystem>
#include <string>

#include "physics/solid/solver.hpp"

namespace aquagraph::engine {

template <int D>
class CalculixSolver final : public solid::Structure<D> {
  public:
    // `same`: the body as solid::Solver has it, which from now on follows this one. `program`: ccx, looked for in PATH
    // where it has no slash. Throws solid::SolverError where it cannot be run, and std::invalid_argument for what it
    // has no equal for.
    CalculixSolver(solid::Solver<D>& same, std::string program);
    ~CalculixSolver() override;  // removes its files, but those of a run that has failed
    CalculixSolver(const CalculixSolver&) = delete;
    CalculixSolver& operator=(const CalculixSolver&) = delete;

    void solve_static(std::span<const double> external_forces, BlockLoop loop) override;
    void advance(double dt, std::span<const double> external_forces, BlockLoop loop) override;
    double work_of_loads() const override { return state_.load_work; }
    double largest_stable_step() const override { return same_.largest_stable_step(); }
    void set_time(double time) override;

    const solid::Mesh<D>& mesh() const override { return same_.mesh(); }
    std::span<const double> positions() const override { return same_.positions(); }
    std::span<const double> displacements() const override { return same_.displacements(); }
    std::span<const double> velocities() const override { return same_.velocities(); }
    solid::Energies energies() const override { return same_.energies(); }
    solid::Statistics statistics() const override { return state_.statistics; }

    void save(solid::State& state) const override { state = state_; }
    void restore(const solid::State& state) override;

    const std::filesystem::path& folder() const { return folder_; }

  private:
    void run(const std::string& deck, const std::string& what);
    void take_results(const std::string& what);
    [[noreturn]] void fail(const std::string& what, const std::string& why);

    solid::Solver<D>& same_;
    std::string program_;
    std::filesystem::path folder_;
    bool failed_ = false;
    solid::State state_;
};

}  // namespace aquagraph::engine
