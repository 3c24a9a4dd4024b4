// Speed of whole steps, as the text of a section of RESULTS.md.
#pragma once
#include <string>

namespace aquagraph::benchmarks {

std::string step_tables(int threads);

}  // namespace aquagraph::benchmarks
