// One coupling cycle, top to bottom.
//
//   time step                                  CPS fixes Δt for the whole cycle (6.4), CSS chooses it anew each step
//   p times
//     neighbour search                         lists, order of particles, which particle is mirrored where
//     prediction                               Verlet only: its one evaluation comes at the end of the step
//     for each stage of the integration (RK4: 4 times)
//       wall motion -> ghosts                  boundary data are refreshed at every substep, lists are not
//       gradients -> ghost gradients           a ghost's gradient is its parent's, mirrored: hence after it
//       free surface -> shifting, or X-SPH     where asked for, in the first stage
//       fluxes -> viscosity -> body forces -> energy ledger -> integration stage
//       With walls of the normal flux method there are no ghosts:
//       wall motion -> wall gamma, gradients -> wall gradients, fluxes -> viscosity -> wall friction -> wall fluxes
//     wall contact, clock, examine
//   wall motion, ghosts, gradients, loads      the load at the end of the cycle, from the state reached there
//   FE Newton solve                            CPS reads the loads of the last exchange: nothing above holds it up, and
//                                              it runs beside the fluid. CSS reads the loads just computed: one edge
//                                              more, and it waits for the fluid.
//   exchange
//
// A body without water has a step of its own: structural_step() in engine/body_parts.hpp.
#include "engine/listings.hpp"

#include "engine/body_parts.hpp"
#include "tasks/body_force.hpp"
#include "tasks/fluid_pass.hpp"
#include "tasks/flux_walls.hpp"
#include "tasks/neighbours.hpp"
#include "tasks/solid_step.hpp"
#include "tasks/stepping.hpp"
#include "tasks/walls.hpp"

namespace aquagraph::engine {

namespace {

using tasks::Task;

template <int D>
class Listing {
  public:
    explicit Listing(Model<D>& model) : model_(model) {}

    void group(const std::string& name) { group_ = name; }
    void add(Task task) {
        task.group = group_;
        tasks_.push_back(std::move(task));
    }

    // One step of the fluid; `label` tells the steps of a cycle apart.
    void fluid_step(const std::string& label) {
        fluid::Fluid<D>& fluid = *model_.fluid;
        group(label + ", lists");
        lists(label);
        if (fluid.integration.predicts()) {
            group(label + ", prediction");
            add(tasks::prediction(fluid, model_.clock));
        }
        for (int stage = 0; stage < fluid.integration.stages(); ++stage) {
            const std::string name = "stage " + std::to_string(stage + 1);
            group(label + ", " + name);
            evaluation(fluid.integration.stage_time(stage), name, stage == 0);
            if (fluid.ledger.kept) ledger(stage, name);
            add(tasks::integration_stage(fluid, model_.clock, stage));
        }
        group(label + ", end");
        if (moving() && fluid.integration.stage_time(fluid.integration.stages() - 1) < 1) wall_motion(1, "end");
        if (model_.walls) add(tasks::wall_contact(fluid, *model_.walls, label));
        if (model_.flux_walls) add(tasks::wall_contact(fluid, *model_.flux_walls, label));
        add(tasks::advance_clock(model_.clock, label));
        add(tasks::examine(fluid, label));
    }

    void lists(const std::string& label) {
        if (model_.flux_walls) {
            add(tasks::neighbour_search(*model_.fluid, *model_.flux_walls, moving(), model_.clock, label));
            return;
        }
        coupling::Interface* interface = model_.interface ? &*model_.interface : nullptr;
        fluid::GhostWalls<D>* walls = model_.walls ? &*model_.walls : nullptr;
        add(tasks::neighbour_search(*model_.fluid, walls, moving(), interface, model_.clock, label));
    }

    // The rates of the present state, with walls as they are at `fraction` of the present step.
    void evaluation(double fraction, const std::string& name, bool first) {
        auto& fluid = *model_.fluid;
        boundary(fraction, name);
        add(tasks::gradients(fluid, name));
        if (model_.walls) add(tasks::ghost_gradients(fluid, *model_.walls, name));
        if (model_.flux_walls) add(tasks::wall_gradients(fluid, *model_.flux_walls, name));
        if (first) transport(name);
        add(tasks::fluxes(fluid, name));
        if (fluid.viscosity.dynamic > 0) add(tasks::viscosity(fluid, name));
        if (model_.flux_walls) {
            if (fluid.viscosity.dynamic > 0 && fluid.wall_friction > 1)
                add(tasks::wall_friction(fluid, *model_.flux_walls, name));
            add(tasks::wall_fluxes(fluid, *model_.flux_walls, name));
        }
        if (model_.central_force) add(tasks::central_force(fluid, *model_.central_force, name));
        if (model_.driving_force) add(tasks::driving_force<D>(fluid, *model_.driving_force, name));
    }

