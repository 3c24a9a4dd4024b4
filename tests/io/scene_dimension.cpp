// Two or three coordinates: domain.min decides, and everything else must agree.
#include <doctest/doctest.h>

#include <string>

#include "io/scene_reader.hpp"
#include "tests/io/scratch.hpp"
#include "tests/text.hpp"

using namespace aquagraph;
using test::with;

namespace {

const std::string tank = R"(schema_version = 1
[time]
end = 1.0
[domain]
min = [-1.0, -1.0, -1.0]
max = [2.0, 2.0, 2.0]
[fluid]
spacing = 0.1
sound_speed = 20.0
[[fluid.box]]
min = [0.0, 0.0, 0.0]
max = [1.0, 0.5, 0.4]
[[wall]]
name = "floor"
points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.5, 0.0], [0.0, 0.5, 0.0]]
)";

io::Scene read(const std::string& text) {
    test::ScratchFolder folder;
    return io::read_scene(folder.write("scene.toml", text));
}

// The only complaint about `tank` with one thing changed.
void expect(std::string_view old, std::string_view replacement, int line, int column, std::string_view message,
            std::string_view help) {
    CAPTURE(replacement);
    try {
        read(with(tank, old, replacement));
    } catch (const io::SceneError& error) {
        CAPTURE(error.what());
        REQUIRE(error.complaints().size() == 1);
        const io::SceneComplaint& complaint = error.complaints().front();
        CHECK(complaint.position.line == line);
        CHECK(complaint.position.column == column);
        CHECK(complaint.message.find(message) != std::string::npos);
        CHECK(complaint.help.find(help) != std::string::npos);
        return;
    }
    FAIL_CHECK("not refused");
}

}  // namespace

TEST_CASE("a scene is of the dimension of its domain") {
    const io::Scene scene = read(tank);
    CHECK(scene.dimension == 3);
    CHECK(scene.gravity == io::Point{0, 0, -9.81});
    CHECK(scene.domain.max == io::Point{2, 2, 2});
    CHECK(scene.fluid->boxes[0].max == io::Point{1, 0.5, 0.4});
    CHECK(scene.walls[0].points[2] == io::Point{1, 0.5, 0});
    CHECK(read(with(tank, "[time]", "gravity = [1.0, 2.0, 3.0]\n[time]")).gravity == io::Point{1, 2, 3});
}

TEST_CASE("points of another length are refused with their place") {
    expect("min = [0.0, 0.0, 0.0]", "min = [0.0, 0.0]", 11, 7, "a point of 2 coordinates in a scene of 3 dimensions",
           "[x, y, z]");
    expect("max = [2.0, 2.0, 2.0]", "max = [2.0, 2.0]", 6, 7, "a point of 2 coordinates", "`min` of [domain] has 3");
    expect("[1.0, 0.5, 0.0]", "[1.0, 0.5]", 15, 45, "a point of 2 coordinates in a scene of 3 dimensions: [1, 0.5]",
           "every point");
    expect("[time]", "gravity = [0.0, -9.81]\n[time]", 2, 11, "a point of 2 coordinates", "[x, y, z]");
    expect("min = [0.0, 0.0, 0.0]", "min = [0.0, 0.0, 0.0, 0.0]", 11, 7, "it is a list of 4", "");
    expect("min = [0.0, 0.0, 0.0]", "min = [0.0, 0.0, nan]", 11, 18, "must be a finite number", "");
}

TEST_CASE("boxes in space are looked at in every direction") {
    expect("max = [1.0, 0.5, 0.4]", "max = [1.0, 0.5, -0.4]", 12, 7, "but in z it is -0.4", "");
    expect("max = [1.0, 0.5, 0.4]", "max = [1.0, 0.05, 0.4]", 12, 7, "0.05 m deep, less than one spacing", "Δx");
    expect("max = [1.0, 0.5, 0.4]", "max = [1.0, 0.5, 2.4]", 10, 1,
           "reaches out of the domain [-1, -1, -1] – [2, 2, 2]", "");
    expect("[[wall]]", "[[fluid.box]]\nmin = [0.5, 0.2, 0.3]\nmax = [1.5, 0.6, 0.9]\n[[wall]]", 13, 1,
           "water box 2 overlaps water box 1 in [0.5, 0.2, 0.3] – [1, 0.5, 0.4]", "share");
    CHECK_NOTHROW(
        read(with(tank, "[[wall]]", "[[fluid.box]]\nmin = [0.5, 0.2, 0.4]\nmax = [1.5, 0.6, 0.9]\n[[wall]]")));
}

TEST_CASE("what only makes sense in the plane is refused in space") {
    expect("points =", "closed = true\npoints =", 15, 10, "a face is always closed", "take it out");
    expect("[1.0, 0.0, 0.0], [1.0, 0.5, 0.0], [0.0, 0.5, 0.0]", "[1.0, 0.0, 0.0]", 15, 10,
           "a wall needs at least 3 points", "counter-clockwise");
    expect("[[wall]]",
           "[solid]\nwet = [\"left\"]\n[solid.box]\nmin = [1, 0, 0]\nmax = [2, 1, 1]\nelements = [1, 1, "
           "1]\n[solid.material]\ndensity = 1\nyoungs_modulus = 1\npoissons_ratio = "
           "0\n[[wall]]",
           13, 1, "in three dimensions a solid is not coupled with water yet", "take [solid]");
}
