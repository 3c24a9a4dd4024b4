#include "engine/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include "engine/study_coupling_table.hpp"
#include "engine/version.hpp"
#include "io/atomic_file.hpp"
#include "io/wording.hpp"

namespace aquagraph::engine {

namespace {

// Only a comparison without a point within the run has an error that is no number.
std::string percent(double error) {
    return std::isfinite(error) ? fmt::format("{:.3g} %", 100 * error) : "outside the run";
}

// A bar would end the cell.
std::string in_a_cell(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '|') result += '\\';
        result += c;
    }
    return result;
}

class CaseTable {
  public:
    CaseTable(const io::Study& study, std::size_t number, const std::vector<StudyResult>& results)
        : study_(study), case_(study.cases[number]) {
        for (const StudyResult& result : results)
            if (result.run.study_case == number) by_variant_[result.run.variant].push_back(&result);
        for (const auto& [variant, levels] : by_variant_)
            for (const StudyResult* result : levels)
                if (const RunRecord* record = result->good()) {
                    if (columns_.empty()) columns_ = record->errors;
                    has_water_ = record->particles > 0;
                }
    }

    // Rows of these variants.
    std::string text(const std::vector<std::string>& variants) const {
        std::string text =
            fmt::format("| variant | {} | {} |", in_a_cell(case_.resolution_key), has_water_ ? "particles" : "nodes");
        for (const RunError& error : columns_) text += fmt::format(" {} | p |", in_a_cell(name_of(error)));
        text += has_water_ ? " evaluations |" : " Newton iterations |";
        text += " CPU [s] | wall [s] | wall × error [s] |\n|---|---|---|";
        for (std::size_t k = 0; k < columns_.size(); ++k) text += "---|---|";
        text += "---|---|---|---|\n";
        for (const std::string& name : variants)
            for (const auto& [variant, levels] : by_variant_)
                if (study_.variants[variant].name == name) text += rows(variant, levels);
        if (text.find("| failed: ") != std::string::npos)
            text += "\nWhat a failed run said in full is in `said.txt` of its folder, CASE/VARIANT_RESOLUTION.\n";
        return text;
    }

  private:
    // By its label, and by its column too where several have that label.
    std::string name_of(const RunError& error) const {
        const auto same = [&](const RunError& other) { return other.label == error.label; };
        return std::count_if(columns_.begin(), columns_.end(), same) > 1 ? error.column + ", " + error.label
                                                                         : error.label;
    }

    std::string rows(std::size_t variant, const std::vector<const StudyResult*>& levels) const {
        std::string text, label = study_.variants[variant].label;
        const RunRecord* coarser = nullptr;
        double coarser_h = 0;
        for (const StudyResult* result : levels) {
            text += fmt::format("| {} | {:g} |", in_a_cell(label), result->run.resolution);
            const RunRecord* record = result->good();
            if (!record) {
                text += fmt::format(
                    " | failed: {} |",
                    in_a_cell(result->repeats.empty() ? "not run" : short_reason(result->repeats[0].failure)));
                for (std::size_t k = 1; k < 2 * columns_.size() + 4; ++k) text += " |";
                text += "\n";
                coarser = nullptr;
                continue;
            }
            text += fmt::format(" {} |", has_water_ ? record->particles : record->nodes);
            for (std::size_t k = 0; k < columns_.size(); ++k) {
                const double error = k < record->errors.size() ? record->errors[k].normalised : NAN;
                const double p =
                    coarser && k < coarser->errors.size()
                        ? observed_order(coarser->errors[k].normalised, error, coarser_h, result->run.resolution)
                        : NAN;
                text += fmt::format(" {} | {} |", percent(error), std::isfinite(p) ? fmt::format("{:.1f}", p) : "");
            }
            const double wall = result->median(&RunRecord::wall_seconds);
            const RunError* main = main_error(case_, *record);
            text += fmt::format(
                " {} | {:.3g} | {:.3g} | {} |\n", has_water_ ? record->evaluations : record->newton_iterations,
                result->median(&RunRecord::cpu_seconds), wall,
                main && std::isfinite(main->normalised) ? fmt::format("{:.3g}", wall * main->normalised) : "–");
            coarser = record;
            coarser_h = result->run.resolution;
        }
        return text;
    }

    const io::Study& study_;
    const io::StudyCase& case_;
    std::map<std::size_t, std::vector<const StudyResult*>> by_variant_;  // coarse to fine
    std::vector<RunError> columns_;
    bool has_water_ = true;
};

