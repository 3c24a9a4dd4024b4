// report.html: one file that opens by double click and shows what was computed, how it compares and where the time
// went.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/comparison.hpp"
#include "io/flow_record.hpp"
#include "io/history.hpp"
#include "io/scene.hpp"

namespace aquagraph::io {

enum class RunOutcome { finished, interrupted, failed };

struct TaskTiming {
    std::string name;    // "fluxes"
    std::string family;  // "fluid", "solid", "coupling", "output": its colour
    double seconds = 0;  // wall-clock time inside the task, all calls
    std::size_t calls = 0;
    double pairs = 0;  // particle pairs (or what work_name says) treated in all; 0: not counted
    std::string work_name = "pairs";
};

struct KeyNumber {
    std::string label;  // "Wall-clock time"
    std::string value;  // "12.3"
    std::string unit;   // "s"; may be empty
    std::string note;   // a few words below it; may be empty
};

struct Report {
    RunOutcome outcome = RunOutcome::finished;
    std::string message;      // why it was interrupted or failed; shown at the top
    double reached_time = 0;  // [s]
    std::vector<KeyNumber> key_numbers;
    std::vector<TaskTiming> tasks;
    double wall_seconds = 0;  // of the whole run; shares are of this
    nlohmann::json summary;   // shown folded
};

// `flow` may hold no frame, `history` no row: those parts are then left out. Written atomically; throws
// std::system_error.
void write_report(const std::filesystem::path& file, const Scene& scene, const Report& report, const History& history,
                  const std::vector<Comparison>& comparisons, const FlowRecord& flow);

}  // namespace aquagraph::io
