#include "io/scene_solid_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/comparison.hpp"
#include "io/scene_time_law.hpp"
#include "io/scene_words.hpp"

namespace aquagraph::io {
namespace {

class SolidReader {
  public:
    SolidReader(const CheckedDocument& document, Complaints& complaints, Scene& scene)
        : document_(document), complaints_(complaints), scene_(scene), solid_(scene.solid.emplace()) {}

    void everything() {
        document_.take("solid.name", solid_.name);
        choose("solid.solver", solid_.solver, solid_solver_words);
        if (document_.take("solid.program", solid_.program) && solid_.program.find('/') != std::string::npos)
            solid_.program = (scene_.file.parent_path() / solid_.program).lexically_normal().string();
        path("solid.mesh", solid_.mesh);
        if (document_.count("solid.box")) box();
        choose("solid.plane", solid_.plane, plane_words);
        choose("solid.integration", solid_.integration, integration_points_words);
        document_.take("solid.order", solid_.element_order);
        document_.take("solid.static_start", solid_.static_start);
        take("solid.velocity", solid_.velocity);
        document_.take("solid.wet", solid_.wet);
        material("solid.material", solid_.material);
        for (int i = 0; i < document_.count("solid.part"); ++i) {
            const std::string at = fmt::format("solid.part[{}]", i);
            PartScene& part = solid_.parts.emplace_back();
            document_.take(at + ".set", part.set);
            material(at, part.material);
        }
        scheme();
        for (int i = 0; i < document_.count("solid.clamp"); ++i)
            clamp(solid_.clamps.emplace_back(), fmt::format("solid.clamp[{}].", i));
        loads();
        conditions();
        for (int i = 0; i < document_.count("solid.track"); ++i) {
            Track& track = solid_.tracks.emplace_back();
            document_.take(fmt::format("solid.track[{}].name", i), track.name);
            document_.take(fmt::format("solid.track[{}].point", i), track.point);
        }
    }

  private:
    template <class E, std::size_t n>
    void choose(const std::string& key, E& target, const Words<E, n>& meanings) {
        take_choice(document_, key, target, meanings);
    }

    // Calls read(a new entry, "SECTION[i]") for each there is.
    template <class Entry, class Read>
    void each(const std::string& section, std::vector<Entry>& entries, const Read& read) {
        for (int i = 0; i < document_.count(section); ++i) {
            const std::string at = fmt::format("{}[{}]", section, i);
            read(entries.emplace_back(), at);
            if constexpr (requires(Entry & entry) { entry.law; })
                read_time_law(document_, at, scene_.file.parent_path(), entries.back().law);
        }
    }
    template <class Value>
    void take(const std::string& key, std::optional<Value>& target) {
        if (Value value; document_.take(key, value)) target = value;
    }

    void path(const std::string& key, std::filesystem::path& target) const {
        if (std::string given; document_.take(key, given))
            target = (scene_.file.parent_path() / given).lexically_normal();
    }

    void box() {
        solid_.box.emplace();
        document_.take("solid.box.min", solid_.box->min);
        document_.take("solid.box.max", solid_.box->max);
        std::vector<int> counts;
        if (!document_.take("solid.box.elements", counts)) return;
        if (counts.size() != std::size_t(scene_.dimension)) {
            complaints_.add(
                "solid.box.elements",
                fmt::format("{} counts in a scene of {} dimensions", counts.size(), scene_.dimension),
                scene_.dimension == 2 ? "elements = [along x, along y]" : "elements = [along x, along y, along z]");
            return;
        }
        std::copy(counts.begin(), counts.end(), solid_.elements.begin());
    }

    void material(const std::string& at, MaterialScene& material) {
        choose(at + ".law", material.law, material_law_words);
        document_.take(at + ".density", material.density);
        document_.take(at + ".youngs_modulus", material.youngs_modulus);
        document_.take(at + ".poissons_ratio", material.poissons_ratio);
        document_.take(at + ".c10", material.c10);
        document_.take(at + ".c01", material.c01);
        document_.take(at + ".bulk_modulus", material.bulk_modulus);
        path(at + ".curve", material.curve_file);
        if (material.curve_file.empty()) return;
        const std::string help = "two columns of numbers, strain and force per area at rest [Pa]";
        try {
            Compare columns;
            columns.file = material.curve_file;
            const Curve curve = read_reference(columns);
            for (std::size_t k = 0; k < curve.time.size(); ++k)  // from (0, 0), whether that is listed or not
                if (k > 0 || curve.time[k] != 0 || curve.value[k] != 0)
                    material.curve.push_back({curve.time[k], curve.value[k]});
        } catch (const std::exception& error) {
            complaints_.add(at + ".curve", fmt::format("the file cannot be used: {}", error.what()), help);
        }
    }

    void scheme() {
        std::string name;
        if (document_.take("solid.scheme.name", name)) {
            solid_.is_static = name == "static";
            choose("solid.scheme.name", solid_.scheme, solid_scheme_words);
        }
        document_.take("solid.scheme.alpha", solid_.alpha);
        if (solid_.is_static) solid_.step = scene_.end_time;
        document_.take("solid.scheme.step", solid_.step);
    }

