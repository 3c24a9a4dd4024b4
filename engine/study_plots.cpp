#include "engine/study_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "engine/child_process.hpp"
#include "engine/study_speedup.hpp"
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

constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                "#8c564b", "#5e3c99", "#000000", "#a6a61d", "#e41a1c", "#7f7f7f"};
std::string line_colour(std::size_t k) {
    return fmt::format("linecolor rgb \"{}\"", colours[k % colours.size()]);
}

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

// In pixels: of the plot, of what it has without a key, of a line of the key.
constexpr std::size_t width = 680, height = 420, line_height = 18;

// The key stands below the plot, which keeps its size: as many columns as fit, a single line needs none.
class Key {
  public:
    explicit Key(const std::vector<Line>& lines) : lines_(lines.size()) {
        for (const Line& line : lines) longest_ = std::max(longest_, characters(line.label));
    }
    std::size_t rows() const {
        if (lines_ == 1) return 0;
        const std::size_t columns = std::max<std::size_t>(1, (width - 20) / (13 * longest_ / 2 + 55));
        return (lines_ + columns - 1) / columns;
    }
    std::string text() const {
        if (lines_ == 1) return "unset key\n";
        // gnuplot takes letters for a fifth wider than they are.
        return fmt::format(
            "set key outside bottom center vertical Left reverse maxrows {} width -{} height 1 samplen 3\n", rows(),
            longest_ / 5);
    }

  private:
    std::size_t lines_, longest_ = 0;
};

// Everything but the lines themselves: file, size, axes, title, key.
std::string frame(const std::string& file, const io::StudyCase& one, const Key& key, const std::string& axes,
                  const std::string& x, const std::string& y) {
    return fmt::format(
        "set terminal svg size {},{} font \"sans-serif,12\" background rgb \"white\" noenhanced\nset output {}\n"
        "set grid\n{}{}set title {}\nset xlabel {}\nset ylabel {}\n",
        width, height + line_height * key.rows(), quoted(file), axes, key.text(),
        quoted(one.title.empty() ? one.name : one.title), quoted(x), quoted(y));
}

// What is drawn for one case.
class CasePlot {
  public:
    static constexpr std::string_view suffix = "";

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
        return frame(file, case_, Key(lines_), "set logscale xy\n" + time_.axis("x") + error_.axis("y"),
                     "wall time [s]", quantity_ + " [%]") +
               data + plot + "\n";
    }

  private:
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

    const io::StudyCase& case_;
    std::string quantity_;
    std::vector<Line> lines_;
    Range time_, error_;
};

// Speedup against the axis that is to give it.
class SpeedupPlot {
  public:
    static constexpr std::string_view suffix = "_speedup";

    SpeedupPlot(const io::Study& study, std::size_t number, const std::vector<StudyResult>& results, int threads)
        : case_(study.cases[number]) {
        const int axis = speedup_axis(study, case_);
        if (axis < 0) return;
        axis_ = study.axes[std::size_t(axis)].name;
        for (const double resolution : case_.resolutions)
            for (const std::string& first : case_.variants) {
                const auto variant = std::find_if(study.variants.begin(), study.variants.end(),
                                                  [&](const io::StudyVariant& v) { return v.name == first; });
                if (variant == study.variants.end() || variant->place[std::size_t(axis)] != 0) continue;
                Line measured, theory;
                for (const StudyResult& result : results) {
                    const io::StudyVariant& other = study.variants[result.run.variant];
                    std::vector<int> place = other.place;
                    place[std::size_t(axis)] = 0;
                    if (result.run.study_case != number || result.run.resolution != resolution ||
                        place != variant->place || other.base != variant->base)
                        continue;
                    const std::string& value =
                        study.axes[std::size_t(axis)].values[std::size_t(other.place[std::size_t(axis)])];
                    const Speedup of = speedup_of(study, results, result, threads);
                    if (std::isfinite(of.measured)) measured.points += fmt::format("{} {}\n", value, of.measured);
                    if (std::isfinite(of.shared)) theory.points += fmt::format("{} {}\n", value, of.shared);
                    values_.push_back(value);
                }
                if (measured.points.empty()) continue;
                measured.label = fmt::format("{}, {:g}", without_axis(variant->label), resolution);
                measured_.push_back(measured);
                theory_.push_back(theory);
            }
    }

    bool empty() const { return measured_.empty(); }

    std::string script(const std::string& file) const {
        std::string data, plot = "plot ";
        for (std::size_t k = 0; k < measured_.size(); ++k) {
            data += fmt::format("$line{} << EOD\n{}EOD\n$theory{} << EOD\n{}EOD\n", k, measured_[k].points, k,
                                theory_[k].points);
            plot += fmt::format("{}$line{} with linespoints {} title {}, $theory{} with lines {} dashtype 2 notitle",
                                k > 0 ? ", " : "", k, line_style(k), quoted(measured_[k].label), k, line_colour(k));
        }
        std::string tics;
        double low = INFINITY, high = 0;
        for (const std::string& value : values_) {
            tics += (tics.empty() ? "" : ", ") + value;
            low = std::min(low, std::atof(value.c_str()));
            high = std::max(high, std::atof(value.c_str()));
        }
        return frame(file, case_, Key(measured_),
                     fmt::format("set logscale x\nset xrange [{}:{}]\nset yrange [0:*]\nset xtics ({})\n", low / 1.1,
                                 high * 1.1, tics),
                     axis_, "speedup; dashed: theory on as many threads") +
               data + plot + "\n";
    }

  private:
    // "cps, p = 1, fixed" without what the axis says.
    std::string without_axis(const std::string& label) const {
        std::string text;
        for (const std::string& part : parts_of(label))
            if (!part.starts_with(axis_ + " = ")) text += (text.empty() ? "" : ", ") + part;
        return text;
    }

    const io::StudyCase& case_;
    std::string axis_;
    std::vector<std::string> values_;  // of the axis
    std::vector<Line> measured_, theory_;
};

// One plot for each case that has something to draw.
template <class PlotOf>
std::vector<std::filesystem::path> draw(const io::Study& study, const std::filesystem::path& folder, bool coarse,
                                        const PlotOf& plot_of) {
    std::vector<std::filesystem::path> files(study.cases.size());
    if (!gnuplot("--version")) return files;
    io::make_folder(folder);
    for (std::size_t c = 0; c < study.cases.size(); ++c) {
        const auto plot = plot_of(c);
        if (plot.empty()) continue;
        const std::string name =
            fmt::format("{}_{}{}{}", study.name, study.cases[c].name, plot.suffix, coarse ? "-coarse" : "");
        const std::filesystem::path file = folder / (name + ".svg"), script = folder / (name + ".gnuplot");
        io::write_file_atomically(script, plot.script(file.string()));
        if (gnuplot(script.string())) files[c] = file;
        std::filesystem::remove(script);
    }
    return files;
}

}  // namespace

std::string line_style(std::size_t k) {
    constexpr std::array points = {7, 5, 9, 13, 11, 6, 4, 8, 12};  // gnuplot's: filled ones, then open ones
    return fmt::format("{} dashtype {} pointtype {}", line_colour(k), 1 + k / colours.size() % 4,
                       points[k % points.size()]);
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
    return draw(study, folder, coarse, [&](std::size_t c) { return CasePlot(study, c, results); });
}

std::vector<std::filesystem::path> draw_speedups(const io::Study& study, const std::vector<StudyResult>& results,
                                                 const std::filesystem::path& folder, int threads, bool coarse) {
    return draw(study, folder, coarse, [&](std::size_t c) { return SpeedupPlot(study, c, results, threads); });
}

}  // namespace aquagraph::engine
