// Shapes of walls and of water, and prescribed motions, as a scene file says them. Plain data; io/scene_surfaces.hpp
// makes surfaces and motions of it.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/point.hpp"
#include "physics/geometry/shapes.hpp"

namespace aquagraph::io {

struct Box {
    Point min{}, max{};
};

struct BoxShape {
    Box box;
    geometry::FluidSide fluid = geometry::FluidSide::inside;
    std::vector<std::string> open;  // sides without wall: left, right, front, back, bottom, top
};

struct RectangleShape {  // 3D
    Point corner{}, side_a{}, side_b{};
};

struct ExtrusionShape {         // 3D
    std::vector<Point> points;  // the two coordinates across the axis
    bool closed = false, caps = false;
    int axis = 2;
    double from = 0, to = 0;  // [m]
};

// A circle in 2D, a sphere in 3D.
struct RoundShape {
    Point centre{};
    double radius = 0;                  // [m]
    std::optional<double> chord_error;  // [m]; default Δx/50
    geometry::FluidSide fluid = geometry::FluidSide::inside;
};

struct CylinderShape {  // 3D
    Point from{}, to{};
    double radius = 0;                  // [m]
    std::optional<double> chord_error;  // [m]; default Δx/50
    geometry::FluidSide fluid = geometry::FluidSide::inside;
    std::vector<std::string> open;  // ends without wall: from, to
};

struct StlShape {                // 3D
    std::filesystem::path file;  // absolute once read
    double scale = 1;            // m per unit of the file
    Point axis{0, 0, 1};         // turned about this axis through the file's origin …
    double angle = 0;            // … by this angle [rad], after scaling
    Point translate{0, 0, 0};    // [m], after turning
    std::optional<double> weld;  // vertices closer than this are one [m]; default a millionth of the size
    bool closed = true;          // a surface that is not watertight is refused
    geometry::FluidSide fluid = geometry::FluidSide::outside;
};

// What a translation and a rotation have in common; either `constant` or `amplitude`, or neither where a table moves
// the wall.
template <class Value>
struct LawScene {
    std::optional<Value> constant;   // velocity [m/s], [rad/s]
    std::optional<Value> amplitude;  // [m], [rad]
    double frequency = 0;            // [Hz]
    double phase = 0;                // [rad]
    double ramp = 0;                 // [s]
};

struct MotionScene {
    std::optional<LawScene<Point>> translation;
    std::optional<LawScene<double>> rotation;
    Point centre{}, axis{0, 0, 1};
    std::filesystem::path table;  // absolute once read; empty: none
    bool hold = false;            // after the table's last row; else such a run is refused
};

enum class InitialPressure { hydrostatic, zero };

// Water inside a closed shape; exactly one of points, round and stl is given.
struct RegionScene {
    std::string key;  // "fluid.polygon[0]"
    std::vector<Point> points;
    std::optional<RoundShape> round;
    std::optional<StlShape> stl;
    std::optional<double> level;              // no water above [m]
    double clearance = 0.5;                   // from the surface, in spacings
    Point velocity{};                         // [m/s]
    std::optional<InitialPressure> pressure;  // default: that of [fluid]; drops (round) none
};

struct WaterBox : Box {
    Point velocity{};  // [m/s]
};

}  // namespace aquagraph::io
