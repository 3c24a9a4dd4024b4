#include "physics/fluid/relaxation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "physics/fluid/kernel.hpp"
#include "physics/fluid/neighbour_search.hpp"
#include "physics/fluid/pair_loop.hpp"
#include "physics/fluid/spatial_order.hpp"
#include "physics/geometry/facet_tree.hpp"
#include "physics/geometry/inside.hpp"

namespace aquagraph::fluid {

namespace {

using geometry::Vec;

constexpr double push = 0.4;          // c
constexpr double longest_move = 0.1;  // of a spacing, in one step
constexpr double least_depth = 0.3;   // of a spacing, below the boundary
constexpr double piece = 0.3;         // of a spacing, of the boundary's pieces
constexpr int most_steps = 2000, patience = 50;
constexpr double least_gain = 0.02;

// ∫_r^R W s^(D-1) ds for Wendland's kernel with ∫ W = 1.
template <int D>
double kernel_beyond(double r, double support) {
    const double q = r / support;
    if (q >= 1) return 0;
    const auto antiderivative = [](double u) {  // of u^(D-1) (1-u)⁴ (1+4u)
        return D == 2 ? u * u * (1.0 / 2 + u * u * (-5.0 / 2 + u * (4 + u * (-5.0 / 2 + u * 4 / 7))))
                      : u * u * u * (1.0 / 3 + u * u * (-2 + u * (10.0 / 3 + u * (-15.0 / 7 + u / 2))));
    };
    const double whole_angle = D == 2 ? 2 * std::numbers::pi : 4 * std::numbers::pi;
    return (1 - antiderivative(q) / antiderivative(1)) / whole_angle;
}

template <int D>
struct Crowding {
    const Particles<D>& s;
    double inverse_radius, slope_factor, half_beta;
    std::vector<Vec<D>>& gradient;
    std::vector<double>& sum_of;

    struct Own {
        double x[D];
    };
    struct Sum {
        double kernel[W]{}, gradient[D][W]{};
    };
    Own load(std::size_t i) const {
        Own own;
        for (std::size_t d = 0; d < D; ++d) own.x[d] = s.x[d][i];
        return own;
    }
    [[gnu::always_inline]] void pair(const Own& own, std::size_t j, double seen, Sum& sum, std::size_t lane) const {
        double dx[D], r2 = 0;
        for (std::size_t d = 0; d < D; ++d) {
            dx[d] = s.x[d][j] - own.x[d];
            r2 += dx[d] * dx[d];
        }
        const double q = std::sqrt(r2) * inverse_radius, u = std::max(0.0, 1 - q), volume = seen * s.volume[j];
        sum.kernel[lane] += volume * half_beta * u * u * u * u * (1 + 4 * q);
        for (std::size_t d = 0; d < D; ++d) sum.gradient[d][lane] += volume * slope_factor * u * u * u * dx[d];
    }
    void store(std::size_t i, const Own&, const Sum& sum) const {
        sum_of[i] = add_lanes(sum.kernel);
        for (std::size_t d = 0; d < D; ++d) gradient[i][Eigen::Index(d)] = add_lanes(sum.gradient[d]);
    }
};

template <int D>
class Relaxation {
  public:
    Relaxation(const Places<D>& places, const Region<D>& region, double spacing, double support, BlockLoop loop)
        : region_(region),
          spacing_(spacing),
          kernel_(support),
          tree_(region.boundary),
          inside_(region.boundary),
          loop_(loop) {
        outwards_ = enclosed_volume(region.boundary) > 0 ? 1 : -1;
        particles_.resize(places.x.size(), 0);
        for (std::size_t i = 0; i < particles_.count; ++i) {
            put(i, kept_inside(places.x[i]));
            particles_.volume[i] = places.volume;
            particles_.id[i] = std::int64_t(i);
        }
        lists_.radius = support;
        lists_.skin = 0.25 * support;
        gradient_.resize(particles_.size());
        sum_.resize(particles_.size());
        cut_boundary();
    }

    RelaxationResult run(double tolerance) {
        RelaxationResult result;
        measure();
        result.before = best_deviation_ = deviation_;
        keep();
        double checkpoint = deviation_;
        while (deviation_ > tolerance && result.steps < most_steps) {
            if (result.steps > 0 && result.steps % patience == 0) {
                if (best_deviation_ > (1 - least_gain) * checkpoint) break;
                checkpoint = best_deviation_;
            }
            move();
            measure();
            ++result.steps;
            if (deviation_ < best_deviation_) {
                best_deviation_ = deviation_;
                keep();
            }
        }
        result.after = best_deviation_;
        result.mean = best_mean_;
        result.reached = best_deviation_ <= tolerance;
        return result;
    }

