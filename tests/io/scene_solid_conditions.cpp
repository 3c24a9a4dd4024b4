// What moves, presses and reinforces a solid: read as it is said, and every slip reported with its remedy.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "io/scene_json.hpp"
#include "io/scene_reader.hpp"
#include "io/scene_time_law.hpp"
#include "tests/io/refusal.hpp"
#include "tests/text.hpp"

using namespace aquagraph;
using test::refusal;
using test::ScratchFolder;
using test::with;

namespace {

const std::string sound = R"(schema_version = 1
[time]
end = 1.0
[domain]
min = [0.0, 0.0]
max = [1.0, 1.0]
[solid]
[solid.box]
min = [0.0, 0.0]
max = [1.0, 0.5]
elements = [2, 1]
[solid.material]
density = 1100.0
youngs_modulus = 1e6
poissons_ratio = 0.4
[solid.scheme]
step = 0.1
)";

io::Scene read(const std::string& more) {
    ScratchFolder folder;
    return io::read_scene(folder.write("scene.toml", sound + more));
}

std::string in_space(const std::string& text) {
    return with(with(text, "min = [0.0, 0.0]\nmax = [1.0, 1.0]", "min = [0.0, 0.0, 0.0]\nmax = [1.0, 1.0, 1.0]"),
                "min = [0.0, 0.0]\nmax = [1.0, 0.5]\nelements = [2, 1]",
                "min = [0.0, 0.0, 0.0]\nmax = [1.0, 0.5, 0.1]\nelements = [2, 1, 1]");
}

void refused(const std::string& more, const std::string& message, const std::string& help, bool three = false) {
    const std::string error = refusal((three ? in_space(sound) : sound) + more);
    CAPTURE(error);
    CHECK(error.find(message) != std::string::npos);
    CHECK(error.find(help) != std::string::npos);
}

}  // namespace

TEST_CASE("a law of time adds up what is given") {
    const io::Scene scene = read(R"([[solid.motion]]
set = "left"
along = "y"
value = 0.5
rate = 2.0
amplitude = 0.1
period = 0.5
phase = 0.3
points = [[0.0, 1.0], [1.0, 3.0]]
)");
    const TimeFunction law = io::time_function(scene.solid->motions.at(0).law);
    for (const double t : {0.0, 0.3, 0.8}) {
        const double swing = 0.1 * (std::sin(2 * M_PI * t / 0.5 + 0.3) - std::sin(0.3));
        CHECK(law.at(t).value == doctest::Approx(0.5 + 2 * t + swing + 1 + 2 * t));
    }
    CHECK(scene.solid->motions[0].along == 1);
    CHECK(io::to_json(scene)["solid"]["motion"][0]["points"][1][1] == 3.0);
}

TEST_CASE("a table beside the scene is read as points are") {
    ScratchFolder folder;
    folder.write("push.csv", "time[s],u[m]\n0,0\n0.5,0.1\n1,0\n");
    const std::string motion = "[[solid.motion]]\nset = \"left\"\nalong = \"x\"\n";
    const io::Scene table = io::read_scene(folder.write("a.toml", sound + motion + "table = \"push.csv\"\n")),
                    points = io::read_scene(
                        folder.write("b.toml", sound + motion + "points = [[0, 0], [0.5, 0.1], [1, 0]]\n"));
    const TimeFunction a = io::time_function(table.solid->motions[0].law),
                       b = io::time_function(points.solid->motions[0].law);
    for (const double t : {0.0, 0.2, 0.5, 0.9}) CHECK(a.at(t).value == b.at(t).value);
}

TEST_CASE("slips in a law of time") {
    const std::string motion = "[[solid.motion]]\nset = \"left\"\nalong = \"x\"\n";
    refused(motion, "nothing says how large this is", "give value, rate");
    refused(motion + "amplitude = 1\n", "`frequency` or `period` of the swing is missing", "give one");
    refused(motion + "amplitude = 1\nfrequency = 2\nperiod = 3\n", "both `frequency` and `period`", "give one");
    refused(motion + "value = 1\nfrequency = 2\n", "`frequency` belongs to a swing", "take it out");
    refused(motion + "value = 1\nramp = 2\n", "`ramp` is for `rate` and `amplitude`", "grows smoothly");
    refused(motion + "points = [[0, 1], [0, 2]]\n", "cannot be used", "increasing time");
    refused(motion + "points = [[0, 1, 2]]\n", "`points` must be a list of pairs", "");
    refused(motion + "table = \"nothing.csv\"\n", "cannot be used", "rows of two columns");
    refused(motion + "points = [[0, 0], [1, 1]]\ntable = \"nothing.csv\"\n", "both `points` and a `table`",
            "one of them");
}

