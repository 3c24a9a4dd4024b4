// A particle behind a wall.
#pragma once
#include <cstddef>

namespace aquagraph::fluid {

struct Escape {
    std::size_t particle = 0;  // the one furthest behind a wall that it belongs in front of
    double depth = 0;          // how far behind [m]; 0: none is
    int panel = -1;
};

}  // namespace aquagraph::fluid
