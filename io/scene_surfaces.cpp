#include "io/scene_surfaces.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <numbers>

#include "io/atomic_file.hpp"
#include "io/stl.hpp"
#include "physics/geometry/surface_defects.hpp"

namespace aquagraph::io {
namespace {

using geometry::polyline;
using geometry::ShapeError;
using geometry::Surface;
using geometry::Vec;

constexpr double default_chord_error = 0.02;  // of a spacing

template <int D>
Vec<D> vec(const Point& point) {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = point[std::size_t(d)];
    return x;
}

template <int D>
std::vector<Vec<D>> vecs(const std::vector<Point>& points) {
    std::vector<Vec<D>> all;
    for (const Point& point : points) all.push_back(vec<D>(point));
    return all;
}

template <int D>
geometry::OpenSides<D> open_sides(const std::vector<std::string>& names) {
    static constexpr std::array<std::array<std::string_view, 2>, 3> sides{
        {{"left", "right"}, {"front", "back"}, {"bottom", "top"}}};
    geometry::OpenSides<D> open{};
    for (const std::string& name : names) {
        bool known = false;
        for (std::size_t d = 0; d < D; ++d)
            for (std::size_t end = 0; end < 2; ++end)
                if (name == sides[D == 2 && d == 1 ? 2 : d][end]) known = open[d][end] = true;
        if (!known)
            throw ShapeError(fmt::format("a box has no side \"{}\", but left, right, {}bottom and top", name,
                                         D == 3 ? "front, back, " : ""));
    }
    return open;
}

Surface<3> stl_surface(const StlShape& shape) {
    Surface<3> surface = read_stl(shape.file);
    transform(surface, shape.scale, vec<3>(shape.axis), shape.angle, vec<3>(shape.translate));
    const auto [low, high] = bounds(surface);
    weld(surface, shape.weld.value_or(1e-6 * (high - low).norm()));
    const auto defects = find_defects(surface, shape.closed);
    if (!defects.empty()) {
        constexpr std::size_t shown = 5;
        std::string text;
        for (std::size_t k = 0; k < std::min(shown, defects.size()); ++k)
            text += (k ? "; " : "") + describe(defects[k]);
        if (defects.size() > shown) text += fmt::format("; and {} more", defects.size() - shown);
        throw ShapeError(text);
    }
    return surface;
}

template <int D>
Surface<D> round_surface(const RoundShape& round, double spacing) {
    const double error = round.chord_error.value_or(default_chord_error * spacing);
    if constexpr (D == 2)
        return geometry::circle(vec<2>(round.centre), round.radius, error, round.fluid);
    else
        return geometry::sphere(vec<3>(round.centre), round.radius, error, round.fluid);
}

Surface<3> solid_shape(const WallScene& wall, double spacing) {
    if (wall.rectangle)
        return geometry::rectangle(vec<3>(wall.rectangle->corner), vec<3>(wall.rectangle->side_a),
                                   vec<3>(wall.rectangle->side_b));
    if (wall.extrusion) {
        const ExtrusionShape& shape = *wall.extrusion;
        return geometry::extrude(vecs<2>(shape.points), shape.closed, shape.axis, shape.from, shape.to, shape.caps);
    }
    if (wall.cylinder) {
        const CylinderShape& shape = *wall.cylinder;
        std::array<bool, 2> open{};
        for (const std::string& end : shape.open) {
            if (end != "from" && end != "to")
                throw ShapeError(fmt::format("a cylinder has no end \"{}\", but from and to", end));
            open[end == "to"] = true;
        }
        return geometry::cylinder(vec<3>(shape.from), vec<3>(shape.to), shape.radius,
                                  shape.chord_error.value_or(default_chord_error * spacing), shape.fluid, open);
    }
    if (wall.stl) {
        Surface<3> surface = stl_surface(*wall.stl);
        // Which side of a watertight surface is inside does not depend on how its triangles turn. Of an open one their
        // fronts count as its outside.
        const bool outward = !wall.stl->closed || enclosed_volume(surface) > 0;
        if (outward != (wall.stl->fluid == geometry::FluidSide::outside)) surface.flip();
        return surface;
    }
    return geometry::plane_polygon(vecs<3>(wall.points));
}

template <int D>
TimeLaw law_of(const auto& law, double size) {
    if (law.constant) return ConstantRate{size, {law.ramp}};
    return Harmonic{size, law.frequency, law.phase, {law.ramp}};
}

}  // namespace

template <int D>
Surface<D> wall_surface(const WallScene& wall, double spacing) {
    if (wall.box)
        return geometry::box<D>(vec<D>(wall.box->box.min), vec<D>(wall.box->box.max), wall.box->fluid,
                                open_sides<D>(wall.box->open));
    if (wall.round) return round_surface<D>(*wall.round, spacing);
    if constexpr (D == 2)
        return polyline(vecs<2>(wall.points), wall.closed);
    else
        return solid_shape(wall, spacing);
}

bool is_closed(const WallScene& wall) {
    if (wall.box) return wall.box->open.empty();
    if (wall.round) return true;
    if (wall.cylinder) return wall.cylinder->open.empty();
    if (wall.extrusion) return wall.extrusion->caps;
    if (wall.stl) return wall.stl->closed;
    return wall.closed;
}

template <int D>
Surface<D> region_surface(const RegionScene& region, double spacing) {
    Surface<D> surface;
    if (region.round) {
        surface = round_surface<D>(*region.round, spacing);
    } else if constexpr (D == 2) {
        surface = polyline(vecs<2>(region.points), true);
        if (const auto defects = find_defects(surface, true); !defects.empty()) throw ShapeError(describe(defects[0]));
    } else {
        surface = stl_surface(*region.stl);
    }
    if (enclosed_volume(surface) < 0) surface.flip();
    return surface;
}

bool is_hydrostatic(const RegionScene& region, const FluidScene& fluid) {
    return region.pressure.value_or(fluid.initial_pressure) == InitialPressure::hydrostatic;
}

double surface_level(const FluidScene& fluid, int dimension) {
    if (fluid.surface_level) return *fluid.surface_level;
    const auto up = static_cast<std::size_t>(dimension - 1);
    std::optional<double> top;
    const auto reach = [&](double height) { top = std::max(top.value_or(height), height); };
    for (const Box& box : fluid.boxes) reach(box.max[up]);
    for (const RegionScene& region : fluid.regions) {
        if (!is_hydrostatic(region, fluid)) continue;
        const double height = dimension == 2 ? bounds(region_surface<2>(region, fluid.spacing)).second[1]
                                             : bounds(region_surface<3>(region, fluid.spacing)).second[2];
        reach(std::min(height, region.level.value_or(height)));
    }
    return top.value_or(0);
}

template <int D>
fluid::RigidMotion<D> rigid_motion(const MotionScene& scene, double end) {
    fluid::RigidMotion<D> motion;
    motion.centre = vec<D>(scene.centre);
    motion.axis = vec<3>(scene.axis).normalized();
    if (const auto& law = scene.translation; law && (law->constant || law->amplitude))
        motion.translations.push_back({vec<D>(law->constant ? *law->constant : *law->amplitude), law_of<D>(*law, 1)});
    if (const auto& law = scene.rotation; law && (law->constant || law->amplitude))
        motion.rotations.push_back(law_of<D>(*law, law->constant ? *law->constant : *law->amplitude));
    if (scene.table.empty()) return motion;

    const MotionTable table = parse_motion_table(read_file(scene.table));
    const auto law = [&](const std::vector<double>& values) {
        const TimeTable made(table.time, values);
        if (!scene.hold && made.end() < end * (1 - 1e-9))
            throw std::invalid_argument(
                fmt::format("the table ends at {} s, before the end of the run at {} s", made.end(), end));
        return made;
    };
    for (int d = 0; d < 3; ++d) {
        const auto& column = table.place[std::size_t(d)];
        if (column.empty()) continue;
        if (d >= D) throw std::invalid_argument("a column z has no place in a scene of two dimensions");
        motion.translations.push_back({Vec<D>::Unit(d), law(column)});
    }
    if (!table.angle.empty()) {
        if (!scene.rotation)
            throw std::invalid_argument("the table has a column angle, but nothing says about which point");
        motion.rotations.push_back(law(table.angle));
    }
    return motion;
}

MotionTable parse_motion_table(std::string_view text) {
    MotionTable table;
    std::vector<std::pair<std::vector<double>*, double>> columns;  // where it goes, factor to SI
    const auto parted = [](std::string_view line) {
        std::vector<std::string_view> words;
        for (std::size_t begin = 0; begin < line.size();) {
            const std::size_t from = line.find_first_not_of(" \t,;\r", begin);
            if (from == std::string_view::npos) break;
            begin = std::min(line.find_first_of(" \t,;\r", from), line.size());
            words.push_back(line.substr(from, begin - from));
        }
        return words;
    };
    int number = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        ++number;
        const auto words = parted(line);
        if (words.empty() || words[0].front() == '#') continue;
        if (columns.empty()) {
            for (const std::string_view word : words) {
                const auto unit = word.find('[');
                const std::string_view name = word.substr(0, unit);
                std::vector<double>* column = name == "time"    ? &table.time
                                              : name == "x"     ? &table.place[0]
                                              : name == "y"     ? &table.place[1]
                                              : name == "z"     ? &table.place[2]
                                              : name == "angle" ? &table.angle
                                                                : nullptr;
                if (!column)
                    throw std::invalid_argument(fmt::format(
                        "line {}: the head names the columns, time and any of x, y, z, angle, but there stands `{}`",
                        number, word));
                for (const auto& [other, factor] : columns)
                    if (other == column)
                        throw std::invalid_argument(fmt::format("line {}: two columns are called {}", number, name));
                const bool degrees = unit != std::string_view::npos && word.substr(unit) == "[deg]";
                if (unit != std::string_view::npos && !degrees &&
                    word.substr(unit) != (name == "time"    ? "[s]"
                                          : name == "angle" ? "[rad]"
                                                            : "[m]"))
                    throw std::invalid_argument(
                        fmt::format("line {}: `{}` has another unit than [s], [m], [rad], [deg]", number, word));
                columns.emplace_back(column, degrees ? std::numbers::pi / 180 : 1);
            }
            continue;
        }
        if (words.size() != columns.size())
            throw std::invalid_argument(
                fmt::format("line {}: {} values, but the head names {} columns", number, words.size(), columns.size()));
        for (std::size_t k = 0; k < words.size(); ++k) {
            std::string_view word = words[k];
            if (word.starts_with('+')) word.remove_prefix(1);
            double value = 0;
            const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
            if (error != std::errc{} || stop != word.data() + word.size() || !std::isfinite(value))
                throw std::invalid_argument(fmt::format("line {}: `{}` is not a number", number, words[k]));
            columns[k].first->push_back(value * columns[k].second);
        }
        const std::size_t n = table.time.size();
        if (n > 1 && !(table.time[n - 1] > table.time[n - 2]))
            throw std::invalid_argument(fmt::format("line {}: time does not increase, from {} s to {} s", number,
                                                    table.time[n - 2], table.time[n - 1]));
    }
    if (columns.empty()) throw std::invalid_argument("the table is empty");
    if (table.time.empty()) throw std::invalid_argument("the table has no column `time` or no rows");
    if (columns.size() < 2) throw std::invalid_argument("the table has no column besides `time`");
    return table;
}

template Surface<2> wall_surface<2>(const WallScene&, double);
template Surface<3> wall_surface<3>(const WallScene&, double);
template Surface<2> region_surface<2>(const RegionScene&, double);
template Surface<3> region_surface<3>(const RegionScene&, double);
template fluid::RigidMotion<2> rigid_motion<2>(const MotionScene&, double);
template fluid::RigidMotion<3> rigid_motion<3>(const MotionScene&, double);

}  // namespace aquagraph::io
