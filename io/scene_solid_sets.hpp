// Sets of nodes and surfaces that a scene names.
#pragma once
#include <string>
#include <string_view>

#include "io/complaints.hpp"
#include "io/scene.hpp"

namespace aquagraph::io {

// Complains where a box has no such set. (The sets of a mesh are only known once it is read.) what: "node set"
void validate_set(const Scene& scene, const std::string& key, const std::string& set, std::string_view what,
                  Complaints& complaints);

}  // namespace aquagraph::io
