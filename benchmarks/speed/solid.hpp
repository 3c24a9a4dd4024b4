// Speed of the finite elements, as the text of a section of RESULTS.md.
#pragma once
#include <string>

namespace aquagraph::benchmarks {

std::string solid_tables(int threads);

}  // namespace aquagraph::benchmarks
