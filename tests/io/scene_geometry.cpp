// Shapes, motions and bodies of water in a scene file: what is wrong is said with its place.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <numbers>
#include <string>

#include "io/scene_reader.hpp"
#include "io/scene_surfaces.hpp"
#include "physics/geometry/shapes.hpp"
#include "scratch.hpp"
#include "stl_writer.hpp"

using namespace aquagraph;
using doctest::Approx;
using test::ScratchFolder;

namespace {

std::string scene_of(int dimension, const std::string& rest) {
    const std::string min = dimension == 2 ? "[-9.0, -9.0]" : "[-9.0, -9.0, -9.0]",
                      max = dimension == 2 ? "[9.0, 9.0]" : "[9.0, 9.0, 9.0]",
                      low = dimension == 2 ? "[0.0, 0.0]" : "[0.0, 0.0, 0.0]",
                      high = dimension == 2 ? "[1.0, 1.0]" : "[1.0, 1.0, 1.0]";
    return "schema_version = 1\n[time]\nend = 1.0\n[domain]\nmin = " + min + "\nmax = " + max +
           "\n[fluid]\nspacing = 0.1\nsound_speed = 20.0\n[[fluid.box]]\nmin = " + low + "\nmax = " + high + "\n" +
           rest;
}
constexpr int first_line = 13;  // of rest

io::Scene read(const std::string& text) {
    static const ScratchFolder folder;  // surfaces are read again when they are made
    auto brick = geometry::box<3>(geometry::Vec<3>(0, 0, 0), geometry::Vec<3>(1, 2, 3), geometry::FluidSide::outside);
    folder.write("brick.stl", test::ascii_stl(brick));
    std::swap(brick.facets[5][0], brick.facets[5][1]);
    folder.write("turned.stl", test::ascii_stl(brick));
    brick.facets.erase(brick.facets.begin() + 5);
    folder.write("hole.stl", test::ascii_stl(brick));
    folder.write("no.stl", "hello");
    folder.write("motion.csv", "time, x, angle[deg]\n0, 0, 0\n1, 0.5, 90\n");
    folder.write("short.csv", "time, x\n0, 0\n0.5, 1\n");
    folder.write("back.csv", "time, x\n0, 0\n0.5, 1\n0.4, 2\n");
    folder.write("words.csv", "time, x\n0, zero\n");
    return io::read_scene(folder.write("scene.toml", text));
}

void refused(int dimension, const std::string& rest, int line, std::string_view message) {
    CAPTURE(rest);
    try {
        read(scene_of(dimension, rest));
        FAIL_CHECK("not refused");
    } catch (const io::SceneError& error) {
        const std::string what = error.what();
        CAPTURE(what);
        REQUIRE(error.complaints().size() == 1);
        CHECK(error.complaints()[0].position.line == first_line + line);
        CHECK(what.find(message) != std::string::npos);
        CHECK(!error.complaints()[0].help.empty());
    }
}

const std::string wall = "[[wall]]\nname = \"w\"\n";

}  // namespace

