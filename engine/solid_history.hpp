// Columns of history.csv about the solid.
#pragma once
#include <string>
#include <vector>

#include "engine/history_parts.hpp"

namespace aquagraph::engine {

// What a plane model has per metre of depth.
template <int D>
std::string per_depth(const std::string& unit) {
    return D == 2 ? unit + "/m" : unit;
}

// Where it is and what holds it: tracks, forces on clamps and moved nodes, rigid bodies, contacts.
template <int D>
std::vector<HistoryPart> solid_columns(const io::Scene& scene, const solid::Solver<D>& solid);

// Its energies. interface: where energies across it are kept; null otherwise.
template <int D>
HistoryPart solid_energies(const Model<D>& model, const coupling::Interface* interface);

}  // namespace aquagraph::engine
