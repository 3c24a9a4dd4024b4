// What a solid is made of, held by and taken through time with.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "physics/time_law.hpp"

namespace aquagraph::solid {

enum class MaterialLaw { saint_venant_kirchhoff, linear, neo_hookean, mooney_rivlin, uniaxial_curve };
enum class PlaneCondition { strain, stress };
enum class Scheme { hht, newmark, central_difference };
enum class LinearSolver { automatic, cholesky, conjugate_gradients };
// Gauss points of quadratic elements: 2^D, with which they do not lock, but with which a single element, or a column of
// hexahedra one by one across, has modes without energy; or 3^D (tetrahedra 4 or 14).
enum class Integration { reduced, full };
// Of the loads at the start, or as far as a step resolves them: a load that is set on suddenly gives light nodes
// accelerations of which the velocities keep (1 - γ) Δt a.
enum class FirstAccelerations { of_mass, resolved };
// What elements of 4 or 8 nodes do: enhanced assumed strains, or displacements alone, which lock.
enum class LinearElements { enhanced, displacement };

// Parallel cords in a layer of rubber; three dimensions, neo-Hookean or Mooney–Rivlin rubber.
struct CordFamily {
    double modulus = 0;    // E_c > 0 of the cord in tension [Pa]; it bears no compression
    double section = 0;    // A > 0 of one cord [m²]
    double spacing = 0;    // > 0 between cords [m]
    double thickness = 0;  // > 0 of the layer that the elements stand for [m]
    double angle = 0;      // from the layer's reference direction, by the right hand about its normal [rad]
};

// How an element's layer lies: its normal is the element's thinnest direction; the reference direction lies in the
// layer. With an axis: the direction around it, the normal pointing away from it. Without: `along` [1] projected on the
// layer, the normal on the side of `normal` [1].
struct LayerFrame {
    bool around_axis = false;
    std::array<double, 3> point{}, axis{0, 1, 0};
    std::array<double, 3> along{1, 0, 0}, normal{0, 0, 1};
};

struct Material {
    MaterialLaw law = MaterialLaw::saint_venant_kirchhoff;
    double density = 0;                        // ρ_S > 0 [kg/m³], in the reference configuration
    double youngs_modulus = 0;                 // E > 0 [Pa]; all laws but Mooney–Rivlin and a curve
    double poissons_ratio = 0;                 // ν in ]-1, 1/2[
    double c10 = 0, c01 = 0;                   // Mooney–Rivlin: C_10 + C_01 > 0 [Pa]
    double bulk_modulus = 0;                   // Mooney–Rivlin: κ > 0 [Pa]
    std::vector<std::array<double, 2>> curve;  // uniaxial_curve: strain and force per reference area [Pa]; with ν
    std::vector<CordFamily> cords;
    LayerFrame layer;  // of the cords
};

// The elements of a set that are of another material than the rest.
struct Part {
    std::string set;
    Material material;
};

// Every node of a set keeps its reference position in the directions marked (x, y, z).
template <int D>
struct Clamp {
    std::string set;
    std::array<bool, D> fixed{};
};

// Every node of a set moves by these displacements from its reference position in the directions that have one. In
// static solves they grow with the load, up to their values at the solver's time.
template <int D>
struct Motion {
    std::string set;
    std::array<std::optional<TimeFunction>, D> displacement;  // [m]
};

template <int D>
inline constexpr std::size_t rotation_count = D == 2 ? 1 : 3;
template <int D>
inline constexpr std::size_t rigid_freedoms = D + rotation_count<D>;  // translations, then rotations (about x, y, z)

// The nodes of a set move as one rigid body, as a wheel's rim does. Each of its freedoms is prescribed, or it is free
// and loaded.
template <int D>
struct RigidBody {
    std::string set;
    std::optional<std::array<double, D>> point = {};  // loads act on it; if none, the mean of the nodes
    // [m], [rad] about the point; 3D rotations: integrals of the components of the angular velocity, the angle if there
    // is one axis.
    std::array<std::optional<TimeFunction>, rigid_freedoms<D>> motion = {};
    std::array<TimeFunction, rigid_freedoms<D>> load = {};  // [N], [N m]
    double mass = 0;                                        // its own, beside that of its nodes [kg]
    std::array<double, rotation_count<D>> inertia = {};     // principal, along x, y, z at first [kg m²]
};

// Pressure that stays normal to the deformed surface and counts per deformed area; positive towards the solid.
struct Pressure {
    std::string surface;
    TimeFunction pressure = {};  // [Pa]
};

enum class GroundShape { plane, cylinder, sphere };  // D = 2: a cylinder is a circle

// Rigid ground, which may travel.
template <int D>
struct Ground {
    GroundShape shape = GroundShape::plane;
    std::array<double, D> point{};                  // on the plane; on the axis; the centre
    std::array<double, D> direction{};              // of any length: normal of the plane, towards the body; D = 3: axis
    double radius = 0;                              // of a cylinder or sphere [m]
    bool hollow = false;                            // the body is inside the cylinder or sphere
    std::array<TimeFunction, D> displacement = {};  // of the whole [m]
};

// A surface of the solid that cannot pass through the ground.
template <int D>
struct Contact {
    std::string surface;
    Ground<D> ground;
    double friction = 0;                 // Coulomb's coefficient
    std::optional<double> penalty = {};  // pressure per depth [Pa/m]; if none, 10 E/h of the element behind each facet
};

template <int D>
struct Options {
    Material material;                              // of all elements that are in no part
    std::vector<Part> parts;                        // an element in several is of the last
    PlaneCondition plane = PlaneCondition::strain;  // D = 2
    double thickness = 1;                           // D = 2: > 0 [m], in the reference configuration
    LinearElements linear_elements = LinearElements::enhanced;
    Integration integration = Integration::reduced;
    std::array<double, D> gravity{};  // [m/s²]
    Scheme scheme = Scheme::hht;
    double alpha = -0.3;                                                   // αs in ]-1/3, 0]
    FirstAccelerations first_accelerations = FirstAccelerations::of_mass;  // implicit schemes
    // Rayleigh's damping (ψ = α/(2ω) + βω/2 of the critical value), ≥ 0: of the masses of the nodes [1/s], and of the
    // stiffness at rest, carried along by rotations (viscous_elements.hpp) [s].
    double mass_damping = 0, stiffness_damping = 0;
    std::vector<Clamp<D>> clamps;
    std::vector<Motion<D>> motions;
    std::vector<RigidBody<D>> rigid_bodies;
    std::vector<Pressure> pressures;
    std::vector<Contact<D>> contacts;
    double residual_tolerance = 1e-8;   // of the largest of |F_ext|, |F_int|, |M a| (Euclidean norms over free nodes)
    double increment_tolerance = 1e-6;  // of |u_n+1 - u_n|: bounds the displacement error that Newton leaves
    int max_iterations = 30;            // of one Newton solve
    LinearSolver linear_solver = LinearSolver::automatic;  // of time steps; static solves always factorise
};

}  // namespace aquagraph::solid