TEST_CASE("shapes of walls arrive and become surfaces") {
    const auto surface3 = [](const std::string& rest) {
        const io::Scene scene = read(scene_of(3, wall + rest));
        return io::wall_surface<3>(scene.walls[0], scene.fluid->spacing);
    };
    const auto surface2 = [](const std::string& rest) {
        const io::Scene scene = read(scene_of(2, wall + rest));
        return io::wall_surface<2>(scene.walls[0], scene.fluid->spacing);
    };
    CHECK(measure(surface2("[wall.box]\nmin = [0.0, 0.0]\nmax = [2.0, 1.0]\nfluid = \"inside\"\nopen = [\"top\"]")) ==
          Approx(4));
    CHECK(enclosed_volume(surface2("[wall.circle]\ncentre = [0.0, 0.0]\nradius = 2.0\nfluid = \"inside\"")) ==
          Approx(-4 * std::numbers::pi).epsilon(0.01));
    CHECK(enclosed_volume(surface3("[wall.box]\nmin = [0.0, 0.0, 0.0]\nmax = [2.0, 1.0, 3.0]\nfluid = \"outside\"")) ==
          Approx(6));
    CHECK(measure(surface3("[wall.rectangle]\ncorner = [0.0, 0.0, 0.0]\nside_a = [2.0, 0.0, 0.0]\nside_b = [0.0, 3.0, "
                           "0.0]")) == Approx(6));
    CHECK(enclosed_volume(surface3("[wall.extrusion]\npoints = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]\nclosed = "
                                   "true\ncaps = true\naxis = \"y\"\nfrom = 0.0\nto = 4.0")) == Approx(-2));
    CHECK(enclosed_volume(surface3("[wall.sphere]\ncentre = [0.0, 0.0, 0.0]\nradius = 1.0\nfluid = \"outside\"")) ==
          Approx(4.0 / 3 * std::numbers::pi).epsilon(0.01));
    CHECK(enclosed_volume(surface3("[wall.cylinder]\nfrom = [0.0, 0.0, 0.0]\nto = [0.0, 0.0, 2.0]\nradius = "
                                   "1.0\nchord_error = 0.001\nfluid = \"inside\"")) ==
          Approx(-2 * std::numbers::pi).epsilon(0.01));
    const auto brick = surface3(
        "[wall.stl]\nfile = \"brick.stl\"\nscale = 2.0\naxis = [0.0, 0.0, 1.0]\nangle = 1.5707963267948966\n"
        "translate = [1.0, 0.0, 0.0]");
    CHECK(enclosed_volume(brick) == Approx(48));
    CHECK(bounds(brick).first.x() == Approx(-3));
    CHECK(enclosed_volume(surface3("[wall.stl]\nfile = \"brick.stl\"\nfluid = \"inside\"")) == Approx(-6));
    CHECK(surface3("[wall.stl]\nfile = \"hole.stl\"\nclosed = false").facets.size() == 11);
}

TEST_CASE("walls with no shape, two shapes, shapes of the other dimension") {
    refused(2, wall, 0, "the wall has no shape");
    refused(2,
            wall +
                "points = [[0.0, 0.0], [1.0, 0.0]]\n[wall.circle]\ncentre = [0.0, 0.0]\nradius = 1.0\nfluid = "
                "\"inside\"",
            3, "more than one shape: points, circle");
    refused(2, wall + "[wall.stl]\nfile = \"brick.stl\"", 2, "`wall.stl` is for three dimensions");
    refused(3, wall + "[wall.circle]\ncentre = [0.0, 0.0, 0.0]\nradius = 1.0\nfluid = \"inside\"", 2,
            "`wall.circle` is for two dimensions");
    refused(2, wall + "[wall.box]\nmin = [0.0, 0.0]\nmax = [0.0, 1.0]\nfluid = \"inside\"", 2, "max beyond min");
    refused(2, wall + "[wall.box]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nfluid = \"inside\"\nopen = [\"lid\"]", 2,
            "no side \"lid\"");
    refused(2, wall + "[wall.box]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]", 2, "`fluid` is missing");
    refused(3,
            wall +
                "[wall.extrusion]\npoints = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [1.0, -1.0]]\nclosed = true\n"
                "caps = true\naxis = \"z\"\nfrom = 0.0\nto = 1.0",
            2, "crosses or touches itself");
    refused(3, wall + "[wall.rectangle]\ncorner = [0.0, 0.0, 0.0]\nside_a = [1.0, 0.0, 0.0]\nside_b = [2.0, 0.0, 0.0]",
            2, "parallel");
}

TEST_CASE("STL surfaces with defects") {
    refused(3, wall + "[wall.stl]\nfile = \"none.stl\"", 3, "No such file");
    refused(3, wall + "[wall.stl]\nfile = \"no.stl\"", 3, "not an STL file");
    refused(3, wall + "[wall.stl]\nfile = \"hole.stl\"", 3, "the surface is not watertight, at (");
    refused(3, wall + "[wall.stl]\nfile = \"turned.stl\"", 3, "look at opposite sides of the surface, at (");
}

TEST_CASE("motions arrive") {
    const io::Scene scene = read(scene_of(
        2, wall + "points = [[0.0, 0.0], [1.0, 0.0]]\n[wall.motion.rotation]\ncentre = [1.0, 0.0]\namplitude = "
                  "0.5\nperiod = 2.0\nramp = 0.25\n[wall.motion.translation]\nvelocity = [1.0, 2.0]\n"));
    const auto motion = io::rigid_motion<2>(*scene.walls[0].motion, 1);
    const auto state = motion.at(0.5);
    CHECK(state.shift.x() == Approx(1.5));
    CHECK(state.shift.y() == Approx(1.0));
    CHECK(state.rotation(1, 0) == Approx(std::sin(0.5)));
    const io::MotionTable table = io::parse_motion_table("# a comment\ntime; angle[deg]; y\n0 0 1\n\n1, 90, 2\n");
    CHECK(table.time == std::vector<double>{0, 1});
    CHECK(table.angle[1] == Approx(std::numbers::pi / 2));
    CHECK(table.place[1][1] == 2);
    CHECK(table.place[0].empty());
}

