#include "engine/study_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "engine/child_process.hpp"
#include "io/atomic_file.hpp"

namespace aquagraph::engine {

namespace {

// Whether gnuplot is there and has done what it was told.
bool gnuplot(const std::string& argument) {
    try {
        const ChildEnd end = run_child("gnuplot", {argument}, "/dev/null", 60, [] { return false; });
        return end.code == 0 && end.signal == 0 && !end.timed_out;
    } catch (const std::system_error&) {
        return false;
    }
}

// A text of gnuplot within single quotes, where nothing but they themselves means anything.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

std::size_t characters(const std::string& utf8) {
    return std::size_t(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// The range of a logarithmic axis, a little wider than what is drawn.
struct Range {
    double low = INFINITY, high = 0;

    void add(double value) {
        low = std::min(low, value / 1.2);
        high = std::max(high, value * 1.2);
    }
    std::string axis(const char* name) const {
        std::string tics;
        for (const double tic : logarithmic_tics(low, high))
            tics += fmt::format("{}'{:g}' {}", tics.empty() ? "" : ", ", tic, tic);
        return fmt::format("set {}range [{}:{}]\nset {}tics ({})\n", name, low, high, name, tics);
    }
};

struct Line {
    std::string label, points;
};

std::vector<std::string> parts_of(const std::string& label) {
    constexpr std::string_view parting = ", ";
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= label.size();) {
        const std::size_t end = std::min(label.find(parting, begin), label.size());
        parts.push_back(label.substr(begin, end - begin));
        begin = end + parting.size();
    }
    return parts;
}

// What is drawn for one case.
class CasePlot {
  public:
    CasePlot(const io::Study& study, std::size_t number, const std::vector<StudyResult>& results)
        : case_(study.cases[number]) {
        for (const std::string& name : case_.variants) {
            Line line;
            for (const StudyResult& result : results) {
                const io::StudyVariant& variant = study.variants[result.run.variant];
                if (result.run.study_case != number || variant.name != name) continue;
                line.label = variant.label;
                line.points += point(result);
            }
            if (!line.points.empty()) lines_.push_back(line);
        }
        std::vector<std::string> labels;
        for (const Line& line : lines_) labels.push_back(line.label);
        labels = telling_labels(labels);
        for (std::size_t k = 0; k < lines_.size(); ++k) lines_[k].label = labels[k];
    }

    bool empty() const { return lines_.empty(); }

    std::string script(const std::string& file) const {
        std::string data, plot;
        for (std::size_t k = 0; k < lines_.size(); ++k) {
            data += fmt::format("$line{} << EOD\n{}EOD\n", k, lines_[k].points);
            plot += fmt::format("{}$line{} with linespoints {} title {}", k > 0 ? ", " : "plot ", k, line_style(k),
                                quoted(lines_[k].label));
        }
        return fmt::format(
            "set terminal svg size {},{} font \"sans-serif,12\" background rgb \"white\" noenhanced\nset output {}\n"
            "set logscale xy\nset grid\n{}{}{}set title {}\nset xlabel 'wall time [s]'\nset ylabel {}\n{}{}\n",
            width, height + line_height * rows(), quoted(file), time_.axis("x"), error_.axis("y"), key(),
            quoted(case_.title.empty() ? case_.name : case_.title), quoted(quantity_ + " [%]"), data, plot);
    }

  private:
    // In pixels: of the plot, of what it has without a key, of a line of the key.
    static constexpr std::size_t width = 680, height = 420, line_height = 18;

    std::string point(const StudyResult& result) {
        const RunRecord* record = result.good();
        const RunError* error = record ? main_error(case_, *record) : nullptr;
        const double seconds = result.median(&RunRecord::wall_seconds);
        if (!error || !(error->normalised > 0) || !std::isfinite(error->normalised) || !(seconds > 0)) return "";
        quantity_ = error->label;
        time_.add(seconds);
        error_.add(100 * error->normalised);
        return fmt::format("{} {}\n", seconds, 100 * error->normalised);
    }

    std::size_t longest_label() const {
        std::size_t longest = 0;
        for (const Line& line : lines_) longest = std::max(longest, characters(line.label));
        return longest;
    }
    // The key stands below the plot, which keeps its size: as many columns as fit, a single line needs none.
    std::size_t rows() const {
        if (lines_.size() == 1) return 0;
        const std::size_t columns = std::max<std::size_t>(1, (width - 20) / (13 * longest_label() / 2 + 55));
        return (lines_.size() + columns - 1) / columns;
    }
    // gnuplot takes letters for a fifth wider than they are.
    std::string key() const {
        if (lines_.size() == 1) return "unset key\n";
        return fmt::format(
            "set key outside bottom center vertical Left reverse maxrows {} width -{} height 1 samplen 3\n", rows(),
            longest_label() / 5);
    }

    const io::StudyCase& case_;
    std::string quantity_;
    std::vector<Line> lines_;
    Range time_, error_;
};

}  // namespace

std::string line_style(std::size_t k) {
    constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                    "#8c564b", "#5e3c99", "#000000", "#a6a61d", "#e41a1c", "#7f7f7f"};
    constexpr std::array points = {7, 5, 9, 13, 11, 6, 4, 8, 12};  // gnuplot's: filled ones, then open ones
    return fmt::format("linecolor rgb \"{}\" dashtype {} pointtype {}", colours[k % colours.size()],
                       1 + k / colours.size() % 4, points[k % points.size()]);
}

std::vector<std::string> telling_labels(const std::vector<std::string>& labels) {
    std::vector<std::vector<std::string>> parts;
    for (const std::string& label : labels) parts.push_back(parts_of(label));
    const auto as_long = [&](const std::vector<std::string>& other) { return other.size() == parts.front().size(); };
    if (labels.size() < 2 || !std::all_of(parts.begin(), parts.end(), as_long)) return labels;
    std::vector<std::string> telling(labels.size());
    for (std::size_t k = 0; k < parts.front().size(); ++k) {
        const auto same = [&](const std::vector<std::string>& other) { return other[k] == parts.front()[k]; };
        if (std::all_of(parts.begin(), parts.end(), same)) continue;
        for (std::size_t i = 0; i < labels.size(); ++i) telling[i] += (telling[i].empty() ? "" : ", ") + parts[i][k];
    }
    return telling.front().empty() ? labels : telling;
}

std::vector<double> logarithmic_tics(double low, double high) {
    std::vector<double> tenths;
    for (int k = 10; k < 100; ++k) tenths.push_back(0.1 * k);
    std::vector<double> tics;
    for (const std::vector<double>& factors :
         {std::vector<double>{1, 2, 5}, {1, 1.5, 2, 3, 5, 7}, {1, 1.2, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8}, tenths}) {
        tics.clear();
        for (double power = std::floor(std::log10(low)); power <= std::log10(high); ++power)
            for (const double factor : factors)
                if (const double tic = factor * std::pow(10, power); tic >= low && tic <= high) tics.push_back(tic);
        if (tics.size() >= 3) break;
    }
    return tics;
}

std::vector<std::filesystem::path> draw_plots(const io::Study& study, const std::vector<StudyResult>& results,
                                              const std::filesystem::path& folder, bool coarse) {
    std::vector<std::filesystem::path> files(study.cases.size());
    if (!gnuplot("--version")) return files;
    io::make_folder(folder);
    for (std::size_t c = 0; c < study.cases.size(); ++c) {
        const CasePlot plot(study, c, results);
        if (plot.empty()) continue;
        const std::string name = fmt::format("{}_{}{}", study.name, study.cases[c].name, coarse ? "-coarse" : "");
        const std::filesystem::path file = folder / (name + ".svg"), script = folder / (name + ".gnuplot");
        io::write_file_atomically(script, plot.script(file.string()));
        if (gnuplot(script.string())) files[c] = file;
        std::filesystem::remove(script);
    }
    return files;
}

}  // namespace aquagraph::engine
