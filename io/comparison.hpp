// How far a computed column is from a reference curve.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "io/history.hpp"
#include "io/scene.hpp"

namespace aquagraph::io {

struct Curve {
    std::vector<double> time;   // [s], ascending
    std::vector<double> value;  // in the unit of the column
};

// Two columns parted by commas, semicolons, tabs or blanks. Above the first line with two numbers anything may stand,
// below it empty lines and comments (#). The scales and the offset of `compare` are applied and the points put in
// ascending time. Throws std::system_error where the file cannot be read and std::runtime_error, with the line, where
// it holds no point or a line that is none.
Curve read_reference(const Compare& compare);

// `compare.formula` at `points` evenly spaced times of the window.
Curve sampled_formula(const Compare& compare, const Constants& constants, std::size_t points = 1001);

struct Comparison {
    std::string column, unit, label;
    std::filesystem::path file;        // empty where the reference is a formula …
    std::string formula;               // … this one
    bool error = true;                 // false: drawn only
    std::array<double, 2> window{};    // [s]
    Curve reference;                   // the whole of it
    std::size_t points = 0;            // reference points compared: inside the window and the computed time
    std::size_t points_in_window = 0;  // more than `points` where the run ended before the window
    double rms = 0;                    // root mean square of computed - reference [unit]
    double peak = 0;                   // largest |reference| in the window [unit]
    double normalised = 0;             // rms / the scale of `compare`, or / peak; 0 where that is 0
    double mean = 0;                   // mean of computed - reference: the bias [unit]
    double largest = 0;                // largest |computed - reference| [unit]
    double largest_time = 0;           // where that is [s]
};

// The computed column, interpolated linearly at the times of the reference. With no point to compare all errors are
// NaN. Throws std::out_of_range where the history has no such column. constants: for formulas, all_constants(scene).
Comparison compare_with(const Compare& compare, const History& history, const Constants& constants = {});

}  // namespace aquagraph::io
