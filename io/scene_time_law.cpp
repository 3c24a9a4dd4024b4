#include "io/scene_time_law.hpp"

#include <fmt/format.h>

#include "io/comparison.hpp"
#include "io/value_ranges.hpp"

namespace aquagraph::io {

namespace {

using namespace ranges;
constexpr const char* table_help = "rows of two columns, time [s] and value, in increasing time; t = 0 lies among them";

}  // namespace

std::vector<SceneKey> time_law_keys(std::string_view section, std::string_view unit, std::string_view rate_unit) {
    using K = KeyKind;
    return {
        {section, "value", K::number, false, unit, any, "", "0", "from the start on"},
        {section, "rate", K::number, false, rate_unit, any, "", "0", "grows evenly, from 0 at t = 0"},
        {section, "amplitude", K::number, false, unit, any, "", "none", "of a swing, sin(2π f t + φ) - sin φ"},
        {section, "frequency", K::number, false, "Hz", positive, "", "none", "of the swing; or `period`"},
        {section, "period", K::number, false, "s", positive, "", "none", "1/frequency"},
        {section, "phase", K::number, false, "rad", any, "", "0", "φ"},
        {section, "ramp", K::number, false, "s", not_negative, "", "0",
         "time in which rate and amplitude grow smoothly"},
        {section, "points", K::pairs, false, "", any, "", "none",
         "[[time, value], …]: a smooth curve through them, which does not overshoot; straight between two, constant "
         "outside"},
        {section, "table", K::text, false, "", any, "", "none",
         "instead of `points`: a file of two columns, seen from the scene's folder"},
    };
}

void read_time_law(const CheckedDocument& document, const std::string& at, const std::filesystem::path& folder,
                   TimeLawScene& law) {
    document.take(at + ".value", law.value);
    document.take(at + ".rate", law.rate);
    document.take(at + ".amplitude", law.amplitude);
    document.take(at + ".frequency", law.frequency);
    if (double period = 0; document.take(at + ".period", period)) law.frequency = 1 / period;
    document.take(at + ".phase", law.phase);
    document.take(at + ".ramp", law.ramp);
    document.take(at + ".points", law.points);
    if (std::string file; document.take(at + ".table", file)) law.table = (folder / file).lexically_normal();
}

void validate_time_law(const TimeLawScene& law, const std::string& at, Complaints& complaints) {
    if (complaints.touch(at)) return;
    const auto given = [&](const char* key) { return complaints.positions.contains(at + "." + key); };
    if (!given("value") && !given("rate") && !given("amplitude") && !given("points") && !given("table"))
        complaints.add(at, "nothing says how large this is",
                       "give value, rate, amplitude, points = [[time, value], …] or table = \"file.csv\"");
    if (given("amplitude") && given("frequency") == given("period"))
        complaints.add(at + ".amplitude",
                       given("period") ? "both `frequency` and `period` are given"
                                       : "`frequency` or `period` of the swing is missing",
                       "give one of them");
    for (const char* key : {"frequency", "period", "phase"})
        if (given(key) && !given("amplitude"))
            complaints.add(at + "." + key, fmt::format("`{}` belongs to a swing, and there is no `amplitude`", key),
                           "give the amplitude or take it out");
    if (given("ramp") && !given("amplitude") && !given("rate"))
        complaints.add(at + ".ramp", "`ramp` is for `rate` and `amplitude`, and there is neither",
                       "points = [[0, 0], [0.1, 5]] grows smoothly to 5 in 0.1 s");
    if (given("points") && given("table"))
        complaints.add(at + ".table", "there are both `points` and a `table`", "give one of them");
    if (complaints.touch(at)) return;
    try {
        time_function(law);
    } catch (const std::exception& error) {
        complaints.add(at + (given("points") ? ".points" : ".table"),
                       fmt::format("this cannot be used: {}", error.what()), table_help);
    }
}

TimeFunction time_function(const TimeLawScene& law) {
    TimeFunction function;
    if (!law.points.empty()) {
        std::vector<double> time, value;
        for (const auto& [t, u] : law.points) {
            time.push_back(t);
            value.push_back(u);
        }
        function = TimeFunction::table(std::move(time), std::move(value));
    } else if (!law.table.empty()) {
        Compare columns;
        columns.file = law.table;
        Curve curve = read_reference(columns);
        function = TimeFunction::table(std::move(curve.time), std::move(curve.value));
    }
    function.initial += law.value;
    if (law.rate != 0) function.changes.push_back(ConstantRate{law.rate, {law.ramp}});
    if (law.amplitude != 0) function.changes.push_back(Harmonic{law.amplitude, law.frequency, law.phase, {law.ramp}});
    return function;
}

}  // namespace aquagraph::io
