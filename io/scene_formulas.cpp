#include "io/scene_formulas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/suggestion.hpp"

namespace aquagraph::io {
namespace {

// Names that mean something in one formula or another.
bool taken(const std::string& name) {
    const auto variables = names_of_particle();
    return name == "dx" || name == "rho0" || name == "c0" ||
           std::find(variables.begin(), variables.end(), name) != variables.end();
}

// What helps with an unknown name.
std::string help(const ExpressionError& error, const std::vector<std::string>& variables, const Constants& constants) {
    std::vector<std::string> known = variables;
    for (const auto& [name, value] : constants) known.push_back(name);
    known.emplace_back("pi");
    if (!error.unknown().empty())
        if (const auto guess = nearest(error.unknown(), known)) return fmt::format("did you mean \"{}\"?", *guess);
    return fmt::format("a formula takes {}, functions such as sin, exp, sqrt, and numbers; [constants] adds names",
                       fmt::join(known, ", "));
}

class FormulaCheck {
  public:
    FormulaCheck(const Scene& scene, Complaints& complaints)
        : complaints_(complaints),
          constants_(all_constants(scene)),
          known_(!complaints.touch("constants")),
          dimensions_(std::size_t(scene.dimension)) {}

    void formula(const std::string& key, const std::string& text, const std::vector<std::string>& variables) {
        if (text.empty() || complaints_.touch(key) || !known_) return;
        try {
            Expression(text, variables, constants_);
        } catch (const ExpressionError& error) {
            complaints_.add(key, fmt::format("\"{}\" is no formula: {}", text, error.what()),
                            help(error, variables, constants_));
        }
    }

    void vector(const std::string& key, const std::vector<std::string>& parts,
                const std::vector<std::string>& variables) {
        if (parts.empty() || complaints_.touch(key)) return;
        if (parts.size() != dimensions_)
            complaints_.add(
                key, fmt::format("this takes {} formulas, one per direction, but has {}", dimensions_, parts.size()),
                "velocity = [\"U*sin(k*x)\", \"0\"]");
        for (std::size_t d = 0; d < parts.size(); ++d) formula(fmt::format("{}[{}]", key, d), parts[d], variables);
    }

