// Runs of a study compared with each other by one column of their histories, and by what a step costs.
#pragma once
#include <cmath>
#include <string>
#include <vector>

namespace aquagraph::engine {

struct Curve {
    std::vector<double> time, value;
};

// Σ |v_k+1 - v_k|: how far a curve goes up and down. NaN for one that is empty or not finite.
double total_variation(const Curve& curve);
// The curve's range in the last quarter of its time over that in the second one: a swing that grows has more than 1.
double growth(const Curve& curve);
// Root mean square of the difference at the reference's times, over the reference's largest value; NaN where the curve
// does not reach over them or one of both is empty.
double difference(const Curve& curve, const Curve& reference);

// Speedup by p fluid steps per solid step (thesis (6.7)-(6.9)), t: time of a solid step over that of a fluid step,
// f: the step over that of p = 1. CSS: p (t + 1)/(t + p). CPS: f p while t > p, else f t; where t < 1 the thesis's f t
// would be less than the fluid's own time allows, which hides all of the solid's already at p = 1: then f. The thesis
// has f = 0.8: its p = 1 takes whole CFL steps, and only p > 1 fixes them beforehand; here CPS with p = 1 does so too.
double speedup_theory(bool parallel, double p, double t, double f);
// The thesis gives the solid processors of its own. Where it uses one of n threads that the fluid uses too, a cycle of
// CPS takes as long as the work needs, max(t, p + t/n), and the speedup is f p max(t, 1 + t/n) / max(t, p + t/n).
double speedup_on_threads(bool parallel, double p, double t, double f, int n);

}  // namespace aquagraph::engine
