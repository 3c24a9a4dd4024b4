// What the neighbour search remembers from one step to the next: whether the lists still hold depends on it.
#pragma once
#include <vector>

#include "physics/fluid/neighbour_lists.hpp"
#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::fluid {

template <int D>
struct SearchRecord {
    bool made = false;          // the lists are a search's: those from before the run do not say where walls stood
    std::vector<Vec<D>> walls;  // vertices of walls when the lists were made [m]
    double step = 0;            // Δt that the last search allowed for [s] …
    StepSkin skin = 0;          // … and the skin of its pruned lists

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(made, walls, step, skin);
    }
};

}  // namespace aquagraph::fluid
