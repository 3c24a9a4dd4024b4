// What a study has found, as sections of Markdown files: all of it with a table and a plot per case, and a case's table
// alone for the README beside its scene.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/study_results.hpp"

namespace aquagraph::engine {

// p of e ~ h^p; NaN where an error is not a positive number.
double observed_order(double coarse_error, double fine_error, double coarse_h, double fine_h);

// Why a run failed, short enough for a cell of a table: without the task in which it did, what is in brackets and the
// sentences that say what to do. The run's said.txt has all of it.
std::string short_reason(const std::string& failure);

// The files of each case's plots, as the Markdown refers to them; empty: none.
struct StudyPlots {
    std::vector<std::string> errors, speedups;
};

// The section without its markers.
std::string study_markdown(const io::Study& study, const std::vector<StudyResult>& results, const StudyPlots& plots,
                           int threads, bool coarse);

// The table of one case with the variants that the study has for READMEs. everything: the file with the whole study, as
// the README refers to it.
std::string case_markdown(const io::Study& study, std::size_t number, const std::vector<StudyResult>& results,
                          int threads, const std::string& everything);

// Whether a file has the markers <!-- begin study NAME --> and <!-- end study NAME -->. Throws std::runtime_error where
// only one is there.
bool has_section(const std::filesystem::path& file, const std::string& name);

// Puts `section` between the markers of a file, at its end where it has none, and leaves all else as it is. Throws
// std::system_error, and as has_section.
void put_section(const std::filesystem::path& file, const std::string& name, const std::string& section);

}  // namespace aquagraph::engine