  private:
    Complaints& complaints_;
    Constants constants_;
    bool known_;
    std::size_t dimensions_;
};

}  // namespace

std::vector<std::string> names_of_position() {
    return {"x", "y", "z"};
}
std::vector<std::string> names_of_field() {
    return {"x", "y", "z", "t"};
}
std::vector<std::string> names_of_particle() {
    return {"x", "y", "z", "t", "vx", "vy", "vz", "p", "rho", "fullness"};
}

Constants resolve_constants(const CheckedDocument& document, Complaints& complaints) {
    constexpr std::string_view section = "constants.";
    Constants known;
    std::map<std::string, std::string> formulas;
    for (const auto& [key, value] : document.values) {
        if (!key.starts_with(section)) continue;
        const std::string name = key.substr(section.size());
        if (!usable_as_constant(name) || taken(name))
            complaints.add(key, fmt::format("\"{}\" cannot be the name of a constant", name),
                           "letters, digits and _, beginning with a letter; names of functions, x, y, z, t, vx, vy, "
                           "vz, p, rho, fullness, dx, rho0, c0 and pi have their meaning already");
        else if (const double* number = std::get_if<double>(&value))
            known[name] = *number;
        else
            formulas[name] = std::get<std::string>(value);
    }
    while (!formulas.empty()) {
        const std::size_t left = formulas.size();
        std::map<std::string, ExpressionError> errors;
        std::erase_if(formulas, [&](const auto& entry) {
            try {
                known[entry.first] = constant_value(entry.second, known);
                return true;
            } catch (const ExpressionError& error) {
                errors.try_emplace(entry.first, error);
                return false;
            }
        });
        if (formulas.size() < left) continue;
        for (const auto& [name, error] : errors)
            complaints.add(fmt::format("constants.{}", name),
                           fmt::format("\"{}\" is no formula: {}", formulas.at(name), error.what()),
                           formulas.contains(error.unknown()) ? "constants may not build on one another in a circle"
                                                              : help(error, {}, known));
        break;
    }
    for (const auto& [name, value] : known)
        if (!std::isfinite(value))
            complaints.add(fmt::format("constants.{}", name), fmt::format("`{}` is {}", name, value),
                           "a constant must be finite");
    return known;
}

Constants all_constants(const Scene& scene) {
    Constants all = scene.constants;
    if (scene.fluid) {
        all["dx"] = scene.fluid->spacing;
        all["rho0"] = scene.fluid->density;
        all["c0"] = scene.fluid->sound_speed;
    }
    return all;
}

void validate_formulas(const Scene& scene, Complaints& complaints) {
    FormulaCheck check(scene, complaints);
    if (scene.fluid) {
        check.vector("fluid.initial.velocity", scene.fluid->initial.velocity, names_of_position());
        check.formula("fluid.initial.pressure", scene.fluid->initial.pressure, names_of_position());
        if (!scene.fluid->initial.pressure.empty() && complaints.positions.contains("fluid.initial_pressure"))
            complaints.add("fluid.initial.pressure", "the pressure at t = 0 is given twice",
                           "keep either `initial_pressure` in [fluid] or `pressure` in [fluid.initial]");
    } else {
        for (const char* section : {"integral", "extreme", "field_error"})
            if (complaints.positions.contains(fmt::format("{}[0]", section)))
                complaints.add(fmt::format("{}[0]", section), "there is no water in this scene to sum over",
                               "add [fluid]");
    }
    if (scene.solid) {
        for (std::size_t i = 0; i < scene.solid->tractions.size(); ++i)
            check.formula(fmt::format("solid.traction[{}].factor", i), scene.solid->tractions[i].factor.formula, {"t"});
        for (std::size_t i = 0; i < scene.solid->forces.size(); ++i)
            check.formula(fmt::format("solid.force[{}].factor", i), scene.solid->forces[i].factor.formula, {"t"});
    }
    std::set<std::string> columns;
    const auto name = [&](const std::string& key, const std::string& given) {
        if (complaints.touch(key) || given.empty()) return;
        if (given.find_first_of(",[]\"\n ") != std::string::npos)
            complaints.add(key, fmt::format("\"{}\" cannot be the name of a column", given),
                           "letters, digits and _, beginning with a letter");
        else if (!columns.insert(given).second)
            complaints.add(key, fmt::format("there is a column \"{}\" already", given), "choose another name");
    };
    const auto at = [](const char* list, std::size_t i, const char* key) {
        return fmt::format("{}[{}].{}", list, i, key);
    };
    for (std::size_t i = 0; i < scene.integrals.size(); ++i) {
        name(at("integral", i, "name"), scene.integrals[i].name);
        check.formula(at("integral", i, "value"), scene.integrals[i].value, names_of_particle());
        check.formula(at("integral", i, "weight"), scene.integrals[i].weight, names_of_particle());
    }
    for (std::size_t i = 0; i < scene.extremes.size(); ++i) {
        name(at("extreme", i, "name"), scene.extremes[i].name);
        check.formula(at("extreme", i, "value"), scene.extremes[i].value, names_of_particle());
        check.formula(at("extreme", i, "where"), scene.extremes[i].where, names_of_particle());
    }
    for (std::size_t i = 0; i < scene.field_errors.size(); ++i) {
        const FieldError& error = scene.field_errors[i];
        name(at("field_error", i, "name"), error.name);
        check.vector(at("field_error", i, "velocity"), error.velocity, names_of_field());
        check.formula(at("field_error", i, "pressure"), error.pressure, names_of_field());
        check.formula(at("field_error", i, "where"), error.where, names_of_particle());
        if (error.velocity.empty() && error.pressure.empty() && !complaints.touch(fmt::format("field_error[{}]", i)))
            complaints.add(fmt::format("field_error[{}]", i), "there is no field to compare with",
                           "give `velocity`, `pressure` or both");
    }
    for (std::size_t i = 0; i < scene.comparisons.size(); ++i)
        check.formula(at("compare", i, "formula"), scene.comparisons[i].formula, {"t"});
}

}  // namespace aquagraph::io
