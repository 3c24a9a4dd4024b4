// Plots of a study, drawn by gnuplot: error against wall time, and speedup against the ratio that is to give it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/study_results.hpp"

namespace aquagraph::engine {

// What gnuplot is to draw the k-th curve of a plot with: colour, dashes, points. No two of the first 36 are the same,
// and the first 12 differ in colour.
std::string line_style(std::size_t k);

// Values with a label on a logarithmic axis within [low, high], 0 < low < high: 1, 2, 5 times powers of ten, where that
// makes fewer than three, steps in between, at last 1.0, 1.1, 1.2, ... of them.
std::vector<double> logarithmic_tics(double low, double high);

// Labels without what all of them say: parts between commas, where all have as many. "cps, p = 1" and "cps, p = 2"
// become "p = 1" and "p = 2".
std::vector<std::string> telling_labels(const std::vector<std::string>& labels);

// One plot for each case of the study, one line per variant, as FOLDER/NAME_CASE.svg, of the coarse study
// FOLDER/NAME_CASE-coarse.svg. Returns the files; empty for a case with nothing to draw, and for all where gnuplot is
// not there.
std::vector<std::filesystem::path> draw_plots(const io::Study& study, const std::vector<StudyResult>& results,
                                              const std::filesystem::path& folder, bool coarse);

// For each case with a `speedup` axis, as FOLDER/NAME_CASE_speedup.svg: what was measured, beside the theory where
// solve and fluid share the threads, against the axis. One pair of lines per resolution and choice of the other axes.
std::vector<std::filesystem::path> draw_speedups(const io::Study& study, const std::vector<StudyResult>& results,
                                                 const std::filesystem::path& folder, int threads, bool coarse);

}  // namespace aquagraph::engine
