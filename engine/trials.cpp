#include "engine/trials.hpp"

#include <exception>

#include "physics/solid/structure.hpp"
#include "tasks/stepping.hpp"
#include "tasks/task_error.hpp"

namespace aquagraph::engine {

namespace {

bool may_come_of_the_guess(const tasks::TaskError& error) {
    try {
        std::rethrow_exception(error.cause());
    } catch (const tasks::SickParticle&) {
        return true;
    } catch (const solid::ConvergenceError&) {
        return true;
    } catch (...) {
        return false;
    }
}

}  // namespace

void run_trials(coupling::Interface& interface, const Clock& clock, const std::function<void()>& trial) {
    coupling::FixedPoint& fixed_point = interface.fixed_point;
    do {
        try {
            trial();
        } catch (const tasks::TaskError& error) {
            if (!may_come_of_the_guess(error) || !fixed_point.retreat()) throw;
            interface.surface.head_for(fixed_point.guess(), clock.cycle);
        }
    } while (!fixed_point.finished());
}

}  // namespace aquagraph::engine
