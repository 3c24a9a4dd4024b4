#include "physics/solid/assembly.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "physics/solid/constraints.hpp"
#include "physics/solid/elements/dispatch.hpp"
#include "physics/solid/surface_facets.hpp"

namespace aquagraph::solid {

namespace {

// Work per block: above 100 000 cycles, so that handing a block to a thread costs little beside it. Element work is
// counted in nodes² of elements.
constexpr std::size_t force_work_per_block = 16384, matrix_work_per_block = 4096, nodes_per_block = 2048,
                      columns_per_block = 1024;
constexpr std::uint32_t no_mass = std::numeric_limits<std::uint32_t>::max();

// Calls body(first, last) for the ranges of [0, count).
template <class Body>
void in_blocks(std::size_t count, std::size_t size, BlockLoop loop, const Body& body) {
    const std::size_t blocks = (count + size - 1) / size;
    if (blocks == 1) return body(std::size_t{0}, count);
    loop(blocks, [&](std::size_t block) { body(block * size, std::min(count, (block + 1) * size)); });
}

// Lists of what `visit(add)` adds by add(row, entry); each keeps the order in which its entries come. visit is called
// twice: to count, and to fill.
template <class Visit>
Lists make_lists(std::size_t rows, const Visit& visit) {
    Lists lists;
    lists.starts.assign(rows + 1, 0);
    visit([&](std::size_t row, std::size_t) { ++lists.starts[row + 1]; });
    std::partial_sum(lists.starts.begin(), lists.starts.end(), lists.starts.begin());
    lists.entries.resize(lists.starts.back());
    std::vector<std::size_t> next(lists.starts.begin(), lists.starts.end() - 1);
    visit([&](std::size_t row, std::size_t entry) {
        if (entry >= no_mass) throw std::length_error("the mesh of the solid is too large");
        lists.entries[next[row]++] = static_cast<std::uint32_t>(entry);
    });
    return lists;
}

template <int D, class Nodes>
std::size_t freedom(const Nodes& element, std::size_t local) {
    return D * static_cast<std::size_t>(element[local / D]) + local % D;
}

}  // namespace

template <int D>
template <class Body>
void Assembly<D>::for_packs(std::size_t work_per_block, BlockLoop loop, const Body& body) const {
    for (const Part& part : parts_) {
        const std::size_t nodes = part.elements->node_count();
        in_blocks(part.elements->packs(), std::max(std::size_t{1}, work_per_block / (nodes * nodes * lanes)), loop,
                  [&](std::size_t first, std::size_t last) { body(part, first, last); });
    }
}

template <int D>
template <class Visit>
void Assembly<D>::for_facets(const Visit& visit) const {
    std::size_t start = first_facet_matrix_;
    for (const Facet& facet : facets_) {
        visit(facet, start);
        start += packed_index(D * facet.size(), 0);
    }
}

template <int D>
Assembly<D>::Assembly(const Mesh<D>& mesh, const Options<D>& options) {
    make_groups(mesh, options);
    number_equations(mesh, options);
    list_node_elements(mesh);
    NodeGraph graph;
    {
        std::vector<int> near;
        std::vector<std::vector<int>> elements_of(mesh.nodes.size());
        for (std::size_t e = 0; e < mesh.elements.size(); ++e)
            for (const NodeIndex a : mesh.elements[e]) elements_of[std::size_t(a)].push_back(int(e));
        graph.starts.push_back(0);
        for (const auto& list : elements_of) {
            near.clear();
            for (const int e : list)
                near.insert(near.end(), mesh.elements[std::size_t(e)].begin(), mesh.elements[std::size_t(e)].end());
            std::sort(near.begin(), near.end());
            near.erase(std::unique(near.begin(), near.end()), near.end());
            graph.neighbours.insert(graph.neighbours.end(), near.begin(), near.end());
            graph.starts.push_back(graph.neighbours.size());
        }
    }
    build_mass(mesh, options, graph);
    build_pattern(mesh, graph);
    stiffness_diagonal_.assign(equations(), 0.0);
    material_of_ = {};
}

// One group per material and type of element, in the order of their first elements.
template <int D>
void Assembly<D>::make_groups(const Mesh<D>& mesh, const Options<D>& options) {
    material_of_.assign(mesh.elements.size(), &options.material);
    for (const auto& part : options.parts)
        for (const ElementIndex e : mesh.element_set(part.set)) material_of_[std::size_t(e)] = &part.material;
    std::vector<std::pair<std::pair<const Material*, std::size_t>, std::vector<ElementIndex>>> groups;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const std::pair kind{material_of_[e], mesh.elements[e].size()};
        auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == kind; });
        if (group == groups.end()) group = groups.insert(groups.end(), {kind, {}});
        group->second.push_back(static_cast<ElementIndex>(e));
    }
    std::size_t forces = 0, matrices = 0;
    for (auto& [kind, members] : groups) {
        Part& part = parts_.emplace_back();
        part.elements = make_element_group(mesh, std::move(members), *kind.first, options);
        if (options.stiffness_damping > 0)
            part.viscous = make_viscous_group(mesh, *part.elements, *kind.first, options);
        part.first_force = forces;
        part.first_matrix = matrices;
        part.first_pack = packs_;
        const auto& elements = part.elements->members();
        for (std::size_t p = 0; p < part.elements->packs(); ++p)
            for (std::size_t a = 0; a < part.elements->node_count(); ++a)
                for (std::size_t l = 0; l < lanes; ++l)
                    part.connectivity.push_back(
                        mesh.elements[std::size_t(elements[std::min(p * lanes + l, elements.size() - 1)])][a]);
        packs_ += part.elements->packs();
        forces += part.elements->packs() * part.elements->force_size();
        matrices += part.elements->packs() * part.elements->matrix_size();
    }
    element_forces_.resize(forces);
    first_facet_matrix_ = matrices;
    facets_ = stiff_facets(mesh, options);
    for (const Facet& facet : facets_) matrices += packed_index(D * facet.size(), 0);
    element_matrices_.resize(matrices);
    smallest_J_.resize(packs_);
}