TEST_CASE("motions that cannot be") {
    const std::string still = wall + "points = [[0.0, 0.0], [1.0, 0.0]]\n";
    refused(2, still + "[wall.motion]", 3, "nothing moves it");
    refused(2, still + "[wall.motion.translation]\nramp = 1.0", 3, "neither `velocity` nor `amplitude`");
    refused(2, still + "[wall.motion.translation]\nvelocity = [1.0, 0.0]\namplitude = [1.0, 0.0]\nperiod = 1.0", 5,
            "both `velocity` and `amplitude`");
    refused(2, still + "[wall.motion.translation]\namplitude = [1.0, 0.0]", 4, "`frequency` or `period` is missing");
    refused(2, still + "[wall.motion.rotation]\ncentre = [0.0, 0.0]\namplitude = 1.0\nperiod = 1.0\nfrequency = 1.0", 5,
            "both `frequency` and `period`");
    refused(2, still + "[wall.motion]\ntable = \"none.csv\"", 4, "No such file");
    refused(2, still + "[wall.motion]\ntable = \"short.csv\"", 4, "the table ends at 0.5 s, before the end of the run");
    CHECK_NOTHROW(read(scene_of(2, still + "[wall.motion]\ntable = \"short.csv\"\nafter = \"hold\"")));
    refused(2, still + "[wall.motion]\ntable = \"back.csv\"", 4, "line 4: time does not increase");
    refused(2, still + "[wall.motion]\ntable = \"words.csv\"", 4, "line 2: `zero` is not a number");
    refused(2, still + "[wall.motion]\ntable = \"motion.csv\"", 4, "nothing says about which point");
    CHECK_NOTHROW(read(
        scene_of(2, still + "[wall.motion]\ntable = \"motion.csv\"\n[wall.motion.rotation]\ncentre = [0.0, 0.0]")));
    refused(3,
            wall +
                "[wall.stl]\nfile = \"brick.stl\"\n[wall.motion.rotation]\ncentre = [0.0, 0.0, 0.0]\naxis = [0.0, "
                "0.0, 0.0]\nvelocity = 1.0",
            6, "no direction");
}

TEST_CASE("bodies of water that cannot be") {
    refused(2, "[[fluid.polygon]]\npoints = [[2.0, 2.0], [3.0, 3.0], [3.0, 2.0], [2.0, 3.0]]", 1, "cuts through");
    refused(2, "[[fluid.polygon]]\npoints = [[2.0, 2.0], [30.0, 2.0], [3.0, 3.0]]", 0, "out of the domain: in x");
    refused(2, "[[fluid.disc]]\ncentre = [3.0, 3.0]\nradius = 1.0\nlevel = 1.0", 3, "the level 1 m lies below");
    refused(2, "[[fluid.polygon]]\npoints = [[2.0, 2.0], [2e5, 2.0], [2e5, 2e5]]", 0,
            "the lattice around this water has 4e+12 points");
    refused(3, "[[fluid.volume]]\nstl = \"hole.stl\"\ntranslate = [3.0, 3.0, 3.0]", 1, "not watertight");
    refused(3, "[[fluid.disc]]\ncentre = [3.0, 3.0, 3.0]\nradius = 1.0", 0, "`fluid.disc` is for two dimensions");
    const io::Scene scene = read(scene_of(3,
                                          "[[fluid.volume]]\nstl = \"brick.stl\"\ntranslate = [3.0, 3.0, 3.0]\n"
                                          "[[fluid.sphere]]\ncentre = [-3.0, 0.0, 8.0]\nradius = 0.5\nvelocity = "
                                          "[0.0, 0.0, -1.0]"));
    REQUIRE(scene.fluid->regions.size() == 2);
    CHECK(enclosed_volume(io::region_surface<3>(scene.fluid->regions[1], 0.1)) == Approx(6));
    CHECK(io::surface_level(*scene.fluid, 3) == Approx(6));  // the drop does not count
    CHECK(scene.fluid->regions[0].velocity == io::Point(0, 0, -1));
}
