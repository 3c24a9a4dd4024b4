// What ccx has printed into a .dat file: the last displacements and velocities of all nodes.
#pragma once
#include <istream>
#include <stdexcept>
#include <vector>

namespace aquagraph::engine {

class CalculixResultsError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct CalculixResults {
    std::vector<double> displacements, velocities;  // D × nodes [m], [m/s]
};

// Throws CalculixResultsError where a node is missing or a number is none, saying which.
template <int D>
CalculixResults read_calculix_results(std::istream& dat, std::size_t nodes);

}  // namespace aquagraph::engine
