// What a scene says about its elastic body: part of io/scene.hpp.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/point.hpp"
#include "io/scene_geometry.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::io {

struct Clamp {
    std::string set;              // node set: left, right, bottom, top of a box; a physical group of a mesh
    std::array<bool, 3> fixed{};  // x, y, z
};

struct Track {
    std::string name;  // columns NAME_x[m], NAME_y[m] (and NAME_z): displacement of the node nearest to point
    Point point{};
};

// How a load of size 1 goes with time. At most one is given; with neither it is constant.
struct LoadHistory {
    std::string formula;          // of t
    std::filesystem::path table;  // two columns, time and factor (absolute once read)
};

// A load on a surface that keeps its direction and its size per reference area, whatever the body does.
struct TractionScene {
    std::string surface;
    Point value{};  // [N/m²]
    LoadHistory factor;
};

// A force shared evenly by the nodes of a set, or on the node nearest to a point.
struct ForceScene {
    std::string set;
    std::optional<Point> point;
    Point value{};  // [N]; in two dimensions per metre of depth
    LoadHistory factor;
};

// A material, and the file that its measured curve came from.
struct MaterialScene : solid::Material {
    std::filesystem::path curve_file;  // absolute once read
};

struct PartScene {
    std::string set;
    MaterialScene material;
};

struct SolidScene {
    std::string name = "solid";
    std::optional<Box> box;         // either a box, meshed with so many elements along x, y (and z) …
    std::array<int, 3> elements{};  //
    std::filesystem::path mesh;     // … or a file, .msh or .inp (absolute once read)
    int element_order = 2;          // with nodes in the middle of the edges (2) or without (1)
    MaterialScene material;         //
    std::vector<PartScene> parts;   // element sets of other materials
    solid::Integration integration = solid::Integration::reduced;
    solid::PlaneCondition plane = solid::PlaneCondition::strain;
    solid::Scheme scheme = solid::Scheme::hht;
    bool is_static = false;     // each step an equilibrium, instead of a motion
    double alpha = -0.3;        // αs in ]-1/3, 0]
    double step = 0;            // [s], of a body without water
    bool static_start = false;  // equilibrium under its own weight, and the loads at t = 0, before t = 0
    std::vector<Clamp> clamps;
    std::vector<TractionScene> tractions;
    std::vector<ForceScene> forces;
    std::vector<std::string> wet;  // surface sets that touch the fluid
    std::vector<Track> tracks;
};

}  // namespace aquagraph::io
