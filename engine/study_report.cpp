#include "engine/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>

#include "engine/study_coupling_table.hpp"
#include "engine/version.hpp"
#include "io/atomic_file.hpp"

namespace aquagraph::engine {

namespace {

double median(std::vector<double> values) {
    if (values.empty()) return NAN;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double median_of(const StudyResult& result, double RunRecord::*time) {
    std::vector<double> values;
    for (const RunRecord& record : result.repeats)
        if (record.failure.empty()) values.push_back(record.*time);
    return median(std::move(values));
}

const RunRecord* good_repeat(const StudyResult& result) {
    for (const RunRecord& record : result.repeats)
        if (record.failure.empty()) return &record;
    return nullptr;
}

// The error that is drawn and multiplied with time.
const RunError* main_error(const io::StudyCase& one, const RunRecord& record) {
    for (const RunError& error : record.errors)
        if (one.error.empty() || error.label == one.error) return &error;
    return nullptr;
}

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
                if (const RunRecord* record = good_repeat(*result)) {
                    if (columns_.empty()) columns_ = record->errors;
                    has_water_ = record->particles > 0;
                }
    }

    std::string text() const {
        std::string text =
            fmt::format("| variant | {} | {} |", in_a_cell(case_.resolution_key), has_water_ ? "particles" : "nodes");
        for (const RunError& error : columns_) text += fmt::format(" {} | p |", in_a_cell(error.label));
        text += has_water_ ? " evaluations |" : " Newton iterations |";
        text += " CPU [s] | wall [s] | wall × error [s] |\n|---|---|---|";
        for (std::size_t k = 0; k < columns_.size(); ++k) text += "---|---|";
        text += "---|---|---|---|\n";
        for (const std::string& name : case_.variants)
            for (const auto& [variant, levels] : by_variant_)
                if (study_.variants[variant].name == name) text += rows(variant, levels);
        return text;
    }

