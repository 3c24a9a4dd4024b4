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
//       With walls of the normal flux method there are no ghosts but for periodic images:
//       wall motion -> wall gamma, gradients -> wall gradients, fluxes -> viscosity -> wall friction -> wall fluxes
//     wall contact, clock, examine
//   wall motion, ghosts, gradients, loads      the load at the end of the cycle, from the state reached there
//   FE Newton solve                            CPS reads the loads of the last exchange: nothing above holds it up, and
//                                              it runs beside the fluid. CSS reads the loads just computed: one edge
//                                              more, and it waits for the fluid.
//   interface energy                           where the scene or the load asks for it
//   exchange -> ratio control                  where p is regulated
//
// The iterated algorithm fixes Δt as CPS does, keeps the state, and runs the steps, the loads and a solve that reads
// them over and over, from the same start and with another guess of where the wet nodes will be at the end, until the
// solid agrees with the guess; then comes the exchange. A guess that cannot be computed is halved (engine/trials.hpp).
//
// A body without water has a step of its own: structural_step() in engine/body_parts.hpp.
#include "engine/listings.hpp"

#include "engine/body_parts.hpp"
#include "tasks/body_force.hpp"
#include "tasks/either_walls.hpp"
#include "tasks/fluid_pass.hpp"
#include "tasks/flux_walls.hpp"
#include "tasks/iteration.hpp"
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
            ledger(stage, name);
            add(tasks::integration_stage(fluid, model_.clock, stage));
        }
        group(label + ", end");
        if (moving() && fluid.integration.stage_time(fluid.integration.stages() - 1) < 1)
            wall_motion(1, "end", nullptr);
        if (model_.walls) add(tasks::wall_contact(fluid, *model_.walls, label));
        if (model_.flux_walls) add(tasks::wall_contact(fluid, *model_.flux_walls, label));
        add(tasks::advance_clock(model_.clock, label));
        add(tasks::examine(fluid, label));
    }

    void lists(const std::string& label) {
        coupling::Interface* interface = model_.interface ? &*model_.interface : nullptr;
        if (model_.flux_walls) {
            add(tasks::neighbour_search(*model_.fluid, *model_.flux_walls, moving(), interface, model_.clock, label));
            return;
        }
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
        if (flux_images()) add(tasks::ghost_gradients(fluid, *flux_images(), name));
        if (first) transport(name);
        add(tasks::fluxes(fluid, name));
        if (fluid.viscosity.dynamic > 0) add(tasks::viscosity(fluid, name));
        if (model_.flux_walls) {
            if (fluid.viscosity.dynamic > 0 && fluid.wall_friction > 0)
                add(tasks::wall_friction(fluid, *model_.flux_walls, name));
            add(tasks::wall_fluxes(fluid, *model_.flux_walls, name));
        }
        if (model_.central_force) add(tasks::central_force(fluid, *model_.central_force, name));
        if (model_.driving_force) add(tasks::driving_force<D>(fluid, *model_.driving_force, name));
    }

    // Energies, where the scene asks for them or the load needs them.
    void ledger(int stage, const std::string& name) {
        if (model_.flux_walls) {
            if (model_.fluid->ledger.kept || !model_.wall_works.empty())
                add(tasks::energy_ledger(*model_.fluid, *model_.flux_walls, model_.wall_works, model_.clock, stage,
                                         name));
            return;
        }
        if (model_.fluid->ledger.kept) add(tasks::energy_ledger(*model_.fluid, model_.clock, stage, name));
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
            if (model_.flux_walls) add(tasks::wall_crowding(fluid, *model_.flux_walls, name));
            add(tasks::shifting(fluid, name));
        }
        if (model_.walls && model_.walls->periodic.any()) add(tasks::ghost_shift(fluid, *model_.walls, name));
        if (flux_images()) add(tasks::ghost_shift(fluid, *flux_images(), name));
    }

    // Walls and ghosts at `fraction` of the present step.
    void boundary(double fraction, const std::string& label) {
        const coupling::Interface* interface = model_.interface ? &*model_.interface : nullptr;
        if ((model_.walls || model_.flux_walls) && (interface || moving())) wall_motion(fraction, label, interface);
        if (model_.flux_walls) add(tasks::wall_gamma(*model_.fluid, *model_.flux_walls, label));
        if (flux_images()) add(tasks::ghost_state(*model_.fluid, *flux_images(), label));
        if (model_.walls) add(tasks::ghost_state(*model_.fluid, *model_.walls, label));
    }

    void loads() requires(D == 2) {
        if (model_.interface->method == coupling::LoadMethod::averaged_pressure) {
            wall_motion(0, "interface", &*model_.interface);
            add(tasks::averaged_loads(*model_.fluid, panels_of(model_), *model_.interface));
            return;
        }
        if (model_.flux_walls) {
            evaluation(0, "interface", false);
            add(tasks::interface_loads(*model_.fluid, *model_.flux_walls, *model_.interface));
            return;
        }
        boundary(0, "interface");
        add(tasks::interface_gradients(*model_.fluid, *model_.interface));
        add(tasks::ghost_gradients(*model_.fluid, *model_.walls, "interface"));
        add(tasks::interface_loads(*model_.fluid, *model_.walls, *model_.interface));
    }

    void solve(tasks::LoadsOf loads_read) requires(D == 2) {
        group("exchange");
        loads();
        add(tasks::newton_solve(solver_of(model_), *model_.interface, model_.clock, loads_read));
    }

    void exchange() requires(D == 2) {
        coupling::Interface& interface = *model_.interface;
        group("exchange");
        if (interface.keeps_energy)
            add(tasks::interface_energy(solver_of(model_), interface, body_work(model_)->ledger.sum.walls));
        add(tasks::exchange(solver_of(model_), interface, model_.clock));
        if (interface.ratio.regulated) add(tasks::regulate_ratio(interface));
    }

    tasks::IteratedParts iterated_parts() requires(D == 2) {
        return {*model_.fluid,
                model_.walls ? &*model_.walls : nullptr,
                model_.flux_walls ? &*model_.flux_walls : nullptr,
                moving(),
                model_.wall_works,
                solver_of(model_),
                *model_.interface,
                model_.clock};
    }

    std::vector<Task> take() { return std::move(tasks_); }

  private:
    // interface: null where only the walls that move by themselves are moved.
    void wall_motion(double fraction, const std::string& label, const coupling::Interface* interface) {
        if (model_.flux_walls)
            add(tasks::wall_motion<D>(*model_.flux_walls, moving(), interface, model_.clock, fraction, label));
        else
            add(tasks::wall_motion<D>(*model_.walls, moving(), interface, model_.clock, fraction, label));
    }
    // Periodic images beside walls of normal fluxes.
    fluid::GhostWalls<D>* flux_images() const {
        return model_.flux_walls && model_.flux_walls->is_periodic() ? &model_.flux_walls->images : nullptr;
    }
    const fluid::MovingWalls<D>* moving() const { return model_.moving.empty() ? nullptr : &model_.moving; }

    Model<D>& model_;
    std::string group_;
    std::vector<Task> tasks_;
};

}  // namespace

