// Speed of the finite elements, as the text of sections of RESULTS.md.
#pragma once
#include <string>

namespace aquagraph::benchmarks {

std::string solid_tables(int threads);

// The linear solvers on 2.7·10⁵ unknowns in 3D: twenty minutes on two cores.
std::string large_solid_table(int threads);

}  // namespace aquagraph::benchmarks
