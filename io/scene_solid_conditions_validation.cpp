#include "io/scene_solid_conditions_validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "io/scene_solid_sets.hpp"
#include "io/scene_time_law.hpp"
#include "io/suggestion.hpp"

namespace aquagraph::io {
namespace {

class ConditionsValidation {
  public:
    ConditionsValidation(const Scene& scene, Complaints& complaints)
        : scene_(scene), solid_(*scene.solid), complaints_(complaints) {}

    void everything() {
        each("solid.motion", solid_.motions, [this](const NodeMotionScene& motion, const std::string& at) {
            validate_set(scene_, at + ".set", motion.set, "node set", complaints_);
            direction(at, motion.along);
            validate_time_law(motion.law, at, complaints_);
        });
        each("solid.pressure", solid_.pressures, [this](const PressureScene& pressure, const std::string& at) {
            validate_set(scene_, at + ".surface", pressure.surface, "surface", complaints_);
            validate_time_law(pressure.law, at, complaints_);
        });
        rigid_bodies();
        contacts();
        each("solid.cords", solid_.cords,
             [this](const CordsScene& cords, const std::string& at) { this->cords(cords, at); });
    }

  private:
    bool given(const std::string& key) const { return complaints_.positions.contains(key); }

    template <class Entry, class Check>
    void each(const std::string& section, const std::vector<Entry>& entries, const Check& check) {
        for (std::size_t i = 0; i < entries.size(); ++i) check(entries[i], fmt::format("{}[{}]", section, i));
    }

    void direction(const std::string& at, int along) {
        if (scene_.dimension == 2 && along == 2 && !complaints_.touch(at + ".along"))
            complaints_.add(at + ".along", "there is no z in a scene of two dimensions", "x or y");
    }

    // A freedom is prescribed once; loads add up.
    void rigid_bodies() {
        std::vector<std::string> names;
        each("solid.rigid_body", solid_.rigid_bodies, [&](const RigidBodyScene& body, const std::string& at) {
            names.push_back(body.name);
            validate_set(scene_, at + ".set", body.set, "node set", complaints_);
            const std::size_t needed = scene_.dimension == 2 ? 1 : 3;
            if (given(at + ".inertia") && body.inertia.size() != needed && !complaints_.touch(at + ".inertia"))
                complaints_.add(at + ".inertia",
                                fmt::format("{} moments of inertia in a scene of {} dimensions", body.inertia.size(),
                                            scene_.dimension),
                                needed == 1 ? "inertia = [J]" : "inertia = [about x, about y, about z]");
        });
        std::set<std::pair<std::string, int>> prescribed;
        const auto freedom = [&](const RigidFreedomScene& entry, const std::string& at) {
            named(at + ".body", entry.body, names, "rigid body");
            if (entry.freedom < 0 && !complaints_.touch(at + ".freedom"))
                complaints_.add(
                    at + ".freedom",
                    fmt::format("a body in {} dimensions has no such freedom", scene_.dimension == 2 ? "two" : "three"),
                    scene_.dimension == 2 ? "x, y or turn" : "x, y, z, turn_x, turn_y or turn_z");
            validate_time_law(entry.law, at, complaints_);
        };
        each("solid.rigid_motion", solid_.rigid_motions, [&](const RigidFreedomScene& entry, const std::string& at) {
            freedom(entry, at);
            if (!complaints_.touch(at) && !prescribed.insert({entry.body, entry.freedom}).second)
                complaints_.add(at, "this freedom of the body is prescribed twice",
                                "what is given in one entry adds up");
        });
        each("solid.rigid_load", solid_.rigid_loads, [&](const RigidFreedomScene& entry, const std::string& at) {
            freedom(entry, at);
            if (!complaints_.touch(at) && prescribed.contains({entry.body, entry.freedom}))
                complaints_.add(at, "this freedom of the body is prescribed: a load on it would do nothing",
                                "take the load out, or the [[solid.rigid_motion]]");
        });
    }

