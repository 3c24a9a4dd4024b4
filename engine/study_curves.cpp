#include "engine/study_curves.hpp"

#include <algorithm>

namespace aquagraph::engine {

double total_variation(const Curve& curve) {
    if (curve.value.empty()) return NAN;
    double sum = 0;
    for (std::size_t k = 1; k < curve.value.size(); ++k) sum += std::fabs(curve.value[k] - curve.value[k - 1]);
    return std::isfinite(sum) ? sum : NAN;
}

double growth(const Curve& curve) {
    if (curve.time.empty()) return NAN;
    const auto range = [&](double from, double to) {
        double low = INFINITY, high = -INFINITY;
        for (std::size_t k = 0; k < curve.time.size(); ++k) {
            if (curve.time[k] < from * curve.time.back() || curve.time[k] > to * curve.time.back()) continue;
            if (!std::isfinite(curve.value[k])) return double(NAN);
            low = std::min(low, curve.value[k]);
            high = std::max(high, curve.value[k]);
        }
        return high - low;
    };
    return range(0.75, 1) / range(0.25, 0.5);
}

double difference(const Curve& curve, const Curve& reference) {
    if (curve.time.empty() || reference.time.empty()) return NAN;
    double sum = 0, peak = 0;
    std::size_t k = 0;
    for (std::size_t r = 0; r < reference.time.size(); ++r) {
        const double t = reference.time[r];
        peak = std::max(peak, std::fabs(reference.value[r]));
        while (k + 1 < curve.time.size() && curve.time[k + 1] < t) ++k;
        const bool last = k + 1 == curve.time.size();
        if (last && t > curve.time[k] * (1 + 1e-9)) return NAN;
        const std::size_t next = last ? k : k + 1;
        const double span = curve.time[next] - curve.time[k];
        const double s = span > 0 ? std::clamp((t - curve.time[k]) / span, 0.0, 1.0) : 1;
        const double d = (1 - s) * curve.value[k] + s * curve.value[next] - reference.value[r];
        sum += d * d;
    }
    return peak > 0 ? std::sqrt(sum / double(reference.time.size())) / peak : NAN;
}

double speedup_theory(bool parallel, double p, double t, double f) {
    if (!parallel) return p * (t + 1) / (t + p);
    return f * std::min(p, std::max(t, 1.0));
}

double speedup_on_threads(bool parallel, double p, double t, double f, int n) {
    if (!parallel) return speedup_theory(parallel, p, t, f);
    const auto cycle = [&](double steps) { return std::max(t, steps + t / n); };
    return f * p * cycle(1) / cycle(p);
}

}  // namespace aquagraph::engine