TEST_CASE("slips in motions, pressures and rigid bodies") {
    refused("[[solid.motion]]\nset = \"lft\"\nalong = \"x\"\nvalue = 0\n", "the box has no node set \"lft\"",
            "did you mean \"left\"?");
    refused("[[solid.motion]]\nset = \"left\"\nalong = \"z\"\nvalue = 0\n", "there is no z", "x or y");
    refused("[[solid.pressure]]\nsurface = \"inside\"\nvalue = 1\n", "the box has no surface \"inside\"",
            "a box has left");
    const std::string rim = "[[solid.rigid_body]]\nname = \"rim\"\nset = \"left\"\n";
    refused(rim + "inertia = [1, 2, 3]\n", "3 moments of inertia in a scene of 2 dimensions", "inertia = [J]");
    const auto motion = [&](const std::string& body, const std::string& freedom) {
        return rim + "[[solid.rigid_motion]]\nbody = \"" + body + "\"\nfreedom = \"" + freedom + "\"\nvalue = 0\n";
    };
    refused(motion("rin", "x"), "there is no rigid body \"rin\"", "did you mean \"rim\"?");
    refused(motion("rim", "turn_z"), "a body in two dimensions has no such freedom", "x, y or turn");
    refused(motion("rim", "turn"), "a body in three dimensions has no such freedom", "turn_x", true);
    refused(motion("rim", "x") + "[[solid.rigid_motion]]\nbody = \"rim\"\nfreedom = \"x\"\nrate = 1\n",
            "prescribed twice", "adds up");
    refused(motion("rim", "x") + "[[solid.rigid_load]]\nbody = \"rim\"\nfreedom = \"x\"\nrate = 1\n",
            "a load on it would do nothing", "take the load out");
    refused(rim + rim, "the name \"rim\" is already taken", "choose another");
}

TEST_CASE("slips in contacts") {
    const std::string ground = "[[solid.contact]]\nname = \"road\"\nsurface = \"bottom\"\npoint = [0, 0]\n";
    refused(ground, "`normal` of the ground is missing", "a plane has point and normal");
    refused(ground + "normal = [0, 0]\n", "no direction", "looks up");
    refused(ground + "normal = [0, 1]\nradius = 1\n", "`radius` does not belong", "take it out");
    refused(ground + "shape = \"cylinder\"\n", "`radius` of the ground is missing", "a cylinder point, radius");
    refused(ground + "shape = \"cylinder\"\nradius = 1\naxis = [1, 0]\n", "`axis` does not belong", "take it out");
    refused(ground + "normal = [0, 1]\nfriction = -1\n", "`friction` must be ≥ 0", "Coulomb");
    refused(ground + "normal = [0, 1]\n[[solid.ground_motion]]\ncontact = \"raod\"\nalong = \"y\"\nvalue = 1\n",
            "there is no contact \"raod\"", "did you mean \"road\"?");
    refused("[[solid.ground_motion]]\ncontact = \"road\"\nalong = \"y\"\nvalue = 1\n", "there is no contact",
            "add a [[solid.contact]]");
}

TEST_CASE("slips in cords, damping and the explicit scheme") {
    const std::string cords =
        "[[solid.cords]]\nmodulus = 1e9\nsection = 1e-6\nspacing = 1e-3\nthickness = 1e-3\nangles = [0.3]\n";
    refused(cords, "cords are there in three dimensions", "take them out");
    refused(cords, "has the law neo_hookean or mooney_rivlin", "choose one", true);
    refused(cords + "set = \"belt\"\n", "no [[solid.part]] with the set \"belt\"", "cords need a rubber", true);
    refused(cords + "axis = [0, 1, 0]\nalong = [1, 0, 0]\n", "takes no `along`", "take it out", true);
    refused(cords + "axis_point = [0, 1, 0]\n", "there is no `axis`", "give it", true);
    refused(cords + cords, "this material has cords twice", "two families", true);
    refused("[solid.damping]\nmass = -1\n", "`mass` must be ≥ 0", "α");
    const auto scheme = [](const std::string& keys) { return refusal(with(sound, "step = 0.1\n", keys)); };
    CHECK(scheme("name = \"central_difference\"\n").empty());
    CHECK(scheme("name = \"central_difference\"\nalpha = -0.1\n").find("have no αs") != std::string::npos);
    CHECK(scheme("name = \"static\"\n[solid.damping]\nmass = 1\n").find("does nothing in a static run") !=
          std::string::npos);
}

TEST_CASE("a wheel in words comes out as it was said") {
    ScratchFolder folder;
    const io::Scene scene = io::read_scene(folder.write("scene.toml", in_space(sound) + R"([[solid.rigid_body]]
name = "rim"
set = "left"
point = [0.0, 0.2, 0.0]
mass = 3.0
inertia = [1.0, 2.0, 3.0]
[[solid.rigid_motion]]
body = "rim"
freedom = "turn_y"
rate = 4.0
ramp = 0.1
[[solid.rigid_load]]
body = "rim"
freedom = "z"
value = -500.0
[[solid.contact]]
name = "road"
surface = "bottom"
shape = "cylinder"
point = [0.0, 0.0, -2.0]
axis = [0.0, 1.0, 0.0]
radius = 1.5
friction = 0.7
[[solid.pressure]]
surface = "right"
value = 2.2e5
)"));
    const io::SolidScene& solid = *scene.solid;
    CHECK(solid.rigid_bodies.at(0).inertia == std::vector<double>{1, 2, 3});
    CHECK(solid.rigid_motions.at(0).freedom == 4);
    CHECK(solid.rigid_loads.at(0).freedom == 2);
    CHECK(solid.contacts.at(0).shape == solid::GroundShape::cylinder);
    CHECK((*solid.contacts[0].direction)[1] == 1);
    const auto json = io::to_json(scene)["solid"];
    CHECK(json["rigid_motion"][0]["freedom"] == "turn_y");
    CHECK(json["contact"][0]["axis"][1] == 1.0);
    CHECK(json["pressure"][0]["value"] == 2.2e5);
}