  private:
    std::string rows(std::size_t variant, const std::vector<const StudyResult*>& levels) const {
        std::string text, label = study_.variants[variant].label;
        const RunRecord* coarser = nullptr;
        double coarser_h = 0;
        for (const StudyResult* result : levels) {
            text += fmt::format("| {} | {:g} |", in_a_cell(label), result->run.resolution);
            const RunRecord* record = good_repeat(*result);
            if (!record) {
                text += fmt::format(" | failed: {} |",
                                    in_a_cell(result->repeats.empty() ? "not run" : result->repeats[0].failure));
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
            const double wall = median_of(*result, &RunRecord::wall_seconds);
            const RunError* main = main_error(case_, *record);
            text += fmt::format(
                " {} | {:.3g} | {:.3g} | {} |\n", has_water_ ? record->evaluations : record->newton_iterations,
                median_of(*result, &RunRecord::cpu_seconds), wall,
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

// Within double quotes of gnuplot.
std::string in_quotes(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\' || c == '`') result += '\\';
        result += c;
    }
    return result + '"';
}

}  // namespace

std::string line_style(std::size_t k) {
    constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                    "#8c564b", "#5e3c99", "#000000", "#a6a61d", "#e41a1c", "#7f7f7f"};
    constexpr std::array points = {7, 5, 9, 13, 11, 6, 4, 8, 12};  // gnuplot's: filled ones, then open ones
    return fmt::format("linecolor rgb \"{}\" dashtype {} pointtype {}", colours[k % colours.size()],
                       1 + k / colours.size() % 4, points[k % points.size()]);
}

double observed_order(double coarse_error, double fine_error, double coarse_h, double fine_h) {
    if (!(coarse_error > 0) || !(fine_error > 0) || !(coarse_h > 0) || !(fine_h > 0) || coarse_h == fine_h) return NAN;
    return std::log(coarse_error / fine_error) / std::log(coarse_h / fine_h);
}

std::string study_markdown(const io::Study& study, const std::vector<StudyResult>& results,
                           const std::vector<std::string>& plots, int threads, bool coarse) {
    std::size_t repeats = 0;
    for (const StudyResult& result : results) repeats = std::max(repeats, result.repeats.size());
    std::string text = fmt::format(
        "## {}{}\n\nWritten by `./aquagraph study {}{}`, version {}, {} thread{}, {}. Errors are the NRMS of each "
        "comparison, p their observed order from one resolution to the next; CPU is the time of all threads.\n",
        study.title, coarse ? ", coarse" : "", (study.file.parent_path().filename() / study.file.filename()).string(),
        coarse ? " --coarse" : "", version, threads, threads == 1 ? "" : "s",
        repeats > 1 ? fmt::format("medians of {} runs in turn", repeats) : "one run each");
    for (std::size_t c = 0; c < study.cases.size(); ++c) {
        if (std::none_of(results.begin(), results.end(),
                         [&](const StudyResult& result) { return result.run.study_case == c; }))
            continue;
        text += fmt::format("\n### {}\n\n", study.cases[c].title.empty() ? study.cases[c].name : study.cases[c].title);
        if (!study.cases[c].curve.empty()) text += coupling_table(study, c, results, threads) + "\n";
        text += CaseTable(study, c, results).text();
        if (c < plots.size() && !plots[c].empty())
            text += fmt::format("\n![{}: error against wall time]({})\n", study.cases[c].name, plots[c]);
    }
    return text;
}

std::vector<std::filesystem::path> draw_plots(const io::Study& study, const std::vector<StudyResult>& results,
                                              const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files(study.cases.size());
    if (std::system("gnuplot --version > /dev/null 2>&1") != 0) return files;
    std::filesystem::create_directories(folder);
    for (std::size_t c = 0; c < study.cases.size(); ++c) {
        const io::StudyCase& one = study.cases[c];
        std::string data, lines, quantity;
        std::size_t drawn = 0;
        for (const std::string& name : one.variants) {
            std::string points, label;
            for (const StudyResult& result : results) {
                const io::StudyVariant& variant = study.variants[result.run.variant];
                const RunRecord* record = good_repeat(result);
                if (result.run.study_case != c || variant.name != name || !record) continue;
                const RunError* error = main_error(one, *record);
                if (!error || !(error->normalised > 0)) continue;
                label = variant.label;
                quantity = error->label;
                points += fmt::format("{} {}\n", median_of(result, &RunRecord::wall_seconds), 100 * error->normalised);
            }
            if (points.empty()) continue;
            const std::string block = fmt::format("${}", name);
            data += fmt::format("{} << EOD\n{}EOD\n", block, points);
            lines += fmt::format("{}{} with linespoints {} title {}", lines.empty() ? "" : ", ", block,
                                 line_style(drawn++), in_quotes(label));
        }
        if (lines.empty()) continue;
        const std::filesystem::path file = folder / fmt::format("{}_{}.svg", study.name, one.name),
                                    script = folder / fmt::format("{}_{}.gnuplot", study.name, one.name);
        io::write_file_atomically(
            script,
            fmt::format("set terminal svg size 640,420 font \"sans-serif,12\" background rgb \"white\" noenhanced\n"
                        "set output {}\nset logscale xy\nset grid\nset key outside right top\n"
                        "set title {}\nset xlabel \"wall time [s]\"\nset ylabel {}\n{}plot {}\n",
                        in_quotes(file.string()), in_quotes(one.title.empty() ? one.name : one.title),
                        in_quotes(quantity + " [%]"), data, lines));
        const int failed = std::system(fmt::format("gnuplot '{}' > /dev/null 2>&1", script.string()).c_str());
        std::filesystem::remove(script);
        if (failed == 0) files[c] = file;
    }
    return files;
}

void put_section(const std::filesystem::path& file, const std::string& name, const std::string& section) {
    const std::string begin = fmt::format("<!-- begin study {} -->", name),
                      end = fmt::format("<!-- end study {} -->", name);
    std::string text = std::filesystem::exists(file) ? io::read_file(file) : "# Measured results\n";
    const std::string block = begin + "\n" + section + end;
    const std::size_t from = text.find(begin), to = text.find(end);
    if ((from == std::string::npos) != (to == std::string::npos) || (from != std::string::npos && to < from))
        throw std::runtime_error(
            fmt::format("{} has not both \"{}\" and, after it, \"{}\": put the missing one in, or "
                        "take the other one out",
                        file.string(), begin, end));
    if (from != std::string::npos)
        text.replace(from, to + end.size() - from, block);
    else
        text += (text.ends_with('\n') ? "\n" : "\n\n") + block + "\n";
    io::write_file_atomically(file, text);
}

}  // namespace aquagraph::engine
