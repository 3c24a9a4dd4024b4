#include "io/scene_geometry_reader.hpp"

#include <fmt/format.h>

namespace aquagraph::io {
namespace {

class Geometry {
  public:
    Geometry(const CheckedDocument& document, const std::filesystem::path& folder)
        : document_(document), folder_(folder) {}

    void wall(const std::string& at, WallScene& wall) const {
        if (const std::string key = at + ".box"; given(key)) {
            BoxShape& box = wall.box.emplace();
            take(key, "min", box.box.min);
            take(key, "max", box.box.max);
            take(key, "open", box.open);
            side(key, box.fluid);
        }
        if (const std::string key = at + ".rectangle"; given(key)) {
            RectangleShape& rectangle = wall.rectangle.emplace();
            take(key, "corner", rectangle.corner);
            take(key, "side_a", rectangle.side_a);
            take(key, "side_b", rectangle.side_b);
        }
        if (const std::string key = at + ".extrusion"; given(key)) {
            ExtrusionShape& extrusion = wall.extrusion.emplace();
            take(key, "points", extrusion.points);
            take(key, "closed", extrusion.closed);
            take(key, "caps", extrusion.caps);
            if (std::string axis; take(key, "axis", axis)) extrusion.axis = axis[0] - 'x';
            take(key, "from", extrusion.from);
            take(key, "to", extrusion.to);
        }
        for (const char* name : {".circle", ".sphere"})
            if (const std::string key = at + name; given(key)) round(key, wall.round.emplace());
        if (const std::string key = at + ".cylinder"; given(key)) {
            CylinderShape& cylinder = wall.cylinder.emplace();
            take(key, "from", cylinder.from);
            take(key, "to", cylinder.to);
            take(key, "radius", cylinder.radius);
            take(key, "chord_error", cylinder.chord_error);
            take(key, "open", cylinder.open);
            side(key, cylinder.fluid);
        }
        if (const std::string key = at + ".stl"; given(key)) {
            StlShape& shape = wall.stl.emplace();
            stl(key, "file", shape);
            take(key, "closed", shape.closed);
            side(key, shape.fluid);
        }
        if (const std::string key = at + ".motion"; given(key)) motion(key, wall.motion.emplace());
    }

    void water(int dimension, FluidScene& fluid) const {
        for (std::size_t i = 0; i < fluid.boxes.size(); ++i) {
            fluid.boxes[i].velocity = zero(dimension);
            take(fmt::format("fluid.box[{}]", i), "velocity", fluid.boxes[i].velocity);
        }
        for (const char* kind : {"polygon", "disc", "sphere", "volume"})
            for (int i = 0; i < document_.count(fmt::format("fluid.{}", kind)); ++i) {
                RegionScene& region = fluid.regions.emplace_back();
                region.key = fmt::format("fluid.{}[{}]", kind, i);
                region.velocity = zero(dimension);
                const std::string_view is = kind;
                if (is == "polygon") take(region.key, "points", region.points);
                if (is == "disc" || is == "sphere") {
                    round(region.key, region.round.emplace());
                    region.round->fluid = geometry::FluidSide::outside;
                    region.pressure = InitialPressure::zero;
                }
                if (is == "volume") stl(region.key, "stl", region.stl.emplace());
                take(region.key, "level", region.level);
                take(region.key, "clearance", region.clearance);
                take(region.key, "velocity", region.velocity);
                if (std::string word; take(region.key, "initial_pressure", word))
                    region.pressure = word == "zero" ? InitialPressure::zero : InitialPressure::hydrostatic;
            }
    }

  private:
    static Point zero(int dimension) { return dimension == 2 ? Point(0, 0) : Point(0, 0, 0); }
    bool given(const std::string& table) const { return document_.count(table) > 0; }

    template <class T>
    bool take(const std::string& table, const char* name, T& target) const {
        return document_.take(table + "." + name, target);
    }
    template <class T>
    bool take(const std::string& table, const char* name, std::optional<T>& target) const {
        T value{};
        if (!take(table, name, value)) return false;
        target = value;
        return true;
    }
    void side(const std::string& table, geometry::FluidSide& side) const {
        if (std::string word; take(table, "fluid", word))
            side = word == "inside" ? geometry::FluidSide::inside : geometry::FluidSide::outside;
    }
    void round(const std::string& key, RoundShape& round) const {
        take(key, "centre", round.centre);
        take(key, "radius", round.radius);
        take(key, "chord_error", round.chord_error);
        side(key, round.fluid);
    }
    void stl(const std::string& key, const char* file_key, StlShape& shape) const {
        if (std::string file; take(key, file_key, file)) shape.file = (folder_ / file).lexically_normal();
        take(key, "scale", shape.scale);
        take(key, "axis", shape.axis);
        take(key, "angle", shape.angle);
        take(key, "translate", shape.translate);
        take(key, "weld", shape.weld);
    }
    template <class Value>
    void law(const std::string& key, LawScene<Value>& law) const {
        take(key, "velocity", law.constant);
        take(key, "amplitude", law.amplitude);
        take(key, "frequency", law.frequency);
        if (double period = 0; take(key, "period", period)) law.frequency = 1 / period;
        take(key, "phase", law.phase);
        take(key, "ramp", law.ramp);
    }
    void motion(const std::string& key, MotionScene& motion) const {
        if (std::string file; take(key, "table", file)) motion.table = (folder_ / file).lexically_normal();
        if (std::string word; take(key, "after", word)) motion.hold = word == "hold";
        if (const std::string part = key + ".translation"; given(part)) law(part, motion.translation.emplace());
        if (const std::string part = key + ".rotation"; given(part)) {
            law(part, motion.rotation.emplace());
            take(part, "centre", motion.centre);
            take(part, "axis", motion.axis);
        }
    }

    const CheckedDocument& document_;
    const std::filesystem::path& folder_;
};

}  // namespace

void read_wall_geometry(const CheckedDocument& document, const std::string& at, const std::filesystem::path& folder,
                        WallScene& wall) {
    Geometry(document, folder).wall(at, wall);
}

void read_water(const CheckedDocument& document, const std::filesystem::path& folder, int dimension,
                FluidScene& fluid) {
    Geometry(document, folder).water(dimension, fluid);
}

}  // namespace aquagraph::io
