#include "io/scene_solid_validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "io/comparison.hpp"
#include "io/scene_geometry_validation.hpp"
#include "io/scene_solid_conditions_validation.hpp"
#include "io/scene_solid_sets.hpp"
#include "io/scene_words.hpp"

namespace aquagraph::io {
namespace {

std::string element(std::string_view list, std::size_t i, std::string_view key = {}) {
    return fmt::format("{}[{}]{}{}", list, i, key.empty() ? "" : ".", key);
}

class SolidValidation {
  public:
    SolidValidation(const Scene& scene, Complaints& complaints)
        : scene_(scene), solid_(*scene.solid), complaints_(complaints) {}

    void everything() {
        body();
        if (given("solid.material"))
            material("solid.material", solid_.material);
        else
            complaints_.add("solid.material", "[solid.material] is missing",
                            "give density, youngs_modulus and poissons_ratio of the body");
        for (std::size_t i = 0; i < solid_.parts.size(); ++i) {
            const std::string at = element("solid.part", i);
            material(at, solid_.parts[i].material);
            if (solid_.box && !complaints_.touch(at + ".set"))
                complaints_.add(at + ".set", "a box has no element sets",
                                "mesh the body with physical groups: [solid] mesh");
        }
        if (scene_.dimension == 3 && given("solid.plane"))
            complaints_.add("solid.plane", "`plane` is for scenes in two dimensions", "take it out");
        wet();
        std::vector<std::string> clamped;
        for (std::size_t i = 0; i < solid_.clamps.size(); ++i) {
            clamped.push_back(solid_.clamps[i].set);
            validate_set(scene_, element("solid.clamp", i, "set"), solid_.clamps[i].set, "node set", complaints_);
        }
        repeated(clamped, "solid.clamp", "set");
        const bool is_held = !solid_.clamps.empty() || !solid_.motions.empty() || !solid_.rigid_motions.empty();
        if (solid_.static_start && !is_held && !complaints_.touch("solid.clamp"))
            complaints_.add("solid.static_start", "a body without any [[solid.clamp]] has no equilibrium to start from",
                            "clamp it or take `static_start` out");
        time();
        loads();
        validate_solid_conditions(scene_, complaints_);
    }

  private:
    bool given(const std::string& key) const { return complaints_.positions.contains(key); }

    void body() {
        if (given("solid.program") && solid_.solver == SolidSolver::built_in && !complaints_.touch("solid.solver"))
            complaints_.add("solid.program", "no other program computes this body",
                            "take it out, or choose solver = \"calculix\"");
        const bool box = given("solid.box"), mesh = given("solid.mesh");
        if (box && mesh)
            complaints_.add("solid.mesh", "[solid] has both `mesh` and [solid.box]",
                            "keep one of them: the body is either read or meshed here");
        if (!box && !mesh)
            complaints_.add("solid", "[solid] has no shape: neither `mesh` nor [solid.box]",
                            "give mesh = \"file.msh\" or a [solid.box] with min, max and elements");
        if (box && !complaints_.touch("solid.box"))
            for (std::size_t d = 0; d < solid_.box->min.size(); ++d)
                if (!(solid_.box->max[d] > solid_.box->min[d])) {
                    complaints_.add("solid.box.max",
                                    fmt::format("`max` must lie beyond `min`, but in {} it is {} and `min` is {}",
                                                "xyz"[d], solid_.box->max[d], solid_.box->min[d]),
                                    "min is the lower left corner, max the upper right one");
                    break;
                }
        double elements = 1;
        for (const int along : solid_.elements) elements *= std::max(along, 1);  // no third count in two dimensions
        if (box && elements > most_elements && !complaints_.touch("solid.box"))
            complaints_.add("solid.box.elements",
                            fmt::format("{:.2g} elements are more than {:.2g}", elements, most_elements),
                            "take fewer along each side");
        if (scene_.fluid && solid_.element_order == 1 && !complaints_.touch("solid.order"))
            complaints_.add("solid.order", "a body in water needs elements with nodes on their edges",
                            "take `order` out");
        if (solid_.mesh.extension() == ".inp" && given("solid.order"))
            complaints_.add("solid.order", "the deck says itself whether its elements are linear or quadratic",
                            "take `order` out");
        if (mesh && !complaints_.touch("solid.mesh") && !std::filesystem::exists(solid_.mesh))
            complaints_.add("solid.mesh",
                            fmt::format("the mesh {} does not exist", solid_.mesh.lexically_normal().string()),
                            "a Gmsh (.msh) or CalculiX (.inp) file; the path is seen from the scene's folder");
    }

    // Which numbers a law needs, and which it does not know.
    void material(const std::string& at, const MaterialScene& material) {
        if (complaints_.touch(at)) return;
        const bool rubber = material.law == solid::MaterialLaw::mooney_rivlin,
                   measured = material.law == solid::MaterialLaw::uniaxial_curve;
        const std::vector<std::string_view> takes =
            rubber     ? std::vector<std::string_view>{"c10", "bulk_modulus"}
            : measured ? std::vector<std::string_view>{"curve", "poissons_ratio"}
                       : std::vector<std::string_view>{"youngs_modulus", "poissons_ratio"};
        const std::string heading = at == "solid.material" ? "[solid.material]" : "[[solid.part]]";
        const std::string law(word(material_law_words, material.law));
        const std::string help = fmt::format("the law {} takes density, {}", law,
                                             rubber     ? "c10, c01 (0 if not given) and bulk_modulus"
                                             : measured ? "curve and poissons_ratio"
                                                        : "youngs_modulus and poissons_ratio");
        for (const char* key : {"youngs_modulus", "poissons_ratio", "c10", "c01", "bulk_modulus", "curve"}) {
            const bool here = given(at + "." + key), known = std::find(takes.begin(), takes.end(), key) != takes.end();
            if (here && !known && !(rubber && std::string_view(key) == "c01"))
                complaints_.add(at + "." + key, fmt::format("`{}` does not belong to the law {}", key, law), help);
            if (!here && known) complaints_.add(at, fmt::format("`{}` is missing in {}", key, heading), help);
        }
        if (scene_.dimension == 2 && solid_.plane == solid::PlaneCondition::stress &&
            (rubber || measured || material.law == solid::MaterialLaw::neo_hookean))
            complaints_.add(at, fmt::format("the law {} is there in plane strain only", law),
                            "take plane = \"strain\" or the law saint_venant_kirchhoff");
    }

