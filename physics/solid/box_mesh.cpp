#include "physics/solid/elements/serendipity.hpp"
#include "physics/solid/mesh.hpp"

namespace aquagraph::solid {

namespace {

// Points of the grid of half the elements' spacing; of those only the corners and mid-sides of elements carry a node.
template <int D>
class HalfGrid {
  public:
    HalfGrid(const std::array<int, D>& elements) {
        std::size_t total = 1;
        for (std::size_t d = 0; d < D; ++d) total *= std::size_t(points_[d] = 2 * elements[d] + 1);
        number_.assign(total, -1);
    }
    NodeIndex& operator[](const std::array<int, D>& at) {
        std::size_t place = 0;
        for (std::size_t d = 0; d < D; ++d) place = place * std::size_t(points_[d]) + std::size_t(at[d]);
        return number_[place];
    }
    int points(std::size_t d) const { return points_[d]; }

  private:
    std::array<int, D> points_{};
    std::vector<NodeIndex> number_;
};

// Calls f(index) for all indices below `counts`, the last direction running fastest: nodes of one cross-section stay
// together, and a long body along x has a narrow matrix.
template <int D, class F>
void for_all(const std::array<int, D>& counts, const F& f) {
    std::array<int, D> at{};
    for (;;) {
        f(at);
        int d = D - 1;
        while (d >= 0 && ++at[std::size_t(d)] == counts[std::size_t(d)]) at[std::size_t(d--)] = 0;
        if (d < 0) return;
    }
}

template <int D>
Mesh<D> make_box(const std::array<double, D>& min, const std::array<double, D>& max, const std::array<int, D>& elements,
                 const std::array<std::array<const char*, 2>, D>& names) {
    for (std::size_t d = 0; d < D; ++d) {
        if (!(max[d] > min[d])) throw std::invalid_argument("the box of the solid is empty");
        if (elements[d] < 1) throw std::invalid_argument("the box of the solid needs at least one element each way");
    }
    Mesh<D> mesh;
    HalfGrid<D> grid(elements);
    std::array<int, D> points;
    for (std::size_t d = 0; d < D; ++d) points[d] = grid.points(d);
    for_all<D>(points, [&](const std::array<int, D>& at) {
        int odd = 0;
        for (const int i : at) odd += i % 2;
        if (odd > 1) return;
        NodeIndex& node = grid[at];
        node = NodeIndex(mesh.nodes.size());
        auto& x = mesh.nodes.emplace_back();
        for (std::size_t d = 0; d < D; ++d) {
            x[d] = min[d] + double(at[d]) / (points[d] - 1) * (max[d] - min[d]);
            if (at[d] == 0) mesh.node_sets[names[d][0]].push_back(node);
            if (at[d] == points[d] - 1) mesh.node_sets[names[d][1]].push_back(node);
        }
    });
    for_all<D>(elements, [&](const std::array<int, D>& cell) {
        Element& element = mesh.elements.emplace_back();
        for (const auto& parent : Serendipity<D>::parent_nodes) {
            std::array<int, D> at;
            for (std::size_t d = 0; d < D; ++d) at[d] = 2 * cell[d] + 1 + int(parent[d]);
            element.push_back(grid[at]);
        }
    });
    const auto on = [&](const Facet& facet, std::size_t d, double plane) {
        for (const NodeIndex node : facet)
            if (mesh.nodes[std::size_t(node)][d] != plane) return false;
        return true;
    };
    for (const Facet& facet : boundary_facets(mesh))
        for (std::size_t d = 0; d < D; ++d) {
            if (on(facet, d, min[d])) mesh.surfaces[names[d][0]].push_back(facet);
            if (on(facet, d, mesh.nodes[std::size_t(mesh.node_sets[names[d][1]][0])][d]))
                mesh.surfaces[names[d][1]].push_back(facet);
        }
    if constexpr (D == 2)
        for (auto& [name, edges] : mesh.surfaces) edges = chain(edges);
    return mesh;
}

}  // namespace

Mesh<2> box_mesh(std::array<double, 2> min, std::array<double, 2> max, int columns, int rows) {
    return make_box<2>(min, max, {columns, rows}, {{{"left", "right"}, {"bottom", "top"}}});
}

Mesh<3> box_mesh(std::array<double, 3> min, std::array<double, 3> max, std::array<int, 3> elements) {
    return make_box<3>(min, max, elements, {{{"left", "right"}, {"front", "back"}, {"bottom", "top"}}});
}

template <int D>
Mesh<D> without_mid_side_nodes(const Mesh<D>& quadratic) {
    constexpr std::size_t corners = D == 2 ? 4 : 8;
    Mesh<D> mesh;
    std::vector<NodeIndex> number(quadratic.nodes.size(), -1);
    for (const Element& element : quadratic.elements) {
        if (element.size() != (D == 2 ? 8 : 20) && element.size() != corners)
            throw std::invalid_argument("only quadrilaterals and hexahedra can be made linear");
        for (std::size_t a = 0; a < corners; ++a) number[std::size_t(element[a])] = 0;
    }
    for (std::size_t a = 0; a < number.size(); ++a)
        if (number[a] == 0) {
            number[a] = NodeIndex(mesh.nodes.size());
            mesh.nodes.push_back(quadratic.nodes[a]);
        }
    for (const Element& element : quadratic.elements) {
        Element& made = mesh.elements.emplace_back();
        for (std::size_t a = 0; a < corners; ++a) made.push_back(number[std::size_t(element[a])]);
    }
    for (const auto& [name, set] : quadratic.node_sets)
        for (const NodeIndex node : set)
            if (number[std::size_t(node)] >= 0) mesh.node_sets[name].push_back(number[std::size_t(node)]);
    mesh.element_sets = quadratic.element_sets;
    for (const auto& [name, facets] : quadratic.surfaces)
        for (const Facet& facet : facets) {
            Facet& made = mesh.surfaces[name].emplace_back();
            for (std::size_t k = 0; k < corner_count<D>(facet); ++k) made.push_back(number[std::size_t(facet[k])]);
        }
    return mesh;
}

template Mesh<2> without_mid_side_nodes(const Mesh<2>&);
template Mesh<3> without_mid_side_nodes(const Mesh<3>&);

}  // namespace aquagraph::solid
