#include "io/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "io/atomic_file.hpp"

namespace aquagraph::io {
namespace {

bool parts(char c) {
    return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r';
}

void skip_parting(std::string_view& line) {
    while (!line.empty() && parts(line.front())) line.remove_prefix(1);
}

// The next number of the line; false where something else stands there.
bool number(std::string_view& line, double& value) {
    skip_parting(line);
    if (line.starts_with('+')) line.remove_prefix(1);
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) return false;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return line.empty() || parts(line.front());
}

// Between the two samples around t; t lies within the series.
double interpolated(std::span<const double> time, std::span<const double> value, double t) {
    const auto after = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin());
    if (after == 0) return value.front();
    const double width = time[after] - time[after - 1];
    const double weight = width > 0 ? (t - time[after - 1]) / width : 1;
    return value[after - 1] + weight * (value[after] - value[after - 1]);
}

}  // namespace

Curve read_reference(const Compare& compare) {
    const std::string text = read_file(compare.file);
    std::vector<std::pair<double, double>> points;
    std::size_t line_number = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view whole = rest.substr(0, end);
        std::string_view line = whole;
        rest.remove_prefix(std::min(end + 1, rest.size()));
        ++line_number;
        double time = 0, value = 0;
        if (number(line, time) && number(line, value)) {
            points.emplace_back(compare.time_scale * time, compare.value_scale * value + compare.value_offset);
            continue;
        }
        // Words stand above the numbers; among them a line that is none is a point that would be lost.
        line = whole;
        skip_parting(line);
        if (points.empty() || line.empty() || line.front() == '#') continue;
        throw std::runtime_error(fmt::format("{}:{}: two numbers are expected, but there stands `{}`",
                                             compare.file.lexically_normal().string(), line_number,
                                             line.substr(0, line.find_last_not_of(" \t\r") + 1).substr(0, 40)));
    }
    if (points.empty())
        throw std::runtime_error(fmt::format("{} holds no line with two numbers", compare.file.string()));
    std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Curve curve;
    for (const auto& [time, value] : points) {
        curve.time.push_back(time);
        curve.value.push_back(value);
    }
    return curve;
}

Curve sampled_formula(const Compare& compare, const Constants& constants, std::size_t points) {
    const Expression expression(compare.formula, {"t"}, constants);
    Curve curve;
    for (std::size_t i = 0; i < points; ++i) {
        const double part = double(i) / double(points - 1);
        const double t = (1 - part) * compare.window[0] + part * compare.window[1];
        curve.time.push_back(t);
        curve.value.push_back(compare.value_scale * expression(std::array{t}) + compare.value_offset);
    }
    return curve;
}

Comparison compare_with(const Compare& compare, const History& history, const Constants& constants) {
    Comparison result;
    result.column = compare.column;
    result.label = compare.label;
    result.file = compare.file;
    result.formula = compare.formula;
    result.error = compare.error;
    result.window = compare.window;
    result.reference = compare.formula.empty() ? read_reference(compare) : sampled_formula(compare, constants);
    const std::span<const double> computed = history.column(compare.column), time = history.time();
    result.unit = history.columns[*history.find(compare.column)].unit;

    const double start = compare.change && !computed.empty() ? computed.front() : 0;
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < result.reference.time.size(); ++i) {
        const double t = result.reference.time[i], expected = result.reference.value[i];
        if (t < compare.window[0] || t > compare.window[1]) continue;
        ++result.points_in_window;
        result.peak = std::max(result.peak, std::abs(expected));
        if (time.empty() || t < time.front() || t > time.back()) continue;
        const double difference = interpolated(time, computed, t) - start - expected;
        ++result.points;
        squares += difference * difference;
        sum += difference;
        // Written so that a NaN in the history shows.
        if (!(std::abs(difference) <= result.largest)) {
            result.largest = std::abs(difference);
            result.largest_time = t;
        }
    }
    if (result.points == 0) {
        result.rms = result.normalised = result.mean = result.largest = result.largest_time =
            std::numeric_limits<double>::quiet_NaN();
        return result;
    }
    result.rms = std::sqrt(squares / static_cast<double>(result.points));
    result.mean = sum / static_cast<double>(result.points);
    const double scale = compare.scale.value_or(result.peak);
    result.normalised = scale > 0 ? result.rms / scale : 0;
    return result;
}

}  // namespace aquagraph::io
