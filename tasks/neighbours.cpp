#include "tasks/neighbours.hpp"

#include <cmath>
#include <memory>
#include <type_traits>

#include "physics/fluid/rebuild.hpp"
#include "physics/fluid/travel.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"
#include "tasks/stepping.hpp"

namespace aquagraph::tasks {

namespace {

// Walls: GhostWalls or NormalFluxWalls.
template <int D, class Walls>
class NeighbourSearchTask {
  public:
    NeighbourSearchTask(fluid::Fluid<D>& fluid, Walls* walls, const fluid::MovingWalls<D>* moving,
                        coupling::Interface* interface, const Clock& clock)
        : fluid_(fluid), walls_(walls), moving_(moving), interface_(interface), clock_(clock) {}

    void operator()() {
        const fluid::Travel travel = most_travelled();
        // The lists of the last step allowed for a certain way; how fast particles are now says how far they went.
        fluid::SearchRecord<D>& record = fluid_.record;
        if (fluid::outran(travel, record.step, record.skin)) ++fluid_.outrun;
        if (!lists_hold(travel)) rebuild();
        record.step = clock_.step;
        record.skin = fluid::skin_of_step(travel, clock_.step, walls_travel(), fluid_.lists.radius);
        fluid::prune(fluid_.particles, fluid_.lists, record.skin, parallel_loop);
    }

  private:
    static constexpr bool ghosts = std::is_same_v<Walls, fluid::GhostWalls<D>>;

    fluid::Travel most_travelled() {
        scratch_.resize(fluid_.blocks());
        return reduce_blocks(
            fluid_.blocks(), fluid::Travel{},
            [&](std::size_t block) { return fluid::travel(fluid_.particles, fluid_.lanes(block)); }, fluid::largest,
            std::span<fluid::Travel>(scratch_));
    }

    // How far walls will be from these places during the coming step. Where they will be is known: motions are
    // prescribed or extrapolated from the last exchange.
    double walls_distance(const std::vector<fluid::Vec<D>>& from) const {
        double largest = 0;
        for (const double fraction : {0.0, 0.5, 1.0}) {
            if (moving_)
                largest = std::max(largest, moving_->largest_distance(from, clock_.time + fraction * clock_.step));
            if constexpr (D == 2)
                if (interface_)
                    largest = std::max(
                        largest, interface_->surface.largest_distance(from, clock_.elapsed + fraction * clock_.step));
        }
        return largest;
    }
    double walls_travel() const { return walls_ ? walls_distance(walls_->panels.position) : 0; }

    bool lists_hold(const fluid::Travel& travel) const {
        const std::vector<fluid::Vec<D>>& built = fluid_.record.walls;
        if (!fluid_.record.made) return false;
        double moved = 0;
        if (walls_) {
            double wall2 = 0;
            for (std::size_t k = 0; k < built.size(); ++k)
                wall2 = std::max(wall2, (walls_->panels.position[k] - built[k]).squaredNorm());
            moved = std::max(std::sqrt(wall2), walls_distance(built));
        }
        return fluid::lists_hold(fluid_, walls_, travel, {clock_.step, moved}, parallel_loop);
    }

    void rebuild() {
        auto& particles = fluid_.particles;
        if (walls_) check_walls();
        if (!fluid_.closed) book_loss(fluid_, [&] { fluid_.removed += remove_outside(particles, fluid_.domain); });
        if (moving_) moving_->place(walls_->panels, clock_.time);
        if constexpr (D == 2)
            if (interface_) interface_->surface.place(walls_->panels, clock_.elapsed);
        if constexpr (ghosts)
            rebuild_lists(fluid_, walls_, parallel_loop);
        else
            rebuild_lists(fluid_, *walls_, parallel_loop);
        fluid_.record.made = true;
        if (walls_) fluid_.record.walls = walls_->panels.position;
        if constexpr (D == 2)
            if (interface_) interface_->rebuild(fluid_, *walls_, parallel_loop);
    }

    // A particle deeper behind a wall than half a spacing would no longer be mirrored: it has passed through.
    void check_walls() const {
        const fluid::Escape escape = walls_->deepest(fluid_.particles);
        if (escape.depth < 0.5 * fluid_.spacing) return;
        throw SickParticle({fluid::Ailment::passed_wall, escape.particle},
                           "a particle has passed through wall '" + walls_->panels.name(std::size_t(escape.panel)) +
                               "' and is " + std::to_string(escape.depth / fluid_.spacing) + " spacings behind it");
    }

    fluid::Fluid<D>& fluid_;
    Walls* walls_;
    const fluid::MovingWalls<D>* moving_;
    coupling::Interface* interface_;
    const Clock& clock_;
    std::vector<fluid::Travel> scratch_;
};

template <int D, class Walls>
Task search_task(fluid::Fluid<D>& fluid, Walls* walls, const fluid::MovingWalls<D>* moving,
                 coupling::Interface* interface, const Clock& clock, const std::string& label) {
    // Held by pointer: the graph copies bodies.
    auto search = std::make_shared<NeighbourSearchTask<D, Walls>>(fluid, walls, moving, interface, clock);
    return {.name = "neighbour search (" + label + ")",
            .reads = {resource::clock_step, resource::interface_motion},
            .writes = {resource::fluid, resource::walls},
            .body = [search] { (*search)(); }};
}

}  // namespace

template <int D>
Task neighbour_search(fluid::Fluid<D>& fluid, fluid::GhostWalls<D>* walls, const fluid::MovingWalls<D>* moving,
                      coupling::Interface* interface, const Clock& clock, const std::string& label) {
    return search_task(fluid, walls, moving, interface, clock, label);
}

template <int D>
Task neighbour_search(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const fluid::MovingWalls<D>* moving,
                      coupling::Interface* interface, const Clock& clock, const std::string& label) {
    return search_task(fluid, &walls, moving, interface, clock, label);
}

template Task neighbour_search(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const fluid::MovingWalls<2>*,
                               coupling::Interface*, const Clock&, const std::string&);
template Task neighbour_search(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const fluid::MovingWalls<3>*,
                               coupling::Interface*, const Clock&, const std::string&);
template Task neighbour_search(fluid::Fluid<2>&, fluid::GhostWalls<2>*, const fluid::MovingWalls<2>*,
                               coupling::Interface*, const Clock&, const std::string&);
template Task neighbour_search(fluid::Fluid<3>&, fluid::GhostWalls<3>*, const fluid::MovingWalls<3>*,
                               coupling::Interface*, const Clock&, const std::string&);

}  // namespace aquagraph::tasks