template <int D>
CycleListing coupling_cycle(Model<D>& model, const io::CouplingScene& coupling, int p) {
    if (model.structure) return {{}, structural_step(model), {}, false};
    using Algorithm = io::CouplingAlgorithm;
    const bool coupled = model.interface.has_value();
    const bool fixed = coupled && coupling.algorithm != Algorithm::css;
    Listing<D> begin(model), steps(model), end(model);
    const bool iterated = coupled && coupling.algorithm == Algorithm::iterated;

    if (fixed) (iterated ? begin : steps).add(tasks::cycle_step(*model.fluid, model.clock, model.cycle_step, p));
    if constexpr (D == 2)
        if (iterated) {
            begin.add(tasks::begin_iterations(begin.iterated_parts(), model.cycle_start));
            steps.add(tasks::back_to_start(steps.iterated_parts(), model.cycle_start));
        }
    for (int step = 1; step <= p; ++step) {
        const std::string label = "step " + std::to_string(step);
        steps.group(label);
        if (!fixed)
            steps.add(tasks::time_step(*model.fluid, model.clock, coupled ? &model.cycle_step.held : nullptr, step == 1,
                                       label));
        steps.fluid_step(label);
    }
    if constexpr (D == 2)
        if (coupled) {
            const auto loads =
                coupling.algorithm == Algorithm::cps ? tasks::LoadsOf::last_exchange : tasks::LoadsOf::this_cycle;
            steps.solve(loads);
            if (iterated) steps.add(tasks::relaxation(steps.iterated_parts(), model.cycle_start));
            (iterated ? end : steps).exchange();
        }
    return {begin.take(), steps.take(), end.take(), iterated};
}

template <int D>
std::vector<Task> coupling_cycle(Model<D>& model, const io::CouplingScene& coupling) {
    CycleListing cycle = coupling_cycle(model, coupling, model.interface ? model.interface->ratio.p : 1);
    std::vector<Task> all = std::move(cycle.begin);
    for (std::vector<Task>* part : {&cycle.steps, &cycle.end})
        for (Task& task : *part) all.push_back(std::move(task));
    return all;
}

std::vector<Task> first_loads(Model<2>& model) {
    Listing<2> listing(model);
    listing.loads();
    return listing.take();
}

template <int D>
std::vector<Task> first_evaluation(Model<D>& model) {
    if (!model.fluid || !model.fluid->integration.predicts()) return {};
    Listing<D> listing(model);
    listing.lists("start");
    listing.evaluation(0, "start", true);
    listing.ledger(0, "start");
    return listing.take();
}

template std::vector<Task> first_evaluation(Model<2>&);
template std::vector<Task> first_evaluation(Model<3>&);
template CycleListing coupling_cycle(Model<2>&, const io::CouplingScene&, int);
template CycleListing coupling_cycle(Model<3>&, const io::CouplingScene&, int);
template std::vector<Task> coupling_cycle(Model<2>&, const io::CouplingScene&);
template std::vector<Task> coupling_cycle(Model<3>&, const io::CouplingScene&);

}  // namespace aquagraph::engine
