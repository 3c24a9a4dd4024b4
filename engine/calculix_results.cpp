#include "engine/calculix_results.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace aquagraph::engine {

namespace {

// A node's number and three components; Fortran prints stars and NaN where a number is none.
bool read_row(const std::string& line, std::size_t& node, std::array<double, 3>& value) {
    const char* at = line.c_str();
    char* end = nullptr;
    const long number = std::strtol(at, &end, 10);
    if (end == at || number < 1) return false;
    node = std::size_t(number);
    for (double& x : value) {
        at = end;
        x = std::strtod(at, &end);
        if (end == at) x = std::numeric_limits<double>::quiet_NaN();
    }
    return true;
}

}  // namespace

template <int D>
CalculixResults read_calculix_results(std::istream& dat, std::size_t nodes) {
    CalculixResults results;
    std::vector<double>* block = nullptr;
    for (std::string line; std::getline(dat, line);) {
        const std::size_t text = line.find_first_not_of(' ');
        if (text == std::string::npos) continue;
        if (line.compare(text, 13, "displacements") == 0 || line.compare(text, 10, "velocities") == 0) {
            block = line[text] == 'd' ? &results.displacements : &results.velocities;
            block->assign(D * nodes, std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        std::size_t node = 0;
        std::array<double, 3> value{};
        if (!read_row(line, node, value)) {
            block = nullptr;  // another table
        } else if (block) {
            if (node > nodes)
                throw CalculixResultsError("there is a node " + std::to_string(node) + ", the mesh has " +
                                           std::to_string(nodes));
            for (std::size_t d = 0; d < D; ++d) (*block)[D * (node - 1) + d] = value[d];
        }
    }
    for (const std::vector<double>* part : {&results.displacements, &results.velocities}) {
        const std::string what = part == &results.displacements ? "displacement" : "velocity";
        if (part->empty()) throw CalculixResultsError("there is no " + what + " of any node");
        for (std::size_t f = 0; f < part->size(); ++f)
            if (!std::isfinite((*part)[f]))
                throw CalculixResultsError("the " + what + " of node " + std::to_string(f / D + 1) +
                                           " is missing or no number");
    }
    return results;
}

template CalculixResults read_calculix_results<2>(std::istream&, std::size_t);
template CalculixResults read_calculix_results<3>(std::istream&, std::size_t);

}  // namespace aquagraph::engine
