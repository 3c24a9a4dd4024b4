// What a scene file says, checked and with every default filled in. Plain data: the engine turns it into a simulation.
// SI units throughout. The keys are documented in benchmarks/SCENES.md; io/scene_reader.hpp reads them.
#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/expression.hpp"
#include "io/point.hpp"
#include "io/scene_geometry.hpp"
#include "io/scene_solid.hpp"
#include "physics/coupling/choices.hpp"
#include "physics/fluid/choices.hpp"

namespace aquagraph::io {

struct SourcePosition {
    int line = 0, column = 0;
};

enum class Reconstruction { muscl, none };
enum class Slip { free, none, symmetry };
enum class DomainEdge { closed, open };
enum class WallMethod { ghosts, normal_flux };

// How pairs of particles act on each other; [fluid.scheme].
struct FluidScheme {
    fluid::Scheme name = fluid::Scheme::riemann;
    Reconstruction reconstruction = Reconstruction::muscl;
    fluid::RiemannSolver riemann_solver = fluid::RiemannSolver::acoustic;
    double delta = 0.1;   // δ of δ-SPH
    double alpha = 0.01;  // α of δ-SPH and artificial viscosity
};

// Formulas of position, x y z and the constants; empty where a field is not given.
struct InitialFields {
    std::vector<std::string> velocity;  // [m/s], one per direction
    std::string pressure;               // [Pa]
};

// a = -rate² (x - centre): what holds an oscillating drop together.
struct CentralForce {
    Point centre{};
    double rate = 0;  // [1/s]
};

struct FluidScene {
    double spacing = 0;              // Δx [m]
    double density = 1000;           // ρ0 [kg/m³]
    double sound_speed = 0;          // c0 [m/s]
    double polytropic_exponent = 7;  // γ of the Tait equation
    double support_ratio = 4;        // R/Δx
    fluid::KernelName kernel = fluid::KernelName::wendland_c2;
    fluid::IntegrationScheme integration = fluid::IntegrationScheme::rk4;
    double cfl = 0.375;  // K of Δt = K R/c; the default depends on the integration
    FluidScheme scheme;
    double viscosity = 0;  // µ [Pa s]; 0: none
    fluid::ViscousOperator viscous_operator = fluid::ViscousOperator::monaghan_gingold;
    fluid::Transport transport = fluid::Transport::none;
    double x_sph = 0.5;  // ε
    WallMethod walls = WallMethod::ghosts;
    InitialPressure initial_pressure = InitialPressure::hydrostatic;
    std::optional<double> surface_level;  // height at which p = 0 [m]; default: the highest top of the water
    std::vector<WaterBox> boxes;          // filled with particles at the centres of Δx cells
    std::vector<RegionScene> regions;     // polygons, discs, balls, closed STL volumes
    bool relax = false;                   // regions, to a regular distribution before t = 0
    double relax_tolerance = 2e-3;        // of the standard deviation of the kernel sum
    InitialFields initial;                // instead of rest and of initial_pressure
    std::optional<CentralForce> central_force;
    std::optional<Point> driving_force;  // [m/s²], beside gravity; no pressure answers it
};

// Exactly one shape. points: in 2D a polyline with the fluid on the left of the direction of travel; in 3D the corners
// of a flat face, counter-clockwise as seen from the fluid.
struct WallScene {
    std::string name;
    std::vector<Point> points;
    bool closed = false;
    std::optional<BoxShape> box;
    std::optional<RectangleShape> rectangle;
    std::optional<ExtrusionShape> extrusion;
    std::optional<RoundShape> round;
    std::optional<CylinderShape> cylinder;
    std::optional<StlShape> stl;
    std::optional<MotionScene> motion;
    Slip slip = Slip::free;
    bool force = false;  // columns NAME_force_x … of the history
};

enum class ProbeQuantity { pressure, velocity, level };
enum class ProbeInterpolation { shepard, linear };

// A place whose values go into history.csv: NAME_pressure, NAME_velocity_x …, NAME_level.
struct ProbeScene {
    std::string name;
    ProbeQuantity quantity = ProbeQuantity::pressure;
    Point point{};     // of a level: the lower end of the line along which the surface is looked for
    std::string wall;  // on whose nearest panel the probe sits and with which it moves; empty: it stands still
    ProbeInterpolation interpolation = ProbeInterpolation::shepard;
};

enum class CouplingAlgorithm { cps, css, iterated };

struct CouplingScene {
    CouplingAlgorithm algorithm = CouplingAlgorithm::cps;
    int ratio = 1;               // p: fluid steps per solid step; where it is regulated, its bound
    bool ratio_control = false;  // (6.2)
    coupling::LoadMethod load = coupling::LoadMethod::force_conservative;
    double energy_cycles = 20;  // over which the energy conservative load averages
    coupling::Extrapolation extrapolation = coupling::Extrapolation::linear;
    double smoothing = 0.5;  // ℓ over Δx: what the water sees of the wet nodes (wet_smoothing.hpp)
    coupling::StepRule step_rule = coupling::StepRule::fixed;
    double step_fraction = 0.8;  // of the CFL step, at which the steps of a cycle are fixed (6.4); predicted: 1
    coupling::Relaxation relaxation = coupling::Relaxation::quasi_newton;
    double tolerance = 1e-3;   // of the iterations, over what the wet nodes move in the cycle
    int most_iterations = 20;  // of a cycle
};

struct OutputScene {
    double frame_interval = 0;        // [s]
    double history_interval = 0;      // [s]; 0: every coupling cycle
    double checkpoint_interval = 10;  // [min] of wall-clock time; 0: only when the run is asked to stop
    bool interface_loads = false;     // of every wet node, into history.csv, every coupling cycle
    bool energy_ledger = false;       // where the fluid's energy goes, and whether the balance closes
};

// Columns of history.csv that sum over particles. Formulas of x y z t vx vy vz p rho fullness and the constants.

// Σ ω value; with a weight the mean Σ ω weight value / Σ ω weight.
struct Integral {
    std::string name, value, weight, unit;
};

// The largest or smallest value among the particles for which `where` is not zero.
struct Extreme {
    std::string name, value, where, unit;
    bool largest = true;
};

// How far the fluid is from fields known as formulas of x y z t: the columns NAME_velocity_error and
// NAME_pressure_error.
struct FieldError {
    std::string name;
    std::vector<std::string> velocity;                     // [m/s]; empty: not compared
    std::string pressure;                                  // [Pa]; empty: not compared
    std::string where;                                     // only particles for which this is not zero; empty: all
    std::optional<double> velocity_scale, pressure_scale;  // divide the errors; default: the L2 norm of the exact field
};

struct Compare {
    std::string column;           // of history.csv, without the unit: "tip_x"
    std::filesystem::path file;   // (absolute once read) two columns, comma, tab or blanks; lines of text are skipped
    std::string formula;          // of t, instead of a file
    bool change = false;          // compares how far the column is from its first row
    std::optional<double> scale;  // the error is divided by it; default: the reference's peak in the window
    std::string label;            // for the report: "Antoci et al. 2007, experiment"
    std::array<double, 2> window{};  // [s]
    double time_scale = 1, value_scale = 1,
           value_offset = 0;  // t = time_scale * column 1; v = value_scale * column 2 + value_offset
    bool error = true;        // false: drawn in the report, not part of the summary's errors
};

struct Scene {
    std::filesystem::path file;  // absolute path of the scene file
    std::string name;            // folder of results: <folder>_<file stem> or just <folder> for scene.toml
    std::string title;
    std::string text;                      // the file as read, followed by a line "# --set KEY=VALUE" per override
    std::vector<std::string> overrides;    // "fluid.spacing=0.01"
    Constants constants;                   // of [constants]
    double end_time = 0;                   // [s]
    int dimension = 2;                     // of all points: that of domain.min
    Point gravity{0, -9.81};               // [m/s²]; in 3D {0, 0, -9.81}
    Box domain;                            // particles outside it have left
    DomainEdge edge = DomainEdge::closed;  // closed: leaving it is an error; open: they are taken out and counted
    std::vector<std::string> periodic;     // directions, "x", "y", "z", in which the domain repeats itself
    std::optional<FluidScene> fluid;
    std::vector<WallScene> walls;
    std::optional<SolidScene> solid;
    std::vector<ProbeScene> probes;
    CouplingScene coupling;
    OutputScene output;
    std::vector<Integral> integrals;
    std::vector<Extreme> extremes;
    std::vector<FieldError> field_errors;
    std::vector<Compare> comparisons;
    std::map<std::string, SourcePosition> positions;  // dotted key ("fluid.box[0].min", counted from 0) -> place
};

}  // namespace aquagraph::io
