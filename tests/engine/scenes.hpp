// Small scenes that the tests of the engine, of the coupling and of the program share, written as a user would write
// them.
#pragma once
#include <string>

#include "tests/io/refusal.hpp"
#include "tests/text.hpp"

namespace aquagraph::test {

// The benchmark's gate with 560 particles: 20 ms are about a hundred steps. A load computed beforehand is stable while
// the water's impedance turns the gate round slowly, ρ c Δt < mass per area, Δt being that of a cycle; with particles
// as coarse as these rubber is too light for that, so the gate is heavy.
inline const std::string gate = R"(schema_version = 1
title = "Gate"
[time]
end = 0.02
[domain]
min = [-0.02, -0.02]
max = [0.5, 0.3]
edge = "open"
[fluid]
spacing = 0.005
sound_speed = 30.0
[[fluid.box]]
min = [0.0, 0.0]
max = [0.1, 0.14]
[[wall]]
name = "tank"
points = [[0.0, 0.2], [0.0, 0.0], [0.6, 0.0]]
[[wall]]
name = "lip"
points = [[0.1, 0.079], [0.1, 0.2]]
[solid]
name = "gate"
wet = ["left", "bottom", "right"]
[solid.box]
min = [0.1, 0.0]
max = [0.105, 0.079]
elements = [1, 10]
[solid.material]
law = "neo_hookean"
density = 8000.0
youngs_modulus = 8.0e6
poissons_ratio = 0.49
[solid.scheme]
name = "newmark"
[[solid.clamp]]
set = "top"
[[solid.track]]
name = "tip"
point = [0.1, 0.0]
[coupling]
algorithm = "cps"
ratio = 1
[output]
frame_interval = 0.005
history_interval = 0.001
)";

// Two metres of water on an elastic floor, 200 particles.
inline const std::string plate = R"(schema_version = 1
title = "Plate"
[time]
end = 0.1
[domain]
min = [-0.5, -0.5]
max = [1.5, 2.5]
[fluid]
spacing = 0.1
sound_speed = 50.0
[[fluid.box]]
min = [0.0, 0.0]
max = [1.0, 2.0]
[[wall]]
name = "left_side"
points = [[0.0, 2.2], [0.0, 0.0]]
[[wall]]
name = "right_side"
points = [[1.0, 0.0], [1.0, 2.2]]
[solid]
name = "plate"
static_start = true
wet = ["top"]
[solid.box]
min = [0.0, -0.05]
max = [1.0, 0.0]
elements = [20, 2]
[solid.material]
density = 2700.0
youngs_modulus = 67.5e9
poissons_ratio = 0.34
[[solid.clamp]]
set = "left"
[[solid.clamp]]
set = "right"
[[solid.track]]
name = "mid"
point = [0.5, -0.025]
[output]
frame_interval = 0.02
)";

// A column of water let go in a tank: no solid.
inline const std::string column = R"(schema_version = 1
title = "Column"
[time]
end = 0.1
[domain]
min = [-0.1, -0.1]
max = [1.1, 1.1]
[fluid]
spacing = 0.02
sound_speed = 40.0
[[fluid.box]]
min = [0.0, 0.0]
max = [0.3, 0.5]
[[wall]]
name = "tank"
points = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
[output]
frame_interval = 0.02
history_interval = 0.01
)";

// Still water between three walls, 1 m by 1 m.
inline const std::string walled_basin = R"(schema_version = 1
[time]
end = 0.02
[domain]
min = [-0.5, -0.5]
max = [1.5, 1.5]
[fluid]
spacing = 0.05
sound_speed = 40
[[fluid.box]]
min = [0, 0]
max = [1, 1]
[[wall]]
name = "west"
points = [[0, 1.5], [0, 0]]
force = true
[[wall]]
name = "bottom"
points = [[0, 0], [1, 0]]
force = true
[[wall]]
name = "east"
points = [[1, 0], [1, 1.5]]
force = true
)";