    const std::vector<Vec<D>>& places() const { return best_; }

  private:
    struct Piece {
        Vec<D> place, area;  // area: outward normal, as long as the piece is large
    };

    Vec<D> at(std::size_t i) const {
        Vec<D> x;
        for (std::size_t d = 0; d < D; ++d) x[Eigen::Index(d)] = particles_.x[d][i];
        return x;
    }
    void put(std::size_t i, const Vec<D>& x) {
        for (std::size_t d = 0; d < D; ++d) particles_.x[d][i] = x[Eigen::Index(d)];
    }
    void keep() {
        best_mean_ = mean_;
        best_.resize(particles_.count);
        for (std::size_t i = 0; i < particles_.count; ++i) best_[std::size_t(particles_.id[i])] = at(i);
    }

    void cut_boundary() {
        const geometry::Surface<D>& surface = region_.boundary;
        const double size = piece * spacing_;
        const auto below = [&](const Vec<D>& x) { return !region_.level || x[D - 1] < *region_.level; };
        for (std::size_t f = 0; f < surface.facets.size(); ++f) {
            const Vec<D>&a = surface.vertex(f, 0), &b = surface.vertex(f, 1), front = outwards_ * surface.front(f);
            if constexpr (D == 2) {
                const int n = std::max(1, int(std::ceil((b - a).norm() / size)));
                for (int k = 0; k < n; ++k)
                    if (const Vec<D> x = a + (k + 0.5) / n * (b - a); below(x)) pieces_.push_back({x, front / n});
            } else {
                const Vec<D>& c = surface.vertex(f, 2);
                const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
                const int n = std::max(1, int(std::ceil(longest / size)));
                const auto corner = [&](double i, double j) -> Vec<D> { return a + i / n * (b - a) + j / n * (c - a); };
                for (int i = 0; i < n; ++i)
                    for (int j = 0; i + j < n; ++j) {
                        constexpr double third = 1.0 / 3;
                        if (const Vec<D> x = corner(i + third, j + third); below(x))
                            pieces_.push_back({x, front / (2 * n * n)});
                        if (i + j + 1 < n)
                            if (const Vec<D> x = corner(i + 2 * third, j + 2 * third); below(x))
                                pieces_.push_back({x, front / (2 * n * n)});
                    }
            }
        }
        if (region_.level) cut_lid(size);
    }

    // The water's surface: squares of the level's plane that lie inside the boundary.
    void cut_lid(double size) {
        const auto [low, high] = bounds(region_.boundary);
        std::array<int, 2> n{1, 1};
        for (int d = 0; d + 1 < D; ++d) n[std::size_t(d)] = std::max(1, int(std::ceil((high[d] - low[d]) / size)));
        Vec<D> area = Vec<D>::Zero();
        area[D - 1] = 1;
        for (int d = 0; d + 1 < D; ++d) area[D - 1] *= (high[d] - low[d]) / n[std::size_t(d)];
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                const std::array<int, 2> cell{i, j};
                Vec<D> x;
                for (int d = 0; d + 1 < D; ++d)
                    x[d] = low[d] + (cell[std::size_t(d)] + 0.5) / n[std::size_t(d)] * (high[d] - low[d]);
                x[D - 1] = *region_.level - 1e-9 * spacing_;
                if (inside_(x)) pieces_.push_back({x, area});
            }
    }

    void rebuild_lists() {
        reorder_.apply(particles_, order_.sort(particles_.x, particles_.count, spacing_));
        for (std::size_t d = 0; d < D; ++d)
            std::copy(particles_.x[d].begin(), particles_.x[d].end(), particles_.x_built[d].begin());
        search_.build(particles_, lists_, nullptr, loop_);
        // Pieces within reach, by cells of that width.
        pieces_near_.assign(particles_.count, {});
        const double reach = lists_.reach();
        const Vec<D> origin = bounds(region_.boundary).first;
        const auto cell_of = [&](const Vec<D>& x) {
            std::array<long, D> cell;
            for (int d = 0; d < D; ++d) cell[std::size_t(d)] = long(std::floor((x[d] - origin[d]) / reach));
            return cell;
        };
        std::map<std::array<long, D>, std::vector<int>> cells;
        for (std::size_t k = 0; k < pieces_.size(); ++k) cells[cell_of(pieces_[k].place)].push_back(int(k));
        loop_(particles_.blocks(), [&](std::size_t block) {
            const LaneRange lanes = lanes_of_block(particles_, block);
            for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
                const Vec<D> x = at(i);
                const auto centre = cell_of(x);
                for (int n = 0; n < (D == 2 ? 9 : 27); ++n) {
                    auto cell = centre;
                    for (int d = 0, rest = n; d < D; ++d, rest /= 3) cell[std::size_t(d)] += rest % 3 - 1;
                    const auto found = cells.find(cell);
                    if (found == cells.end()) continue;
                    for (const int k : found->second)
                        if ((pieces_[std::size_t(k)].place - x).squaredNorm() < reach * reach)
                            pieces_near_[i].push_back(k);
                }
            }
        });
    }

