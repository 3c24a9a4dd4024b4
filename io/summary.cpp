#include "io/summary.hpp"

#include "io/atomic_file.hpp"

namespace aquagraph::io {

// The JSON library writes NaN and infinities as null by itself.
void write_summary(const std::filesystem::path& file, const nlohmann::json& summary) {
    write_file_atomically(file, summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

nlohmann::json to_json(const Comparison& comparison) {
    return {{"column", comparison.column},
            {"unit", comparison.unit},
            {"label", comparison.label},
            {"file", comparison.file.filename().string()},
            {"formula", comparison.formula},
            {"window_s", comparison.window},
            {"points", comparison.points},
            {"points_in_window", comparison.points_in_window},
            {"rms", comparison.rms},
            {"normalised_rms", comparison.normalised},
            {"peak", comparison.peak},
            {"mean_error", comparison.mean},
            {"largest_error", comparison.largest},
            {"largest_error_time_s", comparison.largest_time}};
}

}  // namespace aquagraph::io
