// What the particles of a fluid without mirror images see past walls: two particles, or a particle and the periodic
// image of one, whose segment crosses a panel are apart.
// Particles that have slid behind a panel by less than a tolerance are taken to be just in front of it.
#pragma once
#include <vector>

#include "physics/fluid/neighbour_search.hpp"
#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::fluid {

// Things near a place: a grid whose cells are as wide as `reach`, so that what lies within reach of x is in the cells
// around it.
template <int D>
class Bins {
  public:
    using Index = std::array<int, D>;
    // Lays the grid over [low, high].
    void lay(const Vec<D>& low, const Vec<D>& high, double width);
    // Number of the cell at x, or -1 outside.
    int at(const Vec<D>& x) const;
    Index index(const Vec<D>& x) const;  // clamped to the grid
    int number(const Index& index) const;
    Vec<D> centre(const Index& index) const;
    std::size_t size() const;
    double width() const { return 1 / inverse_width_; }

    // Calls f(number) for every cell from low to high.
    template <class F>
    void each(const Index& low, const Index& high, F&& f) const {
        Index cell = low;
        while (true) {
            f(cell);
            int d = 0;
            while (d < D && cell[std::size_t(d)] == high[std::size_t(d)]) {
                cell[std::size_t(d)] = low[std::size_t(d)];
                ++d;
            }
            if (d == D) return;
            ++cell[std::size_t(d)];
        }
    }

  private:
    Vec<D> origin_ = Vec<D>::Zero();
    double inverse_width_ = 1;
    Index n_{};
};

template <int D>
class Sight : public PairFilter<D> {
  public:
    // For the particles as they stand; the arguments must outlive the last call of lanes_seen.
    void prepare(const Particles<D>& particles, const Panels<D>& panels, double reach, double tolerance);

    bool sees_everything(std::size_t i) const override { return !cell_[i] || cell_[i]->open; }
    std::uint8_t lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const override;

    bool near_wall(std::size_t i) const { return cell_[i] != nullptr; }
    // Where particle i is taken to be.
    const Vec<D>& place(std::size_t i) const { return place_[i]; }
    // True if no panel near particle i lies between its place and x.
    bool sees(std::size_t i, const Vec<D>& x) const;
    // Panels within reach of the cell of particle i.
    const std::vector<int>& panels_near(std::size_t i) const { return cell_[i]->panel; }

  private:
    struct Cell {
        std::vector<int> panel;
        bool open;  // every panel has all the others in front of it or in its own plane: nothing hides anything
    };
    const Panels<D>* panels_ = nullptr;
    Bins<D> bins_;
    std::vector<int> of_bin_;  // index into cells_, or -1
    std::vector<Cell> cells_;  // the first used_ of them; the others keep their memory
    std::size_t used_ = 0;
    std::vector<Vec<D>> place_;      // of all lanes in use, images too
    std::vector<const Cell*> cell_;  // of each particle
};

extern template class Bins<2>;
extern template class Bins<3>;
extern template class Sight<2>;
extern template class Sight<3>;

}  // namespace aquagraph::fluid