    // Kernel sums and gradients of the crowding, with what lies outside.
    void measure() {
        double moved2 = 0;
        for (std::size_t block = 0; block < particles_.blocks(); ++block)
            moved2 = std::max(moved2, largest_displacement_squared(particles_, block));
        if (!built_ || 2 * std::sqrt(moved2) > lists_.skin) rebuild_lists();
        built_ = true;
        const double radius = kernel_.radius();
        const Crowding<D> crowding{particles_, 1 / radius, kernel_.slope_factor(), kernel_.value(0), gradient_, sum_};
        loop_(particles_.blocks(), [&](std::size_t block) {
            const LaneRange lanes = lanes_of_block(particles_, block);
            pair_loop(lists_, lanes, crowding);
            for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
                const Vec<D> x = at(i);
                for (const int k : pieces_near_[i]) {
                    const auto& [place, area] = pieces_[std::size_t(k)];
                    const Vec<D> to = place - x;
                    const double r = std::max(to.norm(), 1e-6 * spacing_);
                    if (r >= radius) continue;
                    sum_[i] += kernel_beyond<D>(r, radius) * area.dot(to) / (D == 2 ? r * r : r * r * r);
                    gradient_[i] += kernel_.value(r) * area;
                }
            }
        });
        double total = 0, squares = 0;
        for (std::size_t i = 0; i < particles_.count; ++i) total += sum_[i];
        mean_ = total / double(particles_.count);
        for (std::size_t i = 0; i < particles_.count; ++i) squares += (sum_[i] - mean_) * (sum_[i] - mean_);
        deviation_ = std::sqrt(squares / double(particles_.count));
    }

    void move() {
        loop_(particles_.blocks(), [&](std::size_t block) {
            const LaneRange lanes = lanes_of_block(particles_, block);
            for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
                Vec<D> step = -push * spacing_ * spacing_ * gradient_[i];
                const double length = step.norm(), most = longest_move * spacing_;
                if (length > most) step *= most / length;
                put(i, kept_inside(at(i) + step));
            }
        });
    }

    Vec<D> kept_inside(Vec<D> x) const {
        const double least = least_depth * spacing_;
        const bool is_inside = inside_(x);
        const auto nearest = tree_.nearest(x, is_inside ? least : std::numeric_limits<double>::infinity());
        if (nearest.facet >= 0) {
            const Vec<D> inwards = -outwards_ * nearest.normal.normalized();
            x = nearest.place + least * inwards;
        }
        if (region_.level) x[D - 1] = std::min(x[D - 1], *region_.level - least);
        return x;
    }

    const Region<D>& region_;
    double spacing_;
    WendlandC2<D> kernel_;
    geometry::FacetTree<D> tree_;
    geometry::InsideTest<D> inside_;
    BlockLoop loop_;
    double outwards_ = 1;
    std::vector<Piece> pieces_;
    std::vector<std::vector<int>> pieces_near_;
    Particles<D> particles_;
    NeighbourLists<D> lists_;
    NeighbourSearch<D> search_;
    SpatialOrder<D> order_;
    Reorder<D> reorder_;
    bool built_ = false;
    std::vector<Vec<D>> gradient_, best_;
    std::vector<double> sum_;
    double deviation_ = 0, mean_ = 0, best_deviation_ = 0, best_mean_ = 0;
};

}  // namespace

template <int D>
RelaxationResult relax(Places<D>& places, const Region<D>& region, double spacing, double support, double tolerance,
                       BlockLoop loop) {
    if (places.x.empty()) return {};
    Relaxation<D> relaxation(places, region, spacing, support, loop);
    const RelaxationResult result = relaxation.run(tolerance);
    places.x = relaxation.places();
    return result;
}

template RelaxationResult relax(Places<2>&, const Region<2>&, double, double, double, BlockLoop);
template RelaxationResult relax(Places<3>&, const Region<3>&, double, double, double, BlockLoop);

}  // namespace aquagraph::fluid
