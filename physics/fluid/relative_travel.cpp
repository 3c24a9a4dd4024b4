#include "physics/fluid/relative_travel.hpp"

#include <algorithm>
#include <cmath>

namespace aquagraph::fluid {

namespace {
// What particle i does in a step beside dt v: the shift, which may grow, and what accelerations add (Travel::of_step).
template <int D>
double beside_velocity(const Particles<D>& s, std::size_t i, double dt) {
    double acceleration2 = 0, shift2 = 0;
    for (std::size_t d = 0; d < D; ++d) {
        acceleration2 += s.acceleration[d][i] * s.acceleration[d][i];
        if (s.has_shift) shift2 += s.shift[d][i] * s.shift[d][i];
    }
    return dt * (2 * std::sqrt(shift2) + dt * std::sqrt(acceleration2));
}

template <int D>
double speed(const Particles<D>& s, std::size_t i) {
    double v2 = 0;
    for (std::size_t d = 0; d < D; ++d) v2 += s.v[d][i] * s.v[d][i];
    return std::sqrt(v2);
}
}  // namespace

template <int D>
bool RelativeTravel<D>::holds(const Particles<D>& particles, const ClusterGrid<D>& grid, const NeighbourLists<D>& lists,
                              const Travel& travel, const ComingStep& coming, const NearWalls* walls, BlockLoop loop) {
    const double margin = margin_ratio * lists.radius;
    if (2 * (travel.so_far() + travel.of_step(coming.dt)) >= lists.skin + margin) return false;
    if (walls) {
        if (!near_known_) find_near(particles, lists, *walls, loop);
        if (!walls_hold(particles, lists.skin, coming, *walls, loop)) return false;
    }
    if (!groups_known_) find_groups(grid, lists.reach() + margin, loop);
    return groups_hold(particles, grid, lists.skin, coming.dt, loop);
}

// Near walls are also those that see images, or from whom a wall hides something: round the edge of a step both may be
// further from the wall than they reach.
template <int D>
void RelativeTravel<D>::find_near(const Particles<D>& particles, const NeighbourLists<D>& lists, const NearWalls& walls,
                                  BlockLoop loop) {
    near_.resize(particles.count);
    const std::size_t images = particles.clusters();
    loop(lists.blocks.size(), [&](std::size_t block) {
        const LaneRange lanes = lanes_of_block(particles, block);
        const NeighbourBlock& list = lists.blocks[block];
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            const auto from = list.particle[i - lanes.begin], to = list.particle[i - lanes.begin + 1];
            bool near = from.masked_end < to.masked_end;
            for (std::uint32_t k = from.open_end; k < to.open_end; ++k) near |= list.open[k] >= images;
            near_[i] = near || walls.was_near(i);
        }
    });
    near_known_ = true;
}

// A particle within reach of a wall and an image come closer by at most twice what particles and walls move. One that
// was further away has no image yet: it must not come within R.
template <int D>
bool RelativeTravel<D>::walls_hold(const Particles<D>& particles, double skin, const ComingStep& coming,
                                   const NearWalls& walls, BlockLoop loop) {
    block_holds_.assign(particles.blocks(), 1);
    loop(particles.blocks(), [&](std::size_t block) {
        const LaneRange lanes = lanes_of_block(particles, block);
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            double displacement2 = 0;
            for (std::size_t d = 0; d < D; ++d) {
                const double dx = particles.x[d][i] - particles.x_built[d][i];
                displacement2 += dx * dx;
            }
            const double to_come =
                coming.dt * speed(particles, i) + beside_velocity(particles, i, coming.dt) + coming.walls_moved;
            const double moved = std::sqrt(displacement2) + to_come;
            if (moved < (near_[i] ? 0.5 : 1.0) * skin) continue;
            if (near_[i] || to_come >= skin || walls.may_be_near(i)) {
                block_holds_[block] = 0;
                return;
            }
        }
    });
    return std::all_of(block_holds_.begin(), block_holds_.end(), [](std::uint8_t holds) { return holds != 0; });
}

template <int D>
void RelativeTravel<D>::find_groups(const ClusterGrid<D>& grid, double reach, BlockLoop loop) {
    const std::size_t groups = grid.fluid_entries();
    parts_.resize((groups + groups_per_part - 1) / groups_per_part);
    motions_.resize(groups);
    loop(parts_.size(), [&](std::size_t p) {
        thread_local std::vector<std::uint32_t> near;
        Part& part = parts_[p];
        part.end.clear();
        part.other.clear();
        for (std::size_t k = p * groups_per_part; k < std::min(groups, (p + 1) * groups_per_part); ++k) {
            grid.entries_near(k, reach, near);
            for (const std::uint32_t other : near)
                if (other > k && other < groups) part.other.push_back(other);
            part.end.push_back(std::uint32_t(part.other.size()));
        }
    });
    groups_known_ = true;
}

template <int D>
typename RelativeTravel<D>::Motion RelativeTravel<D>::motion(const Particles<D>& s, LaneRange lanes, double dt) {
    Motion of{};
    const double share = 1 / double(lanes.end - lanes.begin);
    for (std::size_t i = lanes.begin; i < lanes.end; ++i)
        for (std::size_t d = 0; d < D; ++d) of.centre[d] += share * (s.x[d][i] - s.x_built[d][i] + dt * s.v[d][i]);
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        double from_centre2 = 0;
        for (std::size_t d = 0; d < D; ++d) {
            const double dx = s.x[d][i] - s.x_built[d][i] + dt * s.v[d][i] - of.centre[d];
            from_centre2 += dx * dx;
        }
        // A fifth of the speed: at the moment of an impact water outruns the acceleration of the step before
        // (skin_of_step).
        of.radius = std::max(of.radius, std::sqrt(from_centre2) + 0.2 * dt * speed(s, i) + beside_velocity(s, i, dt));
    }
    return of;
}

template <int D>
bool RelativeTravel<D>::groups_hold(const Particles<D>& particles, const ClusterGrid<D>& grid, double skin, double dt,
                                    BlockLoop loop) {
    const std::size_t groups = motions_.size();
    const auto each_part = [&](auto&& work) {
        loop(parts_.size(),
             [&](std::size_t p) { work(parts_[p], p * groups_per_part, std::min(groups, (p + 1) * groups_per_part)); });
    };
    each_part([&](Part&, std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) motions_[k] = motion(particles, grid.entry_lanes(k), dt);
    });
    each_part([&](Part& part, std::size_t begin, std::size_t end) {
        part.holds = false;
        std::uint32_t other = 0;
        for (std::size_t k = begin; k < end; ++k) {
            const Motion own = motions_[k];
            const double room = skin - own.radius;
            if (room <= own.radius) return;
            bool apart = false;
            for (const std::uint32_t last = part.end[k - begin]; other < last; ++other) {
                const Motion& of = motions_[part.other[other]];
                double distance2 = 0;
                for (std::size_t d = 0; d < D; ++d)
                    distance2 += (own.centre[d] - of.centre[d]) * (own.centre[d] - of.centre[d]);
                const double left = room - of.radius;
                apart |= left <= 0 || distance2 >= left * left;
            }
            if (apart) return;
        }
        part.holds = true;
    });
    return std::all_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.holds; });
}

template <int D>
std::size_t RelativeTravel<D>::bytes() const {
    std::size_t sum = bytes_of(near_, block_holds_, motions_);
    for (const Part& part : parts_) sum += bytes_of(part.end, part.other);
    return sum;
}

template class RelativeTravel<2>;
template class RelativeTravel<3>;

}  // namespace aquagraph::fluid
