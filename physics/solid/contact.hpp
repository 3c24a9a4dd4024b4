// Contact of a surface with rigid ground by penalty, at the Gauss points of its facets (Wriggers, Computational Contact
// Mechanics, 2nd ed., 5.3, 6.3, 9.3). Per reference area
//   normal      p = ε ⟨-g⟩, along the ground's normal n: the potential ½ ε ⟨-g⟩², whose tangent is symmetric
//   tangential  Coulomb's law made regular: t = t_n - ε/10 (I - n⊗n) Δs while |t| <= µ p (sticking), of that length
//               beyond (slipping); Δs the slip of the point over the ground in the step. It gives way by 10 µ times
//               the penetration before it slips: stiffer, Newton loses itself between sticking and slipping.
// The tangent of slip leaves out ∂|t|/∂p, which is not symmetric. Without a given penalty ε = 10 E/h, E being the
// modulus at small strain of the element behind the facet and h its volume over the facet's area: the element under
// its own pressure is compressed ten times as far as the ground is penetrated.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "physics/solid/contact_report.hpp"
#include "physics/solid/ground.hpp"
#include "physics/solid/options.hpp"
#include "physics/solid/surface_facets.hpp"

namespace aquagraph::solid {

// What friction remembers of the last accepted state; by Gauss point. Without friction only the shift.
template <int D>
struct ContactHistory {
    std::array<double, D> shift{};             // of the ground [m]
    std::vector<double> tractions, positions;  // D × points [Pa], [m]
    bool operator==(const ContactHistory&) const = default;
};

template <int D>
class GroundContact {
  public:
    using Vector = std::array<double, D>;

    // Throws std::invalid_argument for an unknown surface, bad ground, or a friction or penalty out of range.
    GroundContact(const Mesh<D>& mesh, const Options<D>& options, const Contact<D>& contact);

    // The ground's place: `part` of the way from `start` to where it is at time t.
    void place_ground(const Vector& start, double t, double part);
    const Vector& shift() const { return shift_; }

    // nodal += factor × the forces of contact on the nodes, of displacements u.
    void add_forces(double factor, std::span<const double> u, std::span<double> nodal, BlockLoop loop);
    // -∂f/∂u into the matrices of the facets, with the ground displaced by `shift` and that history.
    void tangents(const Vector& shift, std::span<const double> u, const ContactHistory<D>& history,
                  std::span<double> matrices, BlockLoop loop) const;
    // The tangent that is largest in any direction: as if all stuck to the ground.
    void largest_tangents(std::span<double> matrices) const;
    std::size_t matrix_size() const { return facets_.matrix_size(); }

    // The state whose forces were evaluated last becomes the history.
    void accept();
    const ContactHistory<D>& history() const { return history_; }
    void set_history(const ContactHistory<D>& history, std::span<const double> u);

    // Since the start or the last reset [J]; of the accepted states.
    double stored() const;
    double friction_dissipation() const { return friction_dissipation_; }
    double ground_work() const { return ground_work_; }
    void reset_energies(double friction_dissipation, double ground_work);

    ContactReport<D> report(std::span<const double> u) const;  // of the last accepted state
    // Adds Σ N_a² A p and Σ N_a² A of the Gauss points, A their areas now: a mean at the nodes of the surface.
    void add_nodal_pressure(std::span<const double> u, std::span<double> pressures, std::span<double> weights) const;

  private:
    void add_tangent(std::size_t facet, const FacetPoint& point, double area, const double (&A)[D][D],
                     std::span<double> matrices) const;
    struct State {            // of a point
        double pressure = 0;  // ε ⟨-g⟩
        bool slips = false;
        typename GroundSurface<D>::Place place;
        Vector traction{}, trial{};
    };
    State state_at(std::size_t point, const Vector& x, const Vector& shift, const ContactHistory<D>& history) const;

    SurfaceFacets<D> facets_;
    GroundSurface<D> ground_;
    double friction_;
    std::vector<double> areas_, penalties_;  // by Gauss point: reference area [m²], ε [Pa/m]
    ContactHistory<D> history_;
    Vector shift_{};  // now
    std::vector<State> states_, old_states_;
    std::vector<Vector> positions_;  // now
    double friction_dissipation_ = 0, ground_work_ = 0;
};

// The modulus at small strain [Pa]: E; of Mooney–Rivlin 6 (C_10 + C_01), incompressible; of a curve its first slope.
double small_strain_modulus(const Material& material);

}  // namespace aquagraph::solid
