// A quantity over time as a scene says it: of prescribed motions and of loads. What is given adds up; what it means
// says physics/time_law.hpp.
#pragma once
#include <array>
#include <filesystem>
#include <vector>

namespace aquagraph::io {

// In the unit of the quantity.
struct TimeLawScene {
    double value = 0;                           // from the start
    double rate = 0;                            // grows by this per second …
    double amplitude = 0;                       // … and swings by this
    double frequency = 0;                       // [Hz]
    double phase = 0;                           // [rad]
    double ramp = 0;                            // [s], of rate and amplitude
    std::vector<std::array<double, 2>> points;  // time [s] and what it is then …
    std::filesystem::path table;                // … or a file of two columns (absolute once read)
};

}  // namespace aquagraph::io
