// Energy across the interface (thesis (5.1)-(5.3)): what the fluid gets from the body, summed with the weights of the
// fluid's integration (WallWork of the body's wall), against what the body loses by the loads it is given,
//     E_fluid/body = - Σ_cycles ½ (F_n + F_n+1)·(u_n+1 - u_n),
// trapezoidal like the solid's own ledger, F being those that its solves have read. The difference, E_Interface, is
// energy that the coupling has made (> 0) or destroyed.
#pragma once
#include <span>
#include <vector>

namespace aquagraph::coupling {

struct InterfaceEnergy {
    double to_fluid = 0;        // E_body/fluid, at the last exchange [J/m]
    double from_body = 0;       // E_fluid/body
    double solid_at_start = 0;  // kinetic, strain and gravity's: the solid's ledger counts from there
    bool begun = false;
    std::vector<double> loads, displacements;  // of the last solve, per component

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(to_fluid, from_body, solid_at_start, begun, loads, displacements);
    }

    double of_interface() const { return to_fluid - from_body; }

    // The body stands at these displacements.
    void begin(std::span<const double> at) {
        displacements.assign(at.begin(), at.end());
        loads.assign(at.size(), 0.0);
        begun = false;
    }

    // A solve has read `now` and ended at `at`. Returns the energy that the body has lost by these loads. The first
    // solve takes its loads as constant.
    double book(std::span<const double> now, std::span<const double> at) {
        double work = 0;
        for (std::size_t k = 0; k < loads.size(); ++k) {
            const double before = begun ? loads[k] : now[k];
            work += 0.5 * (before + now[k]) * (at[k] - displacements[k]);
            loads[k] = now[k];
            displacements[k] = at[k];
        }
        begun = true;
        from_body -= work;
        return -work;
    }
};

}  // namespace aquagraph::coupling