template <int D>
void Assembly<D>::number_equations(const Mesh<D>& mesh, const Options<D>& options) {
    const std::vector<bool> held = held_freedoms(mesh, options);
    equation_of_.resize(held.size());
    for (std::size_t f = 0; f < equation_of_.size(); ++f) {
        equation_of_[f] = held[f] ? -1 : static_cast<int>(freedoms_.size());
        if (!held[f]) freedoms_.push_back(f);
    }
}

template <int D>
void Assembly<D>::list_node_elements(const Mesh<D>& mesh) {
    node_elements_ = make_lists(mesh.nodes.size(), [&](const auto& add) {
        for (const Part& part : parts_)
            for (std::size_t m = 0; m < part.elements->members().size(); ++m) {
                const Element& element = mesh.elements[std::size_t(part.elements->members()[m])];
                for (std::size_t a = 0; a < element.size(); ++a)
                    add(std::size_t(element[a]),
                        part.first_force + (m / lanes) * part.elements->force_size() + a * D * lanes + m % lanes);
            }
    });
}

// M_ab = ∫ ρ N_a N_b dV, the same for all directions.
template <int D>
void Assembly<D>::build_mass(const Mesh<D>& mesh, const Options<D>& options, const NodeGraph& graph) {
    gravity_forces_.assign(D * mesh.nodes.size(), 0.0);
    lumped_masses_.assign(mesh.nodes.size(), 0.0);
    mass_starts_ = graph.starts;
    mass_columns_ = graph.neighbours;
    mass_values_.assign(mass_columns_.size(), 0.0);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const Element& element = mesh.elements[e];
        const double density = material_of_[e]->density * (D == 2 ? options.thickness : 1);
        with_element_type<D>(element.size(), [&]<class Type>(Type) {
            const auto X = coordinates<Type>(mesh, element);
            std::array<double, Type::node_count> diagonal{};
            double element_mass = 0;
            for (const auto& point : Type::mass_rule()) {
                const auto s = Type::shape(point.xi);
                const double dm = density * point.weight * reference_gradients(s, X).jacobian;
                mass_ += dm;
                element_mass += dm;
                for (std::size_t a = 0; a < Type::node_count; ++a) diagonal[a] += dm * s.N[a] * s.N[a];
                for (std::size_t a = 0; a < Type::node_count; ++a) {
                    const auto row = static_cast<std::size_t>(element[a]);
                    for (std::size_t i = 0; i < D; ++i)
                        gravity_forces_[D * row + i] += dm * s.N[a] * options.gravity[i];
                    for (std::size_t b = 0; b < Type::node_count; ++b) {
                        const auto first = mass_columns_.begin() + std::ptrdiff_t(mass_starts_[row]),
                                   last = mass_columns_.begin() + std::ptrdiff_t(mass_starts_[row + 1]);
                        const auto place = std::lower_bound(first, last, element[b]) - mass_columns_.begin();
                        mass_values_[std::size_t(place)] += dm * s.N[a] * s.N[b];
                    }
                }
            }
            const double trace = std::accumulate(diagonal.begin(), diagonal.end(), 0.0);
            for (std::size_t a = 0; a < Type::node_count; ++a)
                lumped_masses_[std::size_t(element[a])] += element_mass * diagonal[a] / trace;
        });
    }
}

