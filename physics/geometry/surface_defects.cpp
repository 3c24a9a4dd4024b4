#include "physics/geometry/surface_defects.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "physics/geometry/facet_tree.hpp"

namespace aquagraph::geometry {

namespace {

constexpr double thinnest = 1e-10;  // height over length of a facet that still counts

// A facet's side k with its vertices in ascending order, and whether the facet runs through it in that order.
template <int D>
struct Side {
    std::array<int, D - 1> vertices;
    bool ascending;
};
Side<2> side(const Surface<2>& s, std::size_t f, std::size_t k) {
    return {{s.facets[f][k]}, k == 0};
}
Side<3> side(const Surface<3>& s, std::size_t f, std::size_t k) {
    const int a = s.facets[f][k], b = s.facets[f][(k + 1) % 3];
    return {{std::min(a, b), std::max(a, b)}, a < b};
}

template <int D>
Vec<D> middle(const Surface<D>& s, const std::array<int, D - 1>& vertices) {
    Vec<D> sum = Vec<D>::Zero();
    for (const int v : vertices) sum += s.vertices[std::size_t(v)];
    return sum / double(D - 1);
}

template <int D>
bool degenerate(const Surface<D>& s, std::size_t f) {
    double longest = 0;
    for (std::size_t k = 0; k < D; ++k) {
        if (s.facets[f][k] == s.facets[f][(k + 1) % D]) return true;
        longest = std::max(longest, (s.vertex(f, k) - s.vertex(f, (k + 1) % D)).norm());
    }
    return !(s.front(f).norm() > thinnest * std::pow(longest, D - 1));
}

bool share_vertex(const auto& a, const auto& b) {
    return std::any_of(a.begin(), a.end(), [&](int v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

// Whether the segment from a to b passes through the inside of a facet; touching does not count.
bool passes(const Surface<2>& s, std::size_t f, const Vec<2>& a, const Vec<2>& b, Vec<2>& place) {
    const Vec<2>&p = s.vertex(f, 0), &q = s.vertex(f, 1);
    const auto cross = [](const Vec<2>& u, const Vec<2>& v) { return u.x() * v.y() - u.y() * v.x(); };
    const double slack = 1e-12 * (q - p).norm() * (b - a).norm();
    const double da = cross(q - p, a - p), db = cross(q - p, b - p), dp = cross(b - a, p - a), dq = cross(b - a, q - a);
    const auto apart = [&](double u, double v) { return (u > slack && v < -slack) || (u < -slack && v > slack); };
    if (!apart(da, db) || !apart(dp, dq)) return false;
    place = a + da / (da - db) * (b - a);
    return true;
}
bool passes(const Surface<3>& s, std::size_t f, const Vec<3>& a, const Vec<3>& b, Vec<3>& place) {
    const Vec<3>&p = s.vertex(f, 0), &q = s.vertex(f, 1), &r = s.vertex(f, 2);
    const Vec<3> n = s.front(f);
    const double slack = 1e-12 * n.norm() * (b - a).norm();
    const double da = n.dot(a - p), db = n.dot(b - p);
    if (!((da > slack && db < -slack) || (da < -slack && db > slack))) return false;
    place = a + da / (da - db) * (b - a);
    const double inside = 1e-9 * n.squaredNorm();
    return n.dot((q - p).cross(place - p)) > inside && n.dot((r - q).cross(place - q)) > inside &&
           n.dot((p - r).cross(place - r)) > inside;
}

template <int D>
void find_crossings(const Surface<D>& s, std::vector<Defect<D>>& defects) {
    const FacetTree<D> tree(s);
    std::vector<int> near;
    for (std::size_t f = 0; f < s.facets.size(); ++f) {
        Vec<D> low = s.vertex(f, 0), high = low;
        for (std::size_t k = 1; k < D; ++k) {
            low = low.cwiseMin(s.vertex(f, k));
            high = high.cwiseMax(s.vertex(f, k));
        }
        near.clear();
        tree.in_box(low, high, near);
        std::sort(near.begin(), near.end());
        for (const int g : near) {
            if (std::size_t(g) == f || share_vertex(s.facets[f], s.facets[std::size_t(g)])) continue;
            if (D == 2 && std::size_t(g) < f) continue;  // seen from g already
            Vec<D> place;
            bool crossing = false;
            for (std::size_t k = 0; k < (D == 2 ? 1 : 3) && !crossing; ++k)
                crossing = passes(s, std::size_t(g), s.vertex(f, k), s.vertex(f, (k + 1) % D), place);
            if (crossing) defects.push_back({DefectKind::crossing, f, std::size_t(g), place});
        }
    }
}

}  // namespace

template <int D>
std::vector<Defect<D>> find_defects(const Surface<D>& s, bool closed) {
    std::vector<Defect<D>> defects;
    for (std::size_t f = 0; f < s.facets.size(); ++f)
        for (std::size_t k = 0; k < D; ++k)
            if (!s.vertex(f, k).allFinite()) {
                defects.push_back({DefectKind::not_finite, f, f, s.vertex(f, k)});
                break;
            }
    if (!defects.empty()) return defects;  // no other question has an answer

    for (std::size_t f = 0; f < s.facets.size(); ++f)
        if (degenerate(s, f)) defects.push_back({DefectKind::degenerate, f, f, s.centroid(f)});

    std::map<std::array<int, D>, std::size_t> known;
    std::vector<bool> twin(s.facets.size());
    for (std::size_t f = 0; f < s.facets.size(); ++f) {
        auto vertices = s.facets[f];
        std::sort(vertices.begin(), vertices.end());
        const auto [first, is_new] = known.try_emplace(vertices, f);
        twin[f] = !is_new;
        if (twin[f]) defects.push_back({DefectKind::duplicate, f, first->second, s.centroid(f)});
    }

    struct Use {
        std::size_t facet;
        bool ascending;
    };
    std::map<std::array<int, D - 1>, std::vector<Use>> sides;
    for (std::size_t f = 0; f < s.facets.size(); ++f) {
        if (twin[f]) continue;
        for (std::size_t k = 0; k < D; ++k) {
            const Side<D> of = side(s, f, k);
            sides[of.vertices].push_back({f, of.ascending});
        }
    }
    std::vector<Defect<D>> found;
    for (const auto& [vertices, uses] : sides) {
        const Vec<D> place = middle<D>(s, vertices);
        if (uses.size() == 1 && closed) found.push_back({DefectKind::open_side, uses[0].facet, uses[0].facet, place});
        if (uses.size() > 2) found.push_back({DefectKind::branching, uses[0].facet, uses[2].facet, place});
        if (uses.size() == 2 && uses[0].ascending == uses[1].ascending)
            found.push_back({DefectKind::opposed, uses[0].facet, uses[1].facet, place});
    }
    std::stable_sort(found.begin(), found.end(), [](const Defect<D>& a, const Defect<D>& b) {
        return std::pair(a.kind, a.facet) < std::pair(b.kind, b.facet);
    });
    defects.insert(defects.end(), found.begin(), found.end());
    // Facets without area have no side to pass through.
    if (defects.empty()) find_crossings(s, defects);
    return defects;
}

template <int D>
std::string describe(const Defect<D>& defect) {
    constexpr const char *facet = D == 2 ? "segment" : "triangle", *side = D == 2 ? "an end" : "an edge";
    std::ostringstream text;
    text << facet << " " << defect.facet + 1;
    const auto other = [&] { return std::string(" ") + facet + " " + std::to_string(defect.other + 1); };
    switch (defect.kind) {
        case DefectKind::not_finite:
            text << " has a coordinate that is not a number";
            break;
        case DefectKind::degenerate:
            text << (D == 2 ? " has no length" : " has no area");
            break;
        case DefectKind::duplicate:
            text << " is" << other() << " once more";
            break;
        case DefectKind::open_side:
            text << " has " << side << " that no other " << facet << " shares: the surface is not watertight";
            break;
        case DefectKind::branching:
            text << " has " << side << " that more than two share, among them" << other();
            break;
        case DefectKind::opposed:
            text << " and" << other() << " look at opposite sides of the surface";
            break;
        case DefectKind::crossing:
            text << " cuts through" << other();
            break;
    }
    text << ", at (";
    for (int d = 0; d < D; ++d) text << (d ? ", " : "") << defect.place[d];
    text << ") m";
    return text.str();
}

template std::vector<Defect<2>> find_defects(const Surface<2>&, bool);
template std::vector<Defect<3>> find_defects(const Surface<3>&, bool);
template std::string describe(const Defect<2>&);
template std::string describe(const Defect<3>&);

}  // namespace aquagraph::geometry
