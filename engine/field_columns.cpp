#include "engine/field_columns.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/scene_formulas.hpp"

namespace aquagraph::engine {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::optional<io::Expression> optional_formula(const std::string& text, std::vector<std::string> names,
                                               const io::Constants& constants) {
    if (text.empty()) return std::nullopt;
    return io::Expression(text, std::move(names), constants);
}

}  // namespace

struct FieldColumns::Integral {
    io::Expression value;
    std::optional<io::Expression> weight;
    double sum = 0, weights = 0;
};

struct FieldColumns::Extreme {
    io::Expression value;
    std::optional<io::Expression> where;
    bool largest;
    double found = 0;
};

struct FieldColumns::FieldError {
    std::vector<io::Expression> velocity;
    std::optional<io::Expression> pressure, where;
    std::optional<double> velocity_scale, pressure_scale;
    double velocity_error = 0, velocity_norm = 0, pressure_error = 0, pressure_norm = 0, mass = 0;

    // sqrt(Σ m d²/Σ m) over the scale, or over sqrt(Σ m exact²/Σ m).
    double result(double error, double norm, const std::optional<double>& scale) const {
        if (scale) return mass > 0 ? std::sqrt(error / mass) / *scale : not_a_number;
        return norm > 0 ? std::sqrt(error / norm) : not_a_number;
    }
};

FieldColumns::FieldColumns(const io::Scene& scene) {
    if (!scene.fluid) return;
    const io::Constants constants = io::all_constants(scene);
    const auto key = [](const char* list, std::size_t k) { return fmt::format("{}[{}].name", list, k); };
    for (const io::Integral& integral : scene.integrals) {
        keys_.push_back(key("integral", integrals_.size()));
        columns_.push_back({integral.name, integral.unit});
        integrals_.push_back({io::Expression(integral.value, io::names_of_particle(), constants),
                              optional_formula(integral.weight, io::names_of_particle(), constants)});
    }
    for (const io::Extreme& extreme : scene.extremes) {
        keys_.push_back(key("extreme", extremes_.size()));
        columns_.push_back({extreme.name, extreme.unit});
        extremes_.push_back({io::Expression(extreme.value, io::names_of_particle(), constants),
                             optional_formula(extreme.where, io::names_of_particle(), constants), extreme.largest});
    }
    for (const io::FieldError& error : scene.field_errors) {
        FieldError& made = errors_.emplace_back();
        for (const std::string& component : error.velocity)
            made.velocity.emplace_back(component, io::names_of_field(), constants);
        made.pressure = optional_formula(error.pressure, io::names_of_field(), constants);
        made.where = optional_formula(error.where, io::names_of_particle(), constants);
        made.velocity_scale = error.velocity_scale;
        made.pressure_scale = error.pressure_scale;
        if (!made.velocity.empty()) columns_.push_back({error.name + "_velocity_error", ""});
        if (made.pressure) columns_.push_back({error.name + "_pressure_error", ""});
        keys_.resize(columns_.size(), key("field_error", errors_.size() - 1));
    }
}

FieldColumns::~FieldColumns() = default;
FieldColumns::FieldColumns(FieldColumns&&) noexcept = default;

std::string FieldColumns::key_of(const std::string& column) const {
    for (std::size_t k = 0; k < columns_.size(); ++k)
        if (columns_[k].name == column) return keys_[k];
    return {};
}

template <int D>
void FieldColumns::append(const fluid::Particles<D>& s, const fluid::Tait& tait, double time,
                          std::vector<double>& row) {
    for (Integral& integral : integrals_) integral.sum = integral.weights = 0;
    for (Extreme& extreme : extremes_) extreme.found = not_a_number;
    for (FieldError& error : errors_)
        error.velocity_error = error.velocity_norm = error.pressure_error = error.pressure_norm = error.mass = 0;

    for (std::size_t i = 0; i < s.count && !columns_.empty(); ++i) {
        // In the order of io::names_of_particle, which begins with that of names_of_field.
        std::array<double, 10> values{
            0, 0, 0, time, 0, 0, 0, s.p[i], tait.reference_density + s.deviation[i], s.fullness[i]};
        for (std::size_t d = 0; d < D; ++d) {
            values[d] = s.x[d][i];
            values[4 + d] = s.v[d][i];
        }
        for (Integral& integral : integrals_) {
            const double weight = s.volume[i] * (integral.weight ? (*integral.weight)(values) : 1.0);
            integral.sum += weight * integral.value(values);
            integral.weights += weight;
        }
        for (Extreme& extreme : extremes_) {
            if (extreme.where && (*extreme.where)(values) == 0) continue;
            const double value = extreme.value(values);
            if (!(extreme.largest ? value <= extreme.found : value >= extreme.found)) extreme.found = value;
        }
        for (FieldError& error : errors_) {
            if (error.where && (*error.where)(values) == 0) continue;
            error.mass += s.mass[i];
            for (std::size_t d = 0; d < error.velocity.size(); ++d) {
                const double exact = error.velocity[d](values), difference = values[4 + d] - exact;
                error.velocity_error += s.mass[i] * difference * difference;
                error.velocity_norm += s.mass[i] * exact * exact;
            }
            if (error.pressure) {
                const double exact = (*error.pressure)(values), difference = s.p[i] - exact;
                error.pressure_error += s.mass[i] * difference * difference;
                error.pressure_norm += s.mass[i] * exact * exact;
            }
        }
    }
    for (const Integral& integral : integrals_)
        row.push_back(!integral.weight ? integral.sum
                                       : (integral.weights != 0 ? integral.sum / integral.weights : not_a_number));
    for (const Extreme& extreme : extremes_) row.push_back(extreme.found);
    for (const FieldError& error : errors_) {
        if (!error.velocity.empty())
            row.push_back(error.result(error.velocity_error, error.velocity_norm, error.velocity_scale));
        if (error.pressure)
            row.push_back(error.result(error.pressure_error, error.pressure_norm, error.pressure_scale));
    }
}

template void FieldColumns::append(const fluid::Particles<2>&, const fluid::Tait&, double, std::vector<double>&);
template void FieldColumns::append(const fluid::Particles<3>&, const fluid::Tait&, double, std::vector<double>&);

}  // namespace aquagraph::engine
