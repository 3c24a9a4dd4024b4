// The flow as the report's player takes it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "io/report_parts.hpp"
#include "io/scene_surfaces.hpp"

namespace aquagraph::io {
namespace {

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

// The box that everything drawn lies in, with a margin.
Box view_of(const Scene& scene, const FlowRecord& flow) {
    const std::size_t dimension = scene.domain.min.size();
    Box all = scene.domain;
    for (std::size_t d = 0; d < dimension; ++d) all.min[d] = INFINITY, all.max[d] = -INFINITY;
    const auto include = [&](std::initializer_list<double> place) {
        if (!std::all_of(place.begin(), place.end(), [](double x) { return std::isfinite(x); })) return;
        std::size_t d = 0;
        for (const double x : place) {
            // What has left the domain is not worth shrinking the picture for.
            const double inside = std::clamp(x, scene.domain.min[d], scene.domain.max[d]);
            all.min[d] = std::min(all.min[d], inside);
            all.max[d] = std::max(all.max[d], inside);
            ++d;
        }
    };
    for (const FlowRecord::Frame& frame : flow.frames()) {
        for (std::size_t i = 0; i < frame.x.size(); ++i) {
            if (dimension == 3)
                include({frame.x[i], frame.y[i], frame.z[i]});
            else
                include({frame.x[i], frame.y[i]});
        }
        for (const auto& outline : frame.outlines)
            for (const Point& p : outline) include({p[0], p[1]});
        if (!scene.fluid)  // a body in space
            for (const auto& facet : frame.walls)
                for (const Point& p : facet) include({p[0], p[1], p[2]});
    }
    double longest = 0;
    for (std::size_t d = 0; d < dimension; ++d) {
        if (!(all.min[d] < all.max[d])) all.min[d] = scene.domain.min[d], all.max[d] = scene.domain.max[d];
        longest = std::max(longest, all.max[d] - all.min[d]);
    }
    for (std::size_t d = 0; d < dimension; ++d) all.min[d] -= 0.04 * longest, all.max[d] += 0.04 * longest;
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
    at.reserve(2 * view.min.size() * frame.x.size());
    for (std::size_t i = 0; i < frame.x.size(); ++i) {
        put_quantised(at, frame.x[i], view.min[0], view.max[0]);
        put_quantised(at, frame.y[i], view.min[1], view.max[1]);
        if (!frame.z.empty()) put_quantised(at, frame.z[i], view.min[2], view.max[2]);
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
    nlohmann::json json = {{"t", frame.time},  {"n", frame.x.size()}, {"every", frame.every},
                           {"at", base64(at)}, {"values", values},    {"outlines", outlines}};
    for (const auto& panel : frame.walls) {
        nlohmann::json flat = nlohmann::json::array();
        for (const Point& p : panel)
            for (const double x : p) flat.push_back(rounded(x));
        json["walls"].push_back(flat);
    }
    return json;
}

// Shapes as they are computed with; of a surface of very many panels only some are drawn.
template <int D>
void put_facets(nlohmann::json& walls, const geometry::Surface<D>& surface) {
    constexpr std::size_t most = 4000;
    const std::size_t step = surface.facets.size() / most + 1;
    for (std::size_t f = 0; f < surface.facets.size(); f += step) {
        nlohmann::json flat = nlohmann::json::array();
        for (std::size_t k = 0; k < D; ++k)
            for (int d = 0; d < D; ++d) flat.push_back(rounded(surface.vertex(f, k)[d]));
        walls.push_back({{"points", flat}, {"closed", D == 3}});
    }
}

void put_facets(nlohmann::json& walls, const WallScene& wall, const Scene& scene) {
    if (scene.dimension == 2)
        put_facets(walls, wall_surface<2>(wall, scene.fluid->spacing));
    else
        put_facets(walls, wall_surface<3>(wall, scene.fluid->spacing));
}

}  // namespace

nlohmann::json flow_player(const Scene& scene, const FlowRecord& flow) {
    if (flow.frames().empty()) return nullptr;
    const Box view = view_of(scene, flow);
    std::vector<std::pair<Field, std::pair<double, double>>> fields;
    nlohmann::json field_json = nlohmann::json::array(), frames = nlohmann::json::array(),
                   walls = nlohmann::json::array();
    const auto offer = [&](Field field, const char* name, const char* unit) {
        // A field that some frame lacks cannot be played, and without particles there is none.
        if (std::all_of(flow.frames().begin(), flow.frames().end(), [](const auto& frame) { return frame.x.empty(); }))
            return;
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
        if (wall.motion) continue;  // every frame has it where it is
        nlohmann::json flat = nlohmann::json::array();
        for (const Point& p : wall.points)
            for (const double x : p) flat.push_back(x);
        if (wall.points.empty())
            put_facets(walls, wall, scene);
        else
            walls.push_back({{"points", flat}, {"closed", wall.closed || scene.dimension == 3}});
    }
    nlohmann::json corners = view.min;
    for (const double x : view.max) corners.push_back(x);
    return {
        {"view", corners}, {"spacing", flow.spacing()}, {"walls", walls}, {"fields", field_json}, {"frames", frames}};
}

}  // namespace aquagraph::io
