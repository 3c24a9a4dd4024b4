// summary.json: what a program would want to know of a run.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/comparison.hpp"

namespace aquagraph::io {

// Written atomically, indented; NaN and infinities become null. Throws std::system_error.
void write_summary(const std::filesystem::path& file, const nlohmann::json& summary);

// The part of it that a comparison is: column, unit, label, file name or formula, window_s, points, points_in_window,
// rms, normalised_rms, peak, mean_error, largest_error, largest_error_time_s.
nlohmann::json to_json(const Comparison& comparison);

}  // namespace aquagraph::io
