// Makes the neighbour lists. Two searches give the same lists, entry by entry:
// - cell_grid: clusters are binned by the centre of their bounding box; those whose box lies within reach of another
//   cluster's box are candidates for all of its particles, and only of these the lanes are looked at.
// - tree: nanoflann's k-d tree, asked for every particle's neighbours. Independent of the grid and many times slower
//   (benchmarks/RESULTS.md); for checks.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

enum class SearchMethod { cell_grid, tree };

// Hides lanes from particles near walls. lanes_seen gets W squared distances-in-reach bits and returns those that the
// particle may see.
template <int D>
class PairFilter {
  public:
    virtual ~PairFilter() = default;
    // True if nothing is hidden from particle i: then lanes_seen need not be called for it.
    virtual bool sees_everything(std::size_t i) const = 0;
    virtual std::uint8_t lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const = 0;
};

// Bounding boxes of clusters, binned by their centres into cells that are stored row by row (the last direction).
template <int D>
class ClusterGrid {
  public:
    void build(const Particles<D>& particles, double reach, BlockLoop loop);
    // Clusters with a lane that may lie within reach of a fluid cluster's lanes, ascending, once each.
    void candidates(const Particles<D>& particles, std::size_t cluster, std::vector<std::uint32_t>& found) const;

    // What is binned: clusters, or single particles where a cluster's lie far apart; those of the fluid come first.
    std::size_t fluid_entries() const { return fluid_entries_; }
    LaneRange entry_lanes(std::size_t entry) const { return {entries_[entry].begin, entries_[entry].end}; }
    // Entries whose box was within `reach` of this one's when they were binned, itself included, in any order.
    void entries_near(std::size_t entry, double reach, std::vector<std::uint32_t>& found) const;
    std::size_t bytes() const {
        return bytes_of(cluster_box_, entries_, cell_of_, cell_start_, low_, high_, cluster_, entry_);
    }

  private:
    struct Box {
        double low[D], high[D];
    };
    struct Entry {
        Box box;
        std::uint32_t begin, end;  // lanes
    };
    static Box box_of(const Particles<D>& particles, LaneRange lanes);
    bool is_large(const Box& box) const;
    void choose_cells(std::size_t entries);
    std::int32_t cell_along(int d, double x) const;
    // Appends what[k] of all places k whose box is within reach of this one.
    void collect(const Box& box, double reach, const std::vector<std::uint32_t>& what,
                 std::vector<std::uint32_t>& found) const;

    double reach_ = 0, width_ = 0;
    std::vector<Box> cluster_box_;
    // A cluster whose lanes lie far apart enters as one box per lane.
    std::vector<Entry> entries_;
    std::size_t fluid_entries_ = 0;
    std::array<double, D> origin_{}, end_{}, half_{};  // half_: the largest half extent of an entry
    std::array<std::int32_t, D> cells_{};
    std::vector<std::uint32_t> cell_of_, cell_start_;
    std::array<std::vector<double>, D> low_, high_;  // entries in the order of cells …
    std::vector<std::uint32_t> cluster_, entry_;     // … and which they are
};

template <int D>
class NeighbourSearch {
  public:
    SearchMethod method = SearchMethod::cell_grid;
    // Fills lists.blocks and takes back any pruning. `filter` may be null. Positions must be finite.
    void build(const Particles<D>& particles, NeighbourLists<D>& lists, const PairFilter<D>* filter, BlockLoop loop);
    // As the last build has left it.
    const ClusterGrid<D>& grid() const { return grid_; }
    std::size_t bytes() const { return grid_.bytes(); }

  private:
    ClusterGrid<D> grid_;
};

// The search by nanoflann's tree (neighbour_tree.cpp).
template <int D>
void build_with_tree(const Particles<D>& particles, NeighbourLists<D>& lists, const PairFilter<D>* filter,
                     BlockLoop loop);

// Both searches: the entries of one particle, its candidates given in ascending order.
template <int D>
void append_entries(const Particles<D>& particles, const NeighbourLists<D>& lists, const PairFilter<D>* filter,
                    std::size_t i, const std::vector<std::uint32_t>& candidates, NeighbourBlock& out);

extern template class NeighbourSearch<2>;
extern template class NeighbourSearch<3>;

}  // namespace aquagraph::fluid