std::string written_by(const io::Study& study, const std::vector<StudyResult>& results, int threads, bool coarse) {
    std::size_t repeats = 0;
    for (const StudyResult& result : results) repeats = std::max(repeats, result.repeats.size());
    return fmt::format("Written by `./aquagraph study {}{}`, version {}, {}, {}.",
                       (study.file.parent_path().filename() / study.file.filename()).string(),
                       coarse ? " --coarse" : "", version, io::counted(threads, "thread"),
                       repeats > 1 ? fmt::format("medians of {} runs in turn", repeats) : "one run each");
}

// A section's place in a text: from the first marker on, the second one included.
struct Section {
    std::string begin, end;
    std::size_t from = std::string::npos, to = std::string::npos;

    Section(const std::filesystem::path& file, const std::string& text, const std::string& name)
        : begin(fmt::format("<!-- begin study {} -->", name)), end(fmt::format("<!-- end study {} -->", name)) {
        from = text.find(begin);
        const std::size_t last = text.find(end);
        if ((from == std::string::npos) != (last == std::string::npos) || (there() && last < from))
            throw std::runtime_error(fmt::format(
                "{} has not both \"{}\" and, after it, \"{}\": put the missing one in, or take the other one "
                "out",
                file.string(), begin, end));
        if (there()) to = last + end.size();
    }
    bool there() const { return from != std::string::npos; }
};

}  // namespace

double observed_order(double coarse_error, double fine_error, double coarse_h, double fine_h) {
    if (!(coarse_error > 0) || !(fine_error > 0) || !(coarse_h > 0) || !(fine_h > 0) || coarse_h == fine_h) return NAN;
    return std::log(coarse_error / fine_error) / std::log(coarse_h / fine_h);
}

std::string short_reason(const std::string& failure) {
    std::size_t begin = 0;
    constexpr std::string_view task = "in task '", after = "': ";
    if (failure.starts_with(task))
        if (const std::size_t named = failure.find(after, task.size()); named != std::string::npos)
            begin = named + after.size();
    return failure.substr(begin, std::min(failure.find(" (", begin), failure.find(". ", begin)) - begin);
}

std::string study_markdown(const io::Study& study, const std::vector<StudyResult>& results, const StudyPlots& plots,
                           int threads, bool coarse) {
    std::string text = fmt::format(
        "## {}{}\n\n{} Errors are the NRMS of each comparison, p their observed order from one resolution to "
        "the next; CPU is the time of all threads.\n",
        study.title, coarse ? ", coarse" : "", written_by(study, results, threads, coarse));
    for (std::size_t c = 0; c < study.cases.size(); ++c) {
        const io::StudyCase& one = study.cases[c];
        if (std::none_of(results.begin(), results.end(),
                         [&](const StudyResult& result) { return result.run.study_case == c; }))
            continue;
        text += fmt::format("\n### {}\n\n", one.title.empty() ? one.name : one.title);
        if (!one.curve.empty()) text += coupling_table(study, c, results, threads) + "\n";
        text += CaseTable(study, c, results).text(one.variants);
        if (c < plots.errors.size() && !plots.errors[c].empty())
            text += fmt::format("\n![{}: error against wall time]({})\n", one.name, plots.errors[c]);
        if (c < plots.speedups.size() && !plots.speedups[c].empty())
            text += fmt::format("\n![{}: speedup and its theory]({})\n", one.name, plots.speedups[c]);
    }
    return text;
}

std::string case_markdown(const io::Study& study, std::size_t number, const std::vector<StudyResult>& results,
                          int threads, const std::string& everything) {
    const io::StudyCase& one = study.cases[number];
    std::vector<std::string> variants;
    std::copy_if(one.variants.begin(), one.variants.end(), std::back_inserter(variants), [&](const std::string& name) {
        return std::find(study.readme.begin(), study.readme.end(), name) != study.readme.end();
    });
    return fmt::format("{}\n{} NRMS of each comparison, p: observed order, CPU: time of all threads; {} in [{}]({}).\n",
                       CaseTable(study, number, results).text(variants), written_by(study, results, threads, false),
                       variants.size() < one.variants.size() ? "all variants and a plot" : "a plot",
                       std::filesystem::path(everything).filename().string(), everything);
}

bool has_section(const std::filesystem::path& file, const std::string& name) {
    return std::filesystem::exists(file) && Section(file, io::read_file(file), name).there();
}

void put_section(const std::filesystem::path& file, const std::string& name, const std::string& section) {
    std::string text = std::filesystem::exists(file) ? io::read_file(file) : "# Measured results\n";
    const Section place(file, text, name);
    const std::string block = place.begin + "\n" + section + place.end;
    if (place.there())
        text.replace(place.from, place.to - place.from, block);
    else
        text += (text.ends_with('\n') ? "\n" : "\n\n") + block + "\n";
    io::write_file_atomically(file, text);
}

}  // namespace aquagraph::engine
