// Energy across the interface (thesis (5.1)-(5.3)): what the fluid gets from the body, summed with the weights of the
// fluid's integration (WallWork of the body's wall), against what the body loses by the loads it is given,
//     E_fluid/body = - Σ_steps ½ (F_n + F_n+1)·(u_n+1 - u_n),
// as the body's own ledger has it (Structure::work_of_loads), F being those that its steps have read. The difference,
// E_Interface, is energy that the coupling has made (> 0) or destroyed.
#pragma once

namespace aquagraph::coupling {

struct InterfaceEnergy {
    double to_fluid = 0;        // E_body/fluid, at the last exchange [J/m]
    double from_body = 0;       // E_fluid/body
    double solid_at_start = 0;  // kinetic, strain and gravity's: the solid's ledger counts from there

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(to_fluid, from_body, solid_at_start);
    }

    double of_interface() const { return to_fluid - from_body; }

    // A solve has ended; work: of the loads on the body since the start. Returns the energy that the body has lost by
    // them in this solve.
    double book(double work) {
        const double given = -work - from_body;
        from_body = -work;
        return given;
    }
};

}  // namespace aquagraph::coupling