    void ledger(int stage, const std::string& name) {
        add(tasks::energy_ledger(*model_.fluid, model_.clock, stage, name));
        if (!model_.wall_works.empty())
            add(tasks::wall_work(*model_.fluid, *model_.walls, model_.wall_works, model_.clock, stage, name));
    }

    void transport(const std::string& name) {
        auto& fluid = *model_.fluid;
        if (fluid.transport == fluid::Transport::none) return;
        if (fluid.transport == fluid::Transport::x_sph) {
            add(tasks::x_sph(fluid, name));
        } else {
            add(tasks::free_surface(fluid, name));
            add(tasks::shifting(fluid, name));
        }
        if (model_.walls && model_.walls->periodic.any()) add(tasks::ghost_shift(fluid, *model_.walls, name));
    }

    // Walls and ghosts at `fraction` of the present step.
    void boundary(double fraction, const std::string& label) {
        if (model_.flux_walls) {
            if (moving()) wall_motion(fraction, label);
            add(tasks::wall_gamma(*model_.fluid, *model_.flux_walls, label));
        }
        if (!model_.walls) return;
        const coupling::Interface* interface = model_.interface ? &*model_.interface : nullptr;
        if (interface || moving())
            add(tasks::wall_motion(*model_.walls, moving(), interface, model_.clock, fraction, label));
        add(tasks::ghost_state(*model_.fluid, *model_.walls, label));
    }

    void loads() requires(D == 2) {
        boundary(0, "interface");
        add(tasks::interface_gradients(*model_.fluid, *model_.interface));
        add(tasks::ghost_gradients(*model_.fluid, *model_.walls, "interface"));
        add(tasks::interface_loads(*model_.fluid, *model_.walls, *model_.interface));
    }

    std::vector<Task> take() { return std::move(tasks_); }

  private:
    // Of walls that move by themselves alone.
    void wall_motion(double fraction, const std::string& label) {
        if (model_.flux_walls)
            add(tasks::wall_motion(*model_.flux_walls, *moving(), model_.clock, fraction, label));
        else
            add(tasks::wall_motion<D>(*model_.walls, moving(), nullptr, model_.clock, fraction, label));
    }
    const fluid::MovingWalls<D>* moving() const { return model_.moving.empty() ? nullptr : &model_.moving; }

    Model<D>& model_;
    std::string group_;
    std::vector<Task> tasks_;
};

}  // namespace

template <int D>
std::vector<Task> coupling_cycle(Model<D>& model, const io::CouplingScene& coupling) {
    if (model.structure) return structural_step(model);
    Listing<D> listing(model);
    const bool coupled = model.interface.has_value();
    const bool cps = coupled && coupling.algorithm == io::CouplingAlgorithm::cps;
    const int p = coupled ? coupling.ratio : 1;

    if (cps)
        listing.add(tasks::time_step(*model.fluid, model.clock,
                                     {.fraction = coupling.step_fraction, .steps = p, .whole_cycle = true}, ""));
    for (int step = 1; step <= p; ++step) {
        const std::string label = "step " + std::to_string(step);
        listing.group(label);
        if (!cps) listing.add(tasks::time_step(*model.fluid, model.clock, {.first_of_cycle = step == 1}, label));
        listing.fluid_step(label);
    }
    if constexpr (D == 2) {
        if (coupled) {
            listing.group("exchange");
            listing.loads();
            listing.add(tasks::newton_solve(*model.solid, *model.interface, model.clock,
                                            cps ? tasks::LoadsOf::last_exchange : tasks::LoadsOf::this_cycle));
            listing.add(tasks::exchange(*model.solid, *model.interface, model.clock));
        }
    }
    return listing.take();
}

template <int D>
std::vector<Task> first_evaluation(Model<D>& model) {
    if (!model.fluid || !model.fluid->integration.predicts()) return {};
    Listing<D> listing(model);
    listing.lists("start");
    listing.evaluation(0, "start", true);
    if (model.fluid->ledger.kept) listing.ledger(0, "start");
    return listing.take();
}

template std::vector<Task> first_evaluation(Model<2>&);
template std::vector<Task> first_evaluation(Model<3>&);
template std::vector<Task> coupling_cycle(Model<2>&, const io::CouplingScene&);
template std::vector<Task> coupling_cycle(Model<3>&, const io::CouplingScene&);

}  // namespace aquagraph::engine