    void clamp(Clamp& clamp, const std::string& at) {
        const std::vector<std::string> directions =
            scene_.dimension == 2 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
        document_.take(at + "name", clamp.name);
        document_.take(at + "set", clamp.set);
        std::vector<std::string> fixed = directions;
        document_.take(at + "fixed", fixed);
        bool known = !fixed.empty();
        for (const std::string& axis : fixed) {
            const auto found = std::find(directions.begin(), directions.end(), axis);
            if (found == directions.end())
                known = false;
            else
                clamp.fixed[std::size_t(found - directions.begin())] = true;
        }
        if (known) return;
        if (scene_.dimension == 2)
            complaints_.add(at + "fixed", "`fixed` must name \"x\", \"y\" or both",
                            "fixed = [\"x\", \"y\"] holds the nodes where they are");
        else
            complaints_.add(at + "fixed", "`fixed` must name some of \"x\", \"y\" and \"z\"",
                            "fixed = [\"x\", \"y\", \"z\"] holds the nodes where they are");
    }

    void factor(const std::string& at, LoadHistory& history) {
        document_.take(at + "factor", history.formula);
        path(at + "table", history.table);
    }

    void loads() {
        for (int i = 0; i < document_.count("solid.traction"); ++i) {
            TractionScene& traction = solid_.tractions.emplace_back();
            const std::string at = fmt::format("solid.traction[{}].", i);
            document_.take(at + "surface", traction.surface);
            document_.take(at + "value", traction.value);
            factor(at, traction.factor);
        }
        for (int i = 0; i < document_.count("solid.force"); ++i) {
            ForceScene& force = solid_.forces.emplace_back();
            const std::string at = fmt::format("solid.force[{}].", i);
            document_.take(at + "set", force.set);
            if (Point point; document_.take(at + "point", point)) force.point = point;
            document_.take(at + "value", force.value);
            factor(at, force.factor);
        }
    }

    void conditions() {
        document_.take("solid.damping.mass", solid_.mass_damping);
        document_.take("solid.damping.stiffness", solid_.stiffness_damping);
        each("solid.cords", solid_.cords, [this](CordsScene& cords, const std::string& at) {
            document_.take(at + ".set", cords.set);
            document_.take(at + ".modulus", cords.modulus);
            document_.take(at + ".section", cords.section);
            document_.take(at + ".spacing", cords.spacing);
            document_.take(at + ".thickness", cords.thickness);
            document_.take(at + ".angles", cords.angles);
            take(at + ".axis", cords.axis);
            take(at + ".axis_point", cords.axis_point);
            take(at + ".along", cords.along);
            take(at + ".normal", cords.normal);
        });
        each("solid.motion", solid_.motions, [this](NodeMotionScene& motion, const std::string& at) {
            document_.take(at + ".name", motion.name);
            document_.take(at + ".set", motion.set);
            choose(at + ".along", motion.along, direction_words);
        });
        each("solid.pressure", solid_.pressures, [this](PressureScene& pressure, const std::string& at) {
            document_.take(at + ".surface", pressure.surface);
        });
        each("solid.rigid_body", solid_.rigid_bodies, [this](RigidBodyScene& body, const std::string& at) {
            document_.take(at + ".name", body.name);
            document_.take(at + ".set", body.set);
            take(at + ".point", body.point);
            document_.take(at + ".mass", body.mass);
            document_.take(at + ".inertia", body.inertia);
        });
        const auto freedom = [this](RigidFreedomScene& entry, const std::string& at) {
            document_.take(at + ".body", entry.body);
            entry.freedom = -1;  // a word that is for the other dimension
            if (scene_.dimension == 2)
                choose(at + ".freedom", entry.freedom, plane_freedom_words);
            else
                choose(at + ".freedom", entry.freedom, freedom_words);
        };
        each("solid.rigid_motion", solid_.rigid_motions, freedom);
        each("solid.rigid_load", solid_.rigid_loads, freedom);
        each("solid.contact", solid_.contacts, [this](ContactScene& contact, const std::string& at) {
            document_.take(at + ".name", contact.name);
            document_.take(at + ".surface", contact.surface);
            choose(at + ".shape", contact.shape, ground_words);
            document_.take(at + ".point", contact.point);
            take(at + ".normal", contact.direction);
            take(at + ".axis", contact.direction);
            document_.take(at + ".radius", contact.radius);
            document_.take(at + ".hollow", contact.hollow);
            document_.take(at + ".friction", contact.friction);
            take(at + ".penalty", contact.penalty);
        });
        each("solid.ground_motion", solid_.ground_motions, [this](GroundMotionScene& motion, const std::string& at) {
            document_.take(at + ".contact", motion.contact);
            choose(at + ".along", motion.along, direction_words);
        });
    }

    const CheckedDocument& document_;
    Complaints& complaints_;
    const Scene& scene_;
    SolidScene& solid_;
};

}  // namespace

void read_solid(const CheckedDocument& document, Complaints& complaints, Scene& scene) {
    SolidReader(document, complaints, scene).everything();
}

}  // namespace aquagraph::io
