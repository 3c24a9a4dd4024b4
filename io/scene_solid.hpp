// What a scene says about its elastic body: part of io/scene.hpp.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/point.hpp"
#include "io/scene_geometry.hpp"
#include "io/scene_time_law_data.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::io {

struct Clamp {
    std::string name;             // columns NAME_force_x[N], … of what holds it; empty: none
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

// The nodes of a set are displaced along one direction.
struct NodeMotionScene {
    std::string name;  // as of a clamp
    std::string set;
    int along = 0;  // 0, 1, 2: x, y, z
    TimeLawScene law;
};

// The nodes of a set as one rigid body: a rim. Columns NAME_x[m], …, NAME_turn[rad] (three dimensions: NAME_turn_x, …),
// and NAME_force_x, …, NAME_moment (…) of what is prescribed.
struct RigidBodyScene {
    std::string name, set;
    std::optional<Point> point;   // where loads act; default the mean of the nodes
    double mass = 0;              // its own, beside that of its nodes [kg]
    std::vector<double> inertia;  // its own [kg m²], about x, y, z at first
};
// What one freedom of a body is made to do, or is loaded with.
struct RigidFreedomScene {
    std::string body;
    int freedom = 0;  // translations, then turns
    TimeLawScene law;
};

struct PressureScene {
    std::string surface;
    TimeLawScene law;  // [Pa]
};

// A surface and the rigid ground that it cannot pass through. Columns NAME_force_x, …, NAME_area, NAME_pressure.
struct ContactScene {
    std::string name, surface;
    solid::GroundShape shape = solid::GroundShape::plane;
    Point point{};
    std::optional<Point> direction;  // normal of a plane; axis of a cylinder
    double radius = 0;               // [m]
    bool hollow = false;
    double friction = 0;
    std::optional<double> penalty;  // [Pa/m]
};
struct GroundMotionScene {
    std::string contact;
    int along = 0;
    TimeLawScene law;  // [m]
};

// Cords in the body's material, or in that of a part.
struct CordsScene {
    std::string set;  // of the part; empty: the body's own material
    double modulus = 0, section = 0, spacing = 0, thickness = 0;
    std::vector<double> angles;             // [rad], a family of cords each
    std::optional<Point> axis, axis_point;  // how the layer lies: around an axis …
    std::optional<Point> along, normal;     // … or flat
};

enum class SolidSolver { built_in, calculix };

struct SolidScene {
    std::string name = "solid";
    SolidSolver solver = SolidSolver::built_in;
    std::string program = "ccx";    // of calculix (absolute once read, where it has a slash)
    std::optional<Box> box;         // either a box, meshed with so many elements along x, y (and z) …
    std::array<int, 3> elements{};  //
    std::filesystem::path mesh;     // … or a file, .msh or .inp (absolute once read)
    int element_order = 2;          // with nodes in the middle of the edges (2) or without (1)
    MaterialScene material;         //
    std::vector<PartScene> parts;   // element sets of other materials
    solid::Integration integration = solid::Integration::reduced;
    solid::PlaneCondition plane = solid::PlaneCondition::strain;
    solid::Scheme scheme = solid::Scheme::hht;
    bool is_static = false;         // each step an equilibrium, instead of a motion
    double alpha = -0.3;            // αs in ]-1/3, 0]
    double step = 0;                // [s], of a body without water
    bool static_start = false;      // equilibrium under its own weight, and the loads at t = 0, before t = 0
    std::optional<Point> velocity;  // at the start [m/s]
    std::vector<Clamp> clamps;
    std::vector<TractionScene> tractions;
    std::vector<ForceScene> forces;
    std::vector<NodeMotionScene> motions;
    std::vector<RigidBodyScene> rigid_bodies;
    std::vector<RigidFreedomScene> rigid_motions, rigid_loads;
    std::vector<PressureScene> pressures;
    std::vector<ContactScene> contacts;
    std::vector<GroundMotionScene> ground_motions;
    std::vector<CordsScene> cords;
    double mass_damping = 0, stiffness_damping = 0;  // Rayleigh's: [1/s], [s]
    std::vector<std::string> wet;                    // surface sets that touch the fluid
    std::vector<Track> tracks;
};

}  // namespace aquagraph::io
