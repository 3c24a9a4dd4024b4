// The order of the particles in memory: columns of about sqrt(W) Δx (2D) or (2Δx)² (3D), each sorted along the last
// direction, every second one backwards, so that W consecutive particles always form a compact cluster. A full sort of
// space into halves of halves makes them no more compact (lanes per pair within 3 %) at four times the time.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

// order[k] = present index of the particle that goes to place k. The same for any number of threads.
template <int D>
class SpatialOrder {
  public:
    // Positions x of the first n lanes; `spacing` is the typical distance between particles.
    std::span<const std::uint32_t> sort(const Vectors<D>& x, std::size_t n, double spacing,
                                        BlockLoop loop = serial_loop);
    std::size_t bytes() const { return bytes_of(order_, column_start_, column_of_, places_); }

  private:
    struct Place {
        double height;
        std::uint32_t particle;
    };
    std::vector<std::uint32_t> order_, column_start_, column_of_;
    std::vector<Place> places_;
};

// Applies an order to everything a fluid particle carries (positions, velocities, deviation, mass, id).
template <int D>
class Reorder {
  public:
    void apply(Particles<D>& particles, std::span<const std::uint32_t> order, BlockLoop loop = serial_loop);
    std::size_t bytes() const {
        std::size_t sum = bytes_of(id_buffer_);
        for (const Scalars& buffer : buffers_) sum += bytes_of(buffer);
        return sum;
    }

  private:
    std::vector<Scalars*> fields_;
    std::vector<Scalars> buffers_;
    AlignedVector<std::int64_t> id_buffer_;
};

extern template class SpatialOrder<2>;
extern template class SpatialOrder<3>;
extern template class Reorder<2>;
extern template class Reorder<3>;

}  // namespace aquagraph::fluid
