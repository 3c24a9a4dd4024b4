#include "io/scene_solid_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/suggestion.hpp"

namespace aquagraph::io {

void validate_set(const Scene& scene, const std::string& key, const std::string& set, std::string_view what,
                  Complaints& complaints) {
    std::vector<std::string> sets{"left", "right", "bottom", "top"};
    if (scene.dimension == 3) sets.insert(sets.end(), {"front", "back"});
    if (!scene.solid->box || complaints.touch(key) || std::find(sets.begin(), sets.end(), set) != sets.end()) return;
    const auto guess = nearest(set, sets);
    complaints.add(key, fmt::format("the box has no {} \"{}\"", what, set),
                   guess                  ? fmt::format("did you mean \"{}\"?", *guess)
                   : scene.dimension == 2 ? "a box has left, right, bottom and top"
                                          : "a box has left, right, front, back, bottom and top");
}

}  // namespace aquagraph::io
