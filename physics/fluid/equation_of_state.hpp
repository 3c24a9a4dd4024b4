// Tait's equation of state (thesis (2.9)), in terms of the deviation δ = ρ - ρ0 so that a pressure of a few Pa survives
// rounding at c0 = 1500 m/s:
//     p = ρ0 c0²/γ [(1 + δ/ρ0)^γ - 1]
// and the sound speed that is its derivative, c = c0 (ρ/ρ0)^((γ-1)/2). ((2.63) of the thesis drops the background
// term.)
#pragma once
#include <cmath>

namespace aquagraph::fluid {

struct Tait {
    double reference_density;  // ρ0 [kg/m³]
    double sound_speed;        // c0 [m/s]
    double exponent = 7;       // γ: 7 water, 1.4 air

    double stiffness() const { return reference_density * sound_speed * sound_speed / exponent; }  // [Pa]
    // Water's γ = 7 has the exact forms x (7 + 21x + 35x² + …) and (1 + x)³: five times faster, and they vectorise.
    double pressure(double deviation) const {
        if (exponent == 7) {
            const double x = deviation / reference_density;
            return stiffness() * x * (7 + x * (21 + x * (35 + x * (35 + x * (21 + x * (7 + x))))));
        }
        return stiffness() * std::expm1(exponent * std::log1p(deviation / reference_density));
    }
    // Inverse of pressure(); p must exceed -ρ0 c0²/γ.
    double deviation(double pressure) const {
        return reference_density * std::expm1(std::log1p(pressure / stiffness()) / exponent);
    }
    double sound_speed_at(double deviation) const {
        if (exponent == 7) {
            const double ratio = 1 + deviation / reference_density;
            return sound_speed * ratio * ratio * ratio;
        }
        return sound_speed * std::exp(0.5 * (exponent - 1) * std::log1p(deviation / reference_density));
    }
};

}  // namespace aquagraph::fluid
