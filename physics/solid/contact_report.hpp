// What a contact with the ground is seen to do.
#pragma once
#include <array>
#include <vector>

namespace aquagraph::solid {

// A Gauss point that touches the ground.
template <int D>
struct ContactPoint {
    std::array<double, D> position{};
    double pressure = 0;               // per deformed area [Pa]
    std::array<double, D> friction{};  // on the body, per deformed area [Pa]
    double area = 0;                   // deformed [m²]
};

template <int D>
struct ContactReport {
    std::array<double, D> force{};  // on the body [N]
    double area = 0;                // deformed area in contact [m²]
    double largest_pressure = 0;    // [Pa]
    std::vector<ContactPoint<D>> points;
};

}  // namespace aquagraph::solid