// A metre of water, 0.2 m deep; the piston at its left stands on a floor that goes on behind it.
inline const std::string piston_channel = R"(schema_version = 1
[time]
end = 0.6
[domain]
min = [-0.4, -0.1]
max = [1.1, 0.6]
[fluid]
spacing = 0.02
sound_speed = 20.0
[[fluid.box]]
min = [0.0, 0.0]
max = [1.0, 0.2]
[[wall]]
name = "channel"
points = [[-0.3, 0.0], [1.0, 0.0], [1.0, 0.5]]
[[wall]]
name = "piston"
points = [[0.0, 0.5], [0.0, 0.0]]
[wall.motion.translation]
velocity = [0.25, 0.0]
ramp = 0.1
)";

// Water at rest between two plates 1 m apart that it sticks to, in a period of 1 m; µ 100 Pa s.
inline const std::string plates = R"(schema_version = 1
gravity = [0, 0]
[time]
end = 1.0
[domain]
min = [0, -0.1]
max = [1, 1.1]
periodic = ["x"]
[fluid]
spacing = 0.05
sound_speed = 10
[fluid.viscosity]
dynamic = 100
operator = "morris"
[[fluid.box]]
min = [0, 0]
max = [1, 1]
[[wall]]
name = "lower"
points = [[0, 0], [1, 0]]
slip = "none"
force = true
[[wall]]
name = "upper"
points = [[1, 1], [0, 1]]
slip = "none"
force = true
)";
// The upper plate moves [m/s].
inline std::string with_upper_plate_at(const std::string& scene, const std::string& speed) {
    return scene + "[wall.motion.translation]\nvelocity = [" + speed + ", 0]\n";
}

// Water in space that falls freely: nothing acts on it but gravity.
inline const std::string falling_block = R"(schema_version = 1
title = "Falling block"
[time]
end = 0.05
[domain]
min = [-1, -1, -1]
max = [2, 2, 2]
[fluid]
spacing = 0.05
sound_speed = 20
support_ratio = 2.6
initial_pressure = "zero"
[[fluid.box]]
min = [0, 0, 0]
max = [0.5, 0.4, 0.3]
[output]
frame_interval = 0.025
)";

// Water of 1 m by 1 m with a free elastic body in it and nothing else anywhere: half_width by half_height about the
// middle, both whole numbers of Δx = 25 mm; bigger elements make coarser panels.
inline std::string surrounded_body(int half_width, int half_height, int columns, int rows) {
    const auto number = [](int particles) { return std::to_string(0.025 * particles); };
    const std::string left = number(20 - half_width), right = number(20 + half_width), low = number(20 - half_height),
                      high = number(20 + half_height);
    const auto box = [](const std::string& x0, const std::string& y0, const std::string& x1, const std::string& y1) {
        return "min = [" + x0 + ", " + y0 + "]\nmax = [" + x1 + ", " + y1 + "]\n";
    };
    return R"(schema_version = 1
title = "Body in water"
[time]
end = 0.05
[domain]
min = [-1.0, -1.0]
max = [2.0, 2.0]
[fluid]
spacing = 0.025
sound_speed = 30.0
)" + ("[[fluid.box]]\n" + box("0.0", "0.0", "1.0", low)) +
           ("[[fluid.box]]\n" + box("0.0", low, left, high)) + ("[[fluid.box]]\n" + box(right, low, "1.0", high)) +
           ("[[fluid.box]]\n" + box("0.0", high, "1.0", "1.0")) + R"([solid]
name = "body"
wet = ["left", "bottom", "right", "top"]
[solid.box]
)" + box(left, low, right, high) +
           "elements = [" + std::to_string(columns) + ", " + std::to_string(rows) + R"(]
[solid.material]
density = 1000.0
youngs_modulus = 1.0e7
poissons_ratio = 0.3
)";
}
// Two particles thick: what its two sides mirror reaches out of the other side.
inline const std::string strip = surrounded_body(12, 1, 12, 1);
inline const std::string coarse_strip = surrounded_body(12, 1, 6, 1);

// The gate by central differences: some fifteen of their steps make a cycle.
inline std::string explicit_gate() {
    return with(gate, "name = \"newmark\"", "name = \"central_difference\"");
}

inline std::string with_coupling(const std::string& text, const std::string& algorithm, int ratio) {
    return with(text, "algorithm = \"cps\"\nratio = 1\n",
                "algorithm = \"" + algorithm + "\"\nratio = " + std::to_string(ratio) + "\n");
}

}  // namespace aquagraph::test
