#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "io/report_parts.hpp"

namespace aquagraph::io {
namespace {

// More points than a plot has pixels only make the file larger.
constexpr std::size_t buckets = 900;

void put(nlohmann::json& points, double time, double value) {
    points.push_back(rounded(time));
    // JSON has no NaN: a gap in the line.
    if (std::isfinite(value))
        points.push_back(rounded(value));
    else
        points.push_back(nullptr);
}

// The smallest and the largest of each bucket of rows, in their order: no spike is lost.
nlohmann::json line(std::span<const double> time, std::span<const double> value) {
    nlohmann::json points = nlohmann::json::array();
    const std::size_t rows = time.size();
    if (rows <= 2 * buckets) {
        for (std::size_t i = 0; i < rows; ++i) put(points, time[i], value[i]);
        return points;
    }
    for (std::size_t b = 0; b < buckets; ++b) {
        const std::size_t begin = b * rows / buckets, end = (b + 1) * rows / buckets;
        std::size_t low = begin, high = begin;
        for (std::size_t i = begin; i < end; ++i) {
            if (value[i] < value[low]) low = i;
            if (value[i] > value[high]) high = i;
        }
        put(points, time[std::min(low, high)], value[std::min(low, high)]);
        if (low != high) put(points, time[std::max(low, high)], value[std::max(low, high)]);
    }
    return points;
}

nlohmann::json compared_plot(const History& history, const std::string& column,
                             const std::vector<Comparison>& comparisons) {
    nlohmann::json series = nlohmann::json::array(), windows = nlohmann::json::array();
    std::set<std::string> drawn;
    std::string unit;
    for (const Comparison& c : comparisons) {
        if (c.column != column) continue;
        unit = c.unit;
        // A curve that is compared over several windows is drawn once.
        if (drawn.insert(c.formula.empty() ? c.file.string() : c.formula).second)
            series.push_back({{"label", c.label},
                              {"kind", c.error ? "measured" : "drawn"},
                              {"points", line(c.reference.time, c.reference.value)}});
        if (c.error) windows.push_back(c.window);
    }
    if (history.find(column))
        series.push_back(
            {{"label", "computed"}, {"kind", "computed"}, {"points", line(history.time(), history.column(column))}});
    return {{"title", column}, {"unit", unit}, {"compared", true}, {"series", series}, {"windows", windows}};
}

}  // namespace

double rounded(double value) {
    return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

nlohmann::json plots(const History& history, const std::vector<Comparison>& comparisons) {
    nlohmann::json all = nlohmann::json::array();
    std::vector<std::string> compared;
    for (const Comparison& c : comparisons)
        if (std::find(compared.begin(), compared.end(), c.column) == compared.end()) {
            compared.push_back(c.column);
            all.push_back(compared_plot(history, c.column, comparisons));
        }
    std::map<std::string, std::size_t> plot_of_unit;
    for (std::size_t i = 1; i < history.columns.size() && history.rows() > 1; ++i) {
        const HistoryColumn& column = history.columns[i];
        if (std::find(compared.begin(), compared.end(), column.name) != compared.end()) continue;
        const auto [place, is_new] = plot_of_unit.try_emplace(column.unit, all.size());
        if (is_new)
            all.push_back({{"title", ""},
                           {"unit", column.unit},
                           {"compared", false},
                           {"series", nlohmann::json::array()},
                           {"windows", nlohmann::json::array()}});
        all[place->second]["series"].push_back(
            {{"label", column.name}, {"kind", "computed"}, {"points", line(history.time(), history.values[i])}});
    }
    return all;
}

}  // namespace aquagraph::io
