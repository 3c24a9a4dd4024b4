#include "io/scene_dimension.hpp"

#include <fmt/format.h>

namespace aquagraph::io {

int agree_on_dimension(const CheckedDocument& document, Complaints& complaints) {
    const std::string decisive = "domain.min";
    Point corner;
    if (!document.take(decisive, corner)) return corner.dimension();
    const int dimension = corner.dimension();
    const auto compare = [&](const std::string& key, const Point& point) {
        if (point.dimension() == dimension) return;
        // What is drawn along an axis is drawn in a plane.
        if (point.dimension() == 2 && key.find(".extrusion.points") != std::string::npos) return;
        complaints.add(key,
                       fmt::format("a point of {} coordinates in a scene of {} dimensions: [{}]", point.dimension(),
                                   dimension, fmt::join(point, ", ")),
                       fmt::format("`min` of [domain] has {} coordinates, and so must every point: {}", dimension,
                                   dimension == 2 ? "[x, y]" : "[x, y, z]"));
    };
    for (const auto& [key, value] : document.values) {
        if (const Point* point = std::get_if<Point>(&value)) compare(key, *point);
        if (const auto* points = std::get_if<std::vector<Point>>(&value))
            for (std::size_t i = 0; i < points->size(); ++i) compare(fmt::format("{}[{}]", key, i), (*points)[i]);
    }
    return dimension;
}

}  // namespace aquagraph::io
