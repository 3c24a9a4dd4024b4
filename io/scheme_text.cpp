#include "io/scheme_text.hpp"

#include <fmt/format.h>

namespace aquagraph::io {

std::string scheme_text(const FluidScene& fluid) {
    const FluidScheme& scheme = fluid.scheme;
    const auto riemann = [&](const char* name) {
        const char* solver = scheme.riemann_solver == fluid::RiemannSolver::exact             ? ", exact solver"
                             : scheme.riemann_solver == fluid::RiemannSolver::low_dissipation ? ", low dissipation"
                                                                                              : "";
        return fmt::format("{} ({}{})", name,
                           scheme.reconstruction == Reconstruction::muscl ? "MUSCL, minmod" : "first order", solver);
    };
    std::string text;
    switch (scheme.name) {
        case fluid::Scheme::riemann:
            text = riemann("Riemann-SPH");
            break;
        case fluid::Scheme::riemann_ale:
            text = riemann("ALE Riemann-SPH");
            break;
        case fluid::Scheme::delta_sph:
            text = fmt::format("δ-SPH (δ {:g}, α {:g})", scheme.delta, scheme.alpha);
            break;
        case fluid::Scheme::artificial_viscosity:
            text = fmt::format("SPH with artificial viscosity (α {:g})", scheme.alpha);
    }
    text += fluid.kernel == fluid::KernelName::cubic_spline ? ", cubic spline" : ", Wendland C2";
    text += fluid.integration == fluid::IntegrationScheme::rk4   ? ", RK4"
            : fluid.integration == fluid::IntegrationScheme::rk3 ? ", RK3"
                                                                 : ", Verlet";
    if (fluid.viscosity > 0)
        text += fmt::format(", viscosity {:g} Pa s ({})", fluid.viscosity,
                            fluid.viscous_operator == fluid::ViscousOperator::morris ? "Morris" : "Monaghan–Gingold");
    if (fluid.transport == fluid::Transport::x_sph) text += ", X-SPH";
    if (fluid.transport == fluid::Transport::shifting) text += ", shifting";
    return text;
}

}  // namespace aquagraph::io