template <int D>
void Assembly<D>::build_pattern(const Mesh<D>& mesh, const NodeGraph& graph) {
    // Columns of the lower triangle: freedoms of nodes that share an element, in ascending order of equations (which
    // follow the nodes).
    column_starts_.push_back(0);
    for (const std::size_t f : freedoms_) {
        const int column = equation_of_[f];
        for (std::size_t k = graph.starts[f / D]; k < graph.starts[f / D + 1]; ++k)
            for (std::size_t i = 0; i < D; ++i) {
                const int row = equation_of_[D * std::size_t(graph.neighbours[k]) + i];
                if (row < column) continue;
                rows_.push_back(row);
                mass_of_nonzero_.push_back(i == f % D ? static_cast<std::uint32_t>(k) : no_mass);
            }
        if (rows_.size() > std::size_t(std::numeric_limits<int>::max()))
            throw std::length_error("the mesh of the solid is too large");
        column_starts_.push_back(static_cast<int>(rows_.size()));
    }
    // Where each entry of each element matrix goes; looked up once, since the lists are made in two passes.
    std::vector<std::uint32_t> nonzero_of;
    const auto list_nonzeros = [&](const auto& element) {
        for (std::size_t p = 0; p < D * element.size(); ++p)
            for (std::size_t q = 0; q <= p; ++q) {
                const auto [column, row] =
                    std::minmax(equation_of_[freedom<D>(element, p)], equation_of_[freedom<D>(element, q)]);
                if (column < 0) {
                    nonzero_of.push_back(no_mass);
                    continue;
                }
                const auto first = rows_.begin() + column_starts_[static_cast<std::size_t>(column)],
                           last = rows_.begin() + column_starts_[static_cast<std::size_t>(column) + 1];
                nonzero_of.push_back(static_cast<std::uint32_t>(std::lower_bound(first, last, row) - rows_.begin()));
            }
    };
    for (const Part& part : parts_)
        for (const ElementIndex e : part.elements->members()) list_nonzeros(mesh.elements[std::size_t(e)]);
    for (const Facet& facet : facets_) list_nonzeros(facet);
    stiffness_entries_ = make_lists(rows_.size(), [&](const auto& add) {
        auto nonzero = nonzero_of.begin();
        for (const Part& part : parts_)
            for (std::size_t m = 0; m < part.elements->members().size(); ++m) {
                const std::size_t start = part.first_matrix + (m / lanes) * part.elements->matrix_size() + m % lanes;
                for (std::size_t k = 0; k < part.elements->matrix_size() / lanes; ++k, ++nonzero)
                    if (*nonzero != no_mass) add(*nonzero, start + k * lanes);
            }
        for_facets([&](const Facet& facet, std::size_t start) {
            for (std::size_t k = 0; k < packed_index(D * facet.size(), 0); ++k, ++nonzero)
                if (*nonzero != no_mass) add(*nonzero, start + k);
        });
    });
}

template <int D>
void Assembly<D>::sum_at_nodes(std::span<double> forces, BlockLoop loop) const {
    in_blocks(nodes(), nodes_per_block, loop, [&](std::size_t first, std::size_t last) {
        for (std::size_t a = first; a < last; ++a) {
            double f[D] = {};
            for (std::size_t k = node_elements_.starts[a]; k < node_elements_.starts[a + 1]; ++k)
                for (std::size_t i = 0; i < D; ++i) f[i] += element_forces_[node_elements_.entries[k] + i * lanes];
            for (std::size_t i = 0; i < D; ++i) forces[D * a + i] = f[i];
        }
    });
}

template <int D>
double Assembly<D>::internal_forces(std::span<const double> u, std::span<double> forces, BlockLoop loop) {
    for_packs(force_work_per_block, loop, [&](const Part& part, std::size_t first, std::size_t last) {
        part.elements->internal_forces(u, first, last, std::span(element_forces_).subspan(part.first_force),
                                       std::span(smallest_J_).subspan(part.first_pack));
    });
    sum_at_nodes(forces, loop);
    return *std::min_element(smallest_J_.begin(), smallest_J_.end());
}

template <int D>
void Assembly<D>::viscous_forces(std::span<const double> u, std::span<const double> v, std::span<double> forces,
                                 BlockLoop loop) {
    for_packs(force_work_per_block, loop, [&](const Part& part, std::size_t first, std::size_t last) {
        part.viscous->forces(u, v, first, last, std::span(element_forces_).subspan(part.first_force));
    });
    sum_at_nodes(forces, loop);
}