    void contacts() {
        std::vector<std::string> names;
        each("solid.contact", solid_.contacts, [&](const ContactScene& contact, const std::string& at) {
            names.push_back(contact.name);
            validate_set(scene_, at + ".surface", contact.surface, "surface", complaints_);
            ground(contact, at);
        });
        each("solid.ground_motion", solid_.ground_motions, [&](const GroundMotionScene& motion, const std::string& at) {
            named(at + ".contact", motion.contact, names, "contact");
            direction(at, motion.along);
            validate_time_law(motion.law, at, complaints_);
        });
    }

    // Which shape takes which keys.
    void ground(const ContactScene& contact, const std::string& at) {
        using Shape = solid::GroundShape;
        const bool plane = contact.shape == Shape::plane,
                   axis = contact.shape == Shape::cylinder && scene_.dimension == 3;
        const auto takes = [&](const char* key, bool needed, bool allowed) {
            const std::string full = at + "." + key;
            if (complaints_.touch(full)) return;
            if (needed && !given(full))
                complaints_.add(
                    at, fmt::format("`{}` of the ground is missing", key),
                    "a plane has point and normal, a cylinder point, radius and in three dimensions axis, a "
                    "sphere point and radius");
            if (!allowed && given(full))
                complaints_.add(full, fmt::format("`{}` does not belong to this ground", key), "take it out");
        };
        takes("normal", plane, plane);
        takes("axis", axis, axis);
        takes("radius", !plane, !plane);
        takes("hollow", false, !plane);
        if (!contact.direction || complaints_.touch(at)) return;
        const Point& n = *contact.direction;
        if (std::all_of(n.begin(), n.end(), [](double x) { return x == 0; }))
            complaints_.add(at + (plane ? ".normal" : ".axis"), "this has no direction: it is zero",
                            "normal = [0, 1] looks up");
    }

    void cords(const CordsScene& cords, const std::string& at) {
        if (complaints_.touch(at)) return;
        if (scene_.dimension == 2) return complaints_.add(at, "cords are there in three dimensions", "take them out");
        const auto part = std::find_if(solid_.parts.begin(), solid_.parts.end(),
                                       [&](const PartScene& entry) { return entry.set == cords.set; });
        if (!cords.set.empty() && part == solid_.parts.end())
            return complaints_.add(at + ".set",
                                   fmt::format("there is no [[solid.part]] with the set \"{}\"", cords.set),
                                   "cords need a rubber around them: give the part its material");
        const solid::MaterialLaw law = cords.set.empty() ? solid_.material.law : part->material.law;
        if (law != solid::MaterialLaw::neo_hookean && law != solid::MaterialLaw::mooney_rivlin)
            complaints_.add(at, "the rubber around cords has the law neo_hookean or mooney_rivlin",
                            "choose one of them");
        if (cords.angles.empty()) complaints_.add(at + ".angles", "`angles` is empty", "one for each family of cords");
        for (const char* key : {"along", "normal"})
            if (cords.axis && given(at + "." + key))
                complaints_.add(at + "." + key, fmt::format("a layer around an axis takes no `{}`", key),
                                "take it out");
        if (cords.axis_point && !cords.axis)
            complaints_.add(at + ".axis_point", "there is no `axis`", "give it, or take `axis_point` out");
        if (std::count_if(solid_.cords.begin(), solid_.cords.end(),
                          [&](const CordsScene& other) { return other.set == cords.set; }) > 1)
            complaints_.add(at, "this material has cords twice",
                            "angles = [0.35, -0.35] are two families in one layer");
    }

    void named(const std::string& key, const std::string& name, const std::vector<std::string>& known,
               std::string_view what) {
        if (complaints_.touch(key) || std::find(known.begin(), known.end(), name) != known.end()) return;
        const auto guess = nearest(name, known);
        complaints_.add(key, fmt::format("there is no {} \"{}\"", what, name),
                        guess ? fmt::format("did you mean \"{}\"?", *guess)
                        : known.empty()
                            ? fmt::format("add a [[solid.{}]]", what == "contact" ? "contact" : "rigid_body")
                            : fmt::format("there are {}", fmt::join(known, ", ")));
    }

    const Scene& scene_;
    const SolidScene& solid_;
    Complaints& complaints_;
};

}  // namespace

void validate_solid_conditions(const Scene& scene, Complaints& complaints) {
    ConditionsValidation(scene, complaints).everything();
}

}  // namespace aquagraph::io
