// What a study has found, as a section of a Markdown file with a table and a plot per case.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/study_runs.hpp"
#include "io/study_file.hpp"

namespace aquagraph::engine {

// A run with all its repeats; those that went well are as good as the median of their times.
struct StudyResult {
    StudyRun run;
    std::vector<RunRecord> repeats;
};

// p of e ~ h^p; NaN where an error is not a positive number.
double observed_order(double coarse_error, double fine_error, double coarse_h, double fine_h);

// What gnuplot is to draw the k-th curve of a plot with: colour, dashes, points. No two of the first 36 are the same,
// and the first 12 differ in colour.
std::string line_style(std::size_t k);

// The section without its markers. plots: the file of each case's plot as the Markdown refers to it; empty: none.
std::string study_markdown(const io::Study& study, const std::vector<StudyResult>& results,
                           const std::vector<std::string>& plots, int threads, bool coarse);

// Draws error against wall time for each case of the study, one line per variant, with gnuplot, as
// FOLDER/NAME_CASE.svg. Returns the files; empty for a case with nothing to draw, and for all where gnuplot is not
// there.
std::vector<std::filesystem::path> draw_plots(const io::Study& study, const std::vector<StudyResult>& results,
                                              const std::filesystem::path& folder);

// Puts `section` between the markers <!-- begin study NAME --> and <!-- end study NAME --> of a file, at its end where
// it has none, and leaves all else as it is. Throws std::system_error; std::runtime_error where only one marker is
// there.
void put_section(const std::filesystem::path& file, const std::string& name, const std::string& section);

}  // namespace aquagraph::engine
