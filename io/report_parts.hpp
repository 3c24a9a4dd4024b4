// The parts that io/report.cpp puts together: tables as HTML, plots and flow as JSON for the scripts in
// io/report_assets.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/report.hpp"

namespace aquagraph::io {

std::string html_escaped(std::string_view text);
// Three significant digits with an SI prefix where the unit takes one: (0.00402, "m") -> "4.02 mm".
std::string quantity(double value, std::string_view unit);
// To six digits: more than a plot shows, and the file stays small.
double rounded(double value);
// "12.3 s", "4 min 05 s", "2 h 10 min".
std::string duration(double seconds);

std::string key_number_cards(const Report& report, const std::vector<Comparison>& comparisons);
std::string comparison_table(const std::vector<Comparison>& comparisons);
std::string task_table(const Report& report);
std::string parameter_tables(const Scene& scene);

// [{id, title, unit, series: [{label, kind, points: [t0, v0, t1, v1, …]}], windows: [[from, to], …]}, …]: first a plot
// for each compared column, with compared = true, then the other columns of the history grouped by unit.
nlohmann::json plots(const History& history, const std::vector<Comparison>& comparisons);

// {view: [min…, max…], spacing, walls, fields: [{name, unit, low, high}], frames: [{t, n, every, at, values: […],
// outlines}]}; positions and values quantised, base64. null where there is no frame.
nlohmann::json flow_player(const Scene& scene, const FlowRecord& flow);

}  // namespace aquagraph::io
