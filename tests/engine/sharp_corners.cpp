// Corners that ghosts do not fill are named with their place.
#include "engine/sharp_corners.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace aquagraph;

namespace {

// Walls through (1, 2) that the water fills to `degrees`, or stands out into it.
std::vector<std::string> said(double degrees, bool stands_out) {
    const double angle = degrees * 3.14159265358979 / 180;
    const fluid::Vec<2> tip(1, 2), along(1, 0), up(std::cos(angle), std::sin(angle));
    fluid::Panels<2> panels;
    if (stands_out)
        panels.add_wall("wedge", {tip + along, tip, tip + up}, false, false);
    else
        panels.add_wall("wedge", {tip + up, tip, tip + along}, false, false);
    panels.update_geometry();
    panels.find_joints();
    return engine::sharp_corners(panels);
}

}  // namespace

TEST_CASE("corners of ghosts that water fills to less than 60 degrees are named with wall and place") {
    for (const double degrees : {20.0, 45.0, 59.0}) {
        const auto found = said(degrees, false);
        REQUIRE(found.size() == 1);
        CHECK(found[0].find("wall 'wedge' at (1, 2) m is " + std::to_string(int(degrees)) + "° sharp") !=
              std::string::npos);
        CHECK(said(degrees, true).empty());
    }
    for (const double degrees : {60.0, 90.0, 150.0}) CHECK(said(degrees, false).empty());
}
