// The words by which a scene file chooses, and what they mean: the reader, the resolved scene and the report share
// them.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "io/scene.hpp"
#include "io/toml_document.hpp"

namespace aquagraph::io {

template <class E, std::size_t n>
using Words = std::array<std::pair<std::string_view, E>, n>;

inline constexpr Words<fluid::KernelName, 2> kernel_words{
    {{"wendland_c2", fluid::KernelName::wendland_c2}, {"cubic_spline", fluid::KernelName::cubic_spline}}};
inline constexpr Words<fluid::Scheme, 4> scheme_words{{{"riemann", fluid::Scheme::riemann},
                                                       {"riemann_ale", fluid::Scheme::riemann_ale},
                                                       {"delta_sph", fluid::Scheme::delta_sph},
                                                       {"artificial_viscosity", fluid::Scheme::artificial_viscosity}}};
inline constexpr Words<fluid::RiemannSolver, 3> riemann_solver_words{
    {{"acoustic", fluid::RiemannSolver::acoustic},
     {"low_dissipation", fluid::RiemannSolver::low_dissipation},
     {"exact", fluid::RiemannSolver::exact}}};
inline constexpr Words<fluid::IntegrationScheme, 3> integration_words{{{"rk4", fluid::IntegrationScheme::rk4},
                                                                       {"rk3", fluid::IntegrationScheme::rk3},
                                                                       {"verlet", fluid::IntegrationScheme::verlet}}};
inline constexpr Words<fluid::ViscousOperator, 2> viscous_operator_words{
    {{"monaghan_gingold", fluid::ViscousOperator::monaghan_gingold}, {"morris", fluid::ViscousOperator::morris}}};
inline constexpr Words<fluid::Transport, 3> transport_words{
    {{"none", fluid::Transport::none}, {"x_sph", fluid::Transport::x_sph}, {"shifting", fluid::Transport::shifting}}};

inline constexpr Words<CouplingAlgorithm, 3> algorithm_words{
    {{"cps", CouplingAlgorithm::cps}, {"css", CouplingAlgorithm::css}, {"iterated", CouplingAlgorithm::iterated}}};
inline constexpr Words<coupling::Relaxation, 2> relaxation_words{
    {{"aitken", coupling::Relaxation::aitken}, {"quasi_newton", coupling::Relaxation::quasi_newton}}};
inline constexpr Words<coupling::LoadMethod, 3> load_words{
    {{"averaged_pressure", coupling::LoadMethod::averaged_pressure},
     {"force_conservative", coupling::LoadMethod::force_conservative},
     {"energy_conservative", coupling::LoadMethod::energy_conservative}}};
inline constexpr Words<coupling::Extrapolation, 3> extrapolation_words{
    {{"none", coupling::Extrapolation::none},
     {"linear", coupling::Extrapolation::linear},
     {"quadratic", coupling::Extrapolation::quadratic}}};
inline constexpr Words<coupling::StepRule, 2> step_rule_words{
    {{"fixed", coupling::StepRule::fixed}, {"predicted", coupling::StepRule::predicted}}};

inline constexpr Words<Slip, 3> slip_words{{{"free", Slip::free}, {"none", Slip::none}, {"symmetry", Slip::symmetry}}};

inline constexpr Words<solid::MaterialLaw, 5> material_law_words{
    {{"saint_venant_kirchhoff", solid::MaterialLaw::saint_venant_kirchhoff},
     {"linear", solid::MaterialLaw::linear},
     {"neo_hookean", solid::MaterialLaw::neo_hookean},
     {"mooney_rivlin", solid::MaterialLaw::mooney_rivlin},
     {"uniaxial_curve", solid::MaterialLaw::uniaxial_curve}}};
inline constexpr Words<solid::Integration, 2> integration_points_words{
    {{"reduced", solid::Integration::reduced}, {"full", solid::Integration::full}}};
inline constexpr Words<solid::PlaneCondition, 2> plane_words{
    {{"strain", solid::PlaneCondition::strain}, {"stress", solid::PlaneCondition::stress}}};
inline constexpr Words<SolidSolver, 2> solid_solver_words{
    {{"built_in", SolidSolver::built_in}, {"calculix", SolidSolver::calculix}}};
inline constexpr Words<solid::Scheme, 3> solid_scheme_words{
    {{"hht", solid::Scheme::hht},
     {"newmark", solid::Scheme::newmark},
     {"central_difference", solid::Scheme::central_difference}}};
inline constexpr Words<solid::GroundShape, 3> ground_words{{{"plane", solid::GroundShape::plane},
                                                            {"cylinder", solid::GroundShape::cylinder},
                                                            {"sphere", solid::GroundShape::sphere}}};
inline constexpr Words<int, 3> direction_words{{{"x", 0}, {"y", 1}, {"z", 2}}};
// Of a rigid body: in two dimensions, and in three.
inline constexpr Words<int, 3> plane_freedom_words{{{"x", 0}, {"y", 1}, {"turn", 2}}};
inline constexpr Words<int, 6> freedom_words{
    {{"x", 0}, {"y", 1}, {"z", 2}, {"turn_x", 3}, {"turn_y", 4}, {"turn_z", 5}}};

// The meaning of the word that a document has at this key; without one `target`, the default, stays as it is. The word
// is known to be one of these (CheckedDocument). meanings: Words, or a list of pairs.
template <class E, class Meanings>
void take_choice(const CheckedDocument& document, const std::string& key, E& target, const Meanings& meanings) {
    std::string word;
    if (!document.take(key, word)) return;
    for (const auto& [name, value] : meanings)
        if (name == word) target = value;
}

// The word for a meaning.
template <class E, std::size_t n>
constexpr std::string_view word(const Words<E, n>& words, E meaning) {
    for (const auto& [name, value] : words)
        if (value == meaning) return name;
    return {};
}

}  // namespace aquagraph::io
