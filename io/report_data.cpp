#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "io/report_parts.hpp"

namespace aquagraph::io {
namespace {

// More points than a plot has pixels only make the file larger.
constexpr std::size_t buckets = 900;

// Six digits are more than a plot shows and make the file small.
double rounded(double value) {
    return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

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
    std::set<std::filesystem::path> drawn;
    std::string unit;
    for (const Comparison& c : comparisons) {
        if (c.column != column) continue;
        unit = c.unit;
        // A curve that is compared over several windows is drawn once.
        if (drawn.insert(c.file).second)
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

std::string base64(std::span<const std::uint8_t> bytes) {
    static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : letters[three >> (18 - 6 * k) & 63U];
    }
    return text;
}

Box view_of(const Scene& scene, const FlowRecord& flow) {
    Box all{{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    const auto include = [&](double x, double y) {
        // What has left the domain is not worth shrinking the picture for.
        const Point inside{std::clamp(x, scene.domain.min[0], scene.domain.max[0]),
                           std::clamp(y, scene.domain.min[1], scene.domain.max[1])};
        for (std::size_t d = 0; d < 2; ++d) {
            all.min[d] = std::min(all.min[d], inside[d]);
            all.max[d] = std::max(all.max[d], inside[d]);
        }
    };
    for (const FlowRecord::Frame& frame : flow.frames()) {
        for (std::size_t i = 0; i < frame.x.size(); ++i)
            if (std::isfinite(frame.x[i]) && std::isfinite(frame.y[i])) include(frame.x[i], frame.y[i]);
        for (const auto& outline : frame.outlines)
            for (const Point& p : outline)
                if (std::isfinite(p[0]) && std::isfinite(p[1])) include(p[0], p[1]);
    }
    for (std::size_t d = 0; d < 2; ++d)
        if (!(all.min[d] < all.max[d])) all.min[d] = scene.domain.min[d], all.max[d] = scene.domain.max[d];
    const double margin = 0.04 * std::max(all.max[0] - all.min[0], all.max[1] - all.min[1]);
    for (std::size_t d = 0; d < 2; ++d) all.min[d] -= margin, all.max[d] += margin;
    return all;
}

// 0…65535 across the view; what lies outside or is NaN is put far out, where nothing is drawn.
void put_quantised(std::vector<std::uint8_t>& bytes, double value, double low, double high) {
    const double part = (value - low) / (high - low);
    const auto q = part >= 0 && part <= 1 ? static_cast<unsigned>(std::lround(65534 * part)) : 65535U;
    bytes.push_back(static_cast<std::uint8_t>(q & 255U));
    bytes.push_back(static_cast<std::uint8_t>(q >> 8));
}

using Field = std::vector<float> FlowRecord::Frame::*;

// The range that colours stand for: nearly all values, so that a single particle does not decide.
std::pair<double, double> colour_range(const FlowRecord& flow, Field field) {
    std::vector<float> sample;
    for (const FlowRecord::Frame& frame : flow.frames())
        for (std::size_t i = 0; i < (frame.*field).size(); i += 7)
            if (std::isfinite((frame.*field)[i])) sample.push_back((frame.*field)[i]);
    if (sample.empty()) return {0, 1};
    const auto at = [&](double part) {
        const auto place = sample.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(sample.size() - 1));
        std::nth_element(sample.begin(), place, sample.end());
        return static_cast<double>(*place);
    };
    const double low = std::min(0.0, at(0.01)), high = at(0.995);
    return {low, high > low ? high : low + 1};
}

nlohmann::json frame_json(const FlowRecord::Frame& frame, const Box& view,
                          const std::vector<std::pair<Field, std::pair<double, double>>>& fields) {
    std::vector<std::uint8_t> at;
    at.reserve(4 * frame.x.size());
    for (std::size_t i = 0; i < frame.x.size(); ++i) {
        put_quantised(at, frame.x[i], view.min[0], view.max[0]);
        put_quantised(at, frame.y[i], view.min[1], view.max[1]);
    }
    nlohmann::json values = nlohmann::json::array(), outlines = nlohmann::json::array();
    for (const auto& [field, range] : fields) {
        std::vector<std::uint8_t> bytes;
        for (const float value : frame.*field) {
            const double part = (value - range.first) / (range.second - range.first);
            bytes.push_back(
                static_cast<std::uint8_t>(std::isfinite(part) ? std::lround(255 * std::clamp(part, 0.0, 1.0)) : 0));
        }
        values.push_back(base64(bytes));
    }
    for (const auto& outline : frame.outlines) {
        nlohmann::json flat = nlohmann::json::array();
        for (const Point& p : outline) flat.push_back(rounded(p[0])), flat.push_back(rounded(p[1]));
        outlines.push_back(flat);
    }
    return {{"t", frame.time},  {"n", frame.x.size()}, {"every", frame.every},
            {"at", base64(at)}, {"values", values},    {"outlines", outlines}};
}

}  // namespace

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

nlohmann::json flow_player(const Scene& scene, const FlowRecord& flow) {
    if (flow.frames().empty()) return nullptr;
    const Box view = view_of(scene, flow);
    std::vector<std::pair<Field, std::pair<double, double>>> fields;
    nlohmann::json field_json = nlohmann::json::array(), frames = nlohmann::json::array(),
                   walls = nlohmann::json::array();
    const auto offer = [&](Field field, const char* name, const char* unit) {
        // A field that some frame lacks cannot be played.
        for (const FlowRecord::Frame& frame : flow.frames())
            if ((frame.*field).size() != frame.x.size()) return;
        fields.emplace_back(field, colour_range(flow, field));
        field_json.push_back({{"name", name},
                              {"unit", unit},
                              {"low", fields.back().second.first},
                              {"high", fields.back().second.second}});
    };
    offer(&FlowRecord::Frame::pressure, "pressure", "Pa");
    offer(&FlowRecord::Frame::speed, "speed", "m/s");
    for (const FlowRecord::Frame& frame : flow.frames()) frames.push_back(frame_json(frame, view, fields));
    for (const WallScene& wall : scene.walls) {
        nlohmann::json flat = nlohmann::json::array();
        for (const Point& p : wall.points) flat.push_back(p[0]), flat.push_back(p[1]);
        walls.push_back({{"points", flat}, {"closed", wall.closed}});
    }
    return {{"view", {view.min[0], view.min[1], view.max[0], view.max[1]}},
            {"spacing", flow.spacing()},
            {"walls", walls},
            {"fields", field_json},
            {"frames", frames}};
}

}  // namespace aquagraph::io