    void wet() {
        for (std::size_t i = 0; i < solid_.wet.size(); ++i)
            validate_set(scene_, element("solid.wet", i), solid_.wet[i], "surface", complaints_);
        repeated(solid_.wet, "solid.wet", "");
        if (!scene_.fluid && !solid_.wet.empty() && !complaints_.touch("fluid"))
            complaints_.add("solid.wet", "there is no water in this scene for the surfaces to touch",
                            "take `wet` out, or add [fluid]");
        if (!solid_.wet.empty() || complaints_.touch("solid.wet")) return;
        if (given("solid.wet"))
            complaints_.add("solid.wet", "`wet` is empty",
                            "name the surfaces that touch the water: wet = [\"left\", \"bottom\"]");
        else if (scene_.fluid)
            complaints_.add("solid.wet", "no surface of the solid touches the water: `wet` is missing in [solid]",
                            "name the surfaces that touch the water: wet = [\"left\", \"bottom\"]");
    }

    void time() {
        if (complaints_.touch("solid.scheme")) return;
        const bool is_explicit = solid_.scheme == solid::Scheme::central_difference;
        if (is_explicit && given("solid.scheme.alpha"))
            complaints_.add("solid.scheme.alpha", "central differences have no αs", "take it out");
        if (scene_.fluid) {
            if (solid_.is_static)
                complaints_.add("solid.scheme.name", "a body in water moves: static is for a body alone",
                                "choose hht or newmark");
            if (given("solid.scheme.step"))
                complaints_.add("solid.scheme.step", "with water the step of the solid is the coupling cycle",
                                "take it out; [coupling] ratio makes the cycle longer");
            return;
        }
        if (complaints_.touch("fluid")) return;
        if (solid_.is_static) {
            for (const char* key : {"solid.scheme.alpha", "solid.static_start", "solid.damping", "solid.velocity"})
                if (given(key)) complaints_.add(key, "this does nothing in a static run", "take it out");
        } else if (!given("solid.scheme.step") && !is_explicit) {
            complaints_.add("solid", "without water nothing says how long a time step is",
                            "give step in [solid.scheme], or name = \"static\" for an equilibrium");
        }
    }

    void loads() {
        if (scene_.fluid)
            for (const char* list : {"solid.traction", "solid.force"})
                if (complaints_.positions.contains(element(list, 0)))
                    complaints_.add(element(list, 0), "a body in water bears the water's load alone",
                                    "take it out, or [fluid]");
        for (std::size_t i = 0; i < solid_.tractions.size(); ++i) {
            const std::string at = element("solid.traction", i);
            validate_set(scene_, at + ".surface", solid_.tractions[i].surface, "surface", complaints_);
            history(at, solid_.tractions[i].factor);
        }
        for (std::size_t i = 0; i < solid_.forces.size(); ++i) {
            const std::string at = element("solid.force", i);
            if (given(at + ".set") == given(at + ".point") && !complaints_.touch(at))
                complaints_.add(at,
                                given(at + ".set") ? "there are both a `set` and a `point` for this force"
                                                   : "the force has no place: neither `set` nor `point`",
                                "give one of them");
            if (given(at + ".set")) validate_set(scene_, at + ".set", solid_.forces[i].set, "node set", complaints_);
            history(at, solid_.forces[i].factor);
        }
    }

    void history(const std::string& at, const LoadHistory& history) {
        const std::string key = at + ".table";
        if (complaints_.touch(key) || history.table.empty()) return;
        const std::string help = "two columns of numbers, time and factor; the path is seen from the scene's folder";
        if (!history.formula.empty())
            complaints_.add(key, "there are both a `factor` and a `table`", "give one of them");
        if (!std::filesystem::exists(history.table)) {
            complaints_.add(key, fmt::format("the file {} does not exist", history.table.lexically_normal().string()),
                            help);
            return;
        }
        try {
            Compare columns;
            columns.file = history.table;
            read_reference(columns);
        } catch (const std::exception& error) {
            complaints_.add(key, fmt::format("the file cannot be used: {}", error.what()), help);
        }
    }

    void repeated(const std::vector<std::string>& sets, std::string_view list, std::string_view key) {
        std::set<std::string> seen;
        for (std::size_t i = 0; i < sets.size(); ++i)
            if (!sets[i].empty() && !seen.insert(sets[i]).second)
                complaints_.add(element(list, i, key), fmt::format("\"{}\" is named twice", sets[i]),
                                "name each set once");
    }

    const Scene& scene_;
    const SolidScene& solid_;
    Complaints& complaints_;
};

}  // namespace

void validate_solid(const Scene& scene, Complaints& complaints) {
    if (scene.solid) SolidValidation(scene, complaints).everything();
}

}  // namespace aquagraph::io
