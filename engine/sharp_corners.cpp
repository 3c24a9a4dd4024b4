#include "engine/sharp_corners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aquagraph::engine {

std::vector<std::string> sharp_corners(const fluid::Panels<2>& panels) {
    std::vector<std::string> found;
    for (const fluid::Joint<2>& joint : panels.joints) {
        const auto a = std::size_t(joint.panel[0]), b = std::size_t(joint.panel[1]);
        const fluid::Vec<2> to = (panels.end(a) - panels.start(a)).normalized();
        const fluid::Vec<2> from = (panels.end(b) - panels.start(b)).normalized();
        const bool filled = (from - to).dot(panels.normal[a]) > 0;  // the water is between the two panels
        const double angle = std::acos(std::clamp(-to.dot(from), -1.0, 1.0)) * 180 / std::numbers::pi;
        if (!filled || angle > sharpest_of_ghosts - 1e-6) continue;
        const fluid::Vec<2> at = panels.end(a);
        const std::string walls = panels.name(a) == panels.name(b)
                                      ? fmt::format("wall '{}'", panels.name(a))
                                      : fmt::format("walls '{}' and '{}'", panels.name(a), panels.name(b));
        found.push_back(
            fmt::format("the corner of {} at ({:g}, {:g}) m is {:.0f}° sharp: below {:g}° ghosts leave a gap in the "
                        "supports of particles at its tip; [fluid] walls = \"normal_flux\" do not",
                        walls, at.x(), at.y(), angle, sharpest_of_ghosts));
    }
    return found;
}

}  // namespace aquagraph::engine