template <int D>
void Assembly<D>::multiply_mass(std::span<const double> x, std::span<double> y, BlockLoop loop) const {
    in_blocks(nodes(), nodes_per_block, loop, [&](std::size_t first, std::size_t last) {
        for (std::size_t a = first; a < last; ++a) {
            double sum[D] = {};
            for (std::size_t k = mass_starts_[a]; k < mass_starts_[a + 1]; ++k)
                for (std::size_t i = 0; i < D; ++i)
                    sum[i] += mass_values_[k] * x[D * std::size_t(mass_columns_[k]) + i];
            for (std::size_t i = 0; i < D; ++i) y[D * a + i] = sum[i];
        }
    });
}

template <int D>
void Assembly<D>::system_matrix(std::span<const double> u, double stiffness_factor, double mass_factor,
                                std::span<double> values, BlockLoop loop, double rate_factor) {
    for_packs(matrix_work_per_block, loop, [&](const Part& part, std::size_t first, std::size_t last) {
        const std::span<double> matrices = std::span(element_matrices_).subspan(part.first_matrix);
        part.elements->tangents(u, first, last, matrices);
        if (part.viscous && rate_factor != 0) part.viscous->add_tangents(u, rate_factor, first, last, matrices);
    });
    in_blocks(equations(), columns_per_block, loop, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c) {
            const auto begin = static_cast<std::size_t>(column_starts_[c]);
            const auto end = static_cast<std::size_t>(column_starts_[c + 1]);
            for (std::size_t n = begin; n < end; ++n) {
                double K = 0;
                for (std::size_t k = stiffness_entries_.starts[n]; k < stiffness_entries_.starts[n + 1]; ++k)
                    K += element_matrices_[stiffness_entries_.entries[k]];
                const std::uint32_t mass = mass_of_nonzero_[n];
                values[n] = stiffness_factor * K + (mass == no_mass ? 0 : mass_factor * mass_values_[mass]);
                if (n == begin) stiffness_diagonal_[c] = K;  // rows are ascending: the diagonal comes first
            }
        }
    });
}

template <int D>
void Assembly<D>::multiply_stiffness(std::span<const double> x, std::span<double> y, BlockLoop loop) {
    for_packs(force_work_per_block, loop, [&](const Part& part, std::size_t first, std::size_t last) {
        constexpr std::size_t most_rows = D == 2 ? 16 : 60;
        const std::size_t nodes = part.elements->node_count(), rows = part.elements->rows();
        for (std::size_t p = first; p < last; ++p) {
            double X[most_rows][lanes], Y[most_rows][lanes] = {};
            for (std::size_t r = 0; r < rows; ++r)
                for (std::size_t l = 0; l < lanes; ++l)
                    X[r][l] = x[D * std::size_t(part.connectivity[(p * nodes + r / D) * lanes + l]) + r % D];
            const double* K = &element_matrices_[part.first_matrix + p * part.elements->matrix_size()];
            for (std::size_t r = 0; r < rows; ++r)
                for (std::size_t c = 0; c <= r; ++c, K += lanes)
                    for (std::size_t l = 0; l < lanes; ++l) {
                        Y[r][l] += K[l] * X[c][l];
                        if (c < r) Y[c][l] += K[l] * X[r][l];
                    }
            std::copy(&Y[0][0], &Y[0][0] + rows * lanes,
                      &element_forces_[part.first_force + p * part.elements->force_size()]);
        }
    });
    sum_at_nodes(y, loop);
    for_facets([&](const Facet& facet, std::size_t start) {
        const double* K = &element_matrices_[start];
        for (std::size_t r = 0; r < D * facet.size(); ++r)
            for (std::size_t c = 0; c <= r; ++c, ++K) {
                const std::size_t row = freedom<D>(facet, r), column = freedom<D>(facet, c);
                y[row] += *K * x[column];
                if (c < r) y[column] += *K * x[row];
            }
    });
}

template <int D>
double Assembly<D>::energy(std::span<const double> u) const {
    std::vector<double> energies(packs_);
    for (const Part& part : parts_)
        part.elements->energies(u, 0, part.elements->packs(), std::span(energies).subspan(part.first_pack));
    return std::accumulate(energies.begin(), energies.end(), 0.0);
}

template <int D>
void Assembly<D>::von_mises(std::span<const double> u, std::span<double> stress) const {
    for (const Part& part : parts_) part.elements->von_mises(u, stress);
}

template class Assembly<2>;
template class Assembly<3>;

}  // namespace aquagraph::solid
