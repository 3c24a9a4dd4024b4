#include "physics/solid/assembly.hpp"

#include <algorithm>
#include <numeric>

namespace aquagraph::solid {

namespace {

// Work per block: above 100 000 cycles, so that handing a block to a thread costs little beside it.
constexpr std::size_t packs_per_block = 32, elements_per_block = 64, nodes_per_block = 2048, columns_per_block = 1024;

// Calls body(first, last) for the ranges of [0, count).
template <class Body>
void in_blocks(std::size_t count, std::size_t size, BlockLoop loop, const Body& body) {
    const std::size_t blocks = (count + size - 1) / size;
    if (blocks == 1) return body(std::size_t{0}, count);
    loop(blocks, [&](std::size_t block) { body(block * size, std::min(count, (block + 1) * size)); });
}

// Lists from (row, entry) pairs; each keeps the order in which its pairs come.
Lists make_lists(std::size_t rows, const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    Lists lists;
    lists.starts.assign(rows + 1, 0);
    for (const auto& [row, entry] : pairs) ++lists.starts[row + 1];
    std::partial_sum(lists.starts.begin(), lists.starts.end(), lists.starts.begin());
    lists.entries.resize(pairs.size());
    std::vector<std::size_t> next(lists.starts.begin(), lists.starts.end() - 1);
    for (const auto& [row, entry] : pairs) lists.entries[next[row]++] = entry;
    return lists;
}

std::size_t freedom(const Quad8Nodes& nodes, std::size_t local) {
    return 2 * static_cast<std::size_t>(nodes[local / 2]) + local % 2;
}

}  // namespace

Assembly::Assembly(const Mesh& mesh, const Options& options) : elements_(make_element_group(mesh, options)) {
    number_equations(mesh, options.clamps);
    list_node_elements(mesh);
    build_mass(mesh, options);
    build_pattern(mesh);
    element_forces_.resize(elements_->packs() * pack_forces);
    smallest_J_.resize(elements_->packs());
    element_matrices_.resize(elements_->elements() * packed_size);
    stiffness_diagonal_.assign(equations(), 0.0);
}

void Assembly::number_equations(const Mesh& mesh, const std::vector<Clamp>& clamps) {
    equation_of_.assign(2 * mesh.nodes.size(), 0);
    for (const Clamp& clamp : clamps)
        for (const NodeIndex node : mesh.node_set(clamp.set))
            for (std::size_t i = 0; i < 2; ++i)
                if (clamp.fixed[i]) equation_of_[2 * static_cast<std::size_t>(node) + i] = -1;
    for (std::size_t f = 0; f < equation_of_.size(); ++f) {
        if (equation_of_[f] < 0) continue;
        equation_of_[f] = static_cast<int>(freedoms_.size());
        freedoms_.push_back(f);
    }
}

void Assembly::list_node_elements(const Mesh& mesh) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        for (std::size_t a = 0; a < quad8::node_count; ++a)
            pairs.emplace_back(static_cast<std::size_t>(mesh.elements[e][a]),
                               (e / lanes) * pack_forces + a * 2 * lanes + e % lanes);
    node_elements_ = make_lists(mesh.nodes.size(), pairs);
}

// M_ab = ∫ ρ N_a N_b dV, the same for x and y.
void Assembly::build_mass(const Mesh& mesh, const Options& options) {
    gravity_forces_.assign(2 * mesh.nodes.size(), 0.0);
    element_mass_.resize(mesh.elements.size());
    std::vector<std::vector<std::pair<std::size_t, double>>> rows(mesh.nodes.size());
    const auto add = [&rows](std::size_t row, std::size_t column, double value) {
        for (auto& [other, sum] : rows[row])
            if (other == column) {
                sum += value;
                return;
            }
        rows[row].emplace_back(column, value);
    };
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const auto X = quad8::coordinates(mesh, mesh.elements[e]);
        auto& m = element_mass_[e];
        m.fill(0);
        for (const auto& [xi, eta, weight] : quad8::full_rule) {
            const quad8::Shape s = quad8::shape(xi, eta);
            const double dm = options.density * options.thickness * weight * quad8::reference_gradients(s, X).jacobian;
            mass_ += dm;
            for (std::size_t a = 0; a < quad8::node_count; ++a) {
                const auto node = static_cast<std::size_t>(mesh.elements[e][a]);
                for (std::size_t i = 0; i < 2; ++i) gravity_forces_[2 * node + i] += dm * s.N[a] * options.gravity[i];
                for (std::size_t b = 0; b < quad8::node_count; ++b)
                    m[quad8::node_count * a + b] += dm * s.N[a] * s.N[b];
            }
        }
        for (std::size_t a = 0; a < quad8::node_count; ++a)
            for (std::size_t b = 0; b < quad8::node_count; ++b)
                add(static_cast<std::size_t>(mesh.elements[e][a]), static_cast<std::size_t>(mesh.elements[e][b]),
                    m[quad8::node_count * a + b]);
    }
    mass_columns_.starts.push_back(0);
    for (auto& row : rows) {
        std::sort(row.begin(), row.end());
        for (const auto& [column, value] : row) {
            mass_columns_.entries.push_back(column);
            mass_values_.push_back(value);
        }
        mass_columns_.starts.push_back(mass_columns_.entries.size());
    }
}

void Assembly::build_pattern(const Mesh& mesh) {
    // Columns of the lower triangle: nodes that share an element.
    std::vector<std::vector<int>> columns(equations());
    for (const Quad8Nodes& nodes : mesh.elements)
        for (std::size_t p = 0; p < element_rows; ++p)
            for (std::size_t q = 0; q < element_rows; ++q) {
                const int row = equation_of_[freedom(nodes, p)], column = equation_of_[freedom(nodes, q)];
                if (column >= 0 && row >= column) columns[static_cast<std::size_t>(column)].push_back(row);
            }
    column_starts_.push_back(0);
    for (auto& column : columns) {
        std::sort(column.begin(), column.end());
        column.erase(std::unique(column.begin(), column.end()), column.end());
        rows_.insert(rows_.end(), column.begin(), column.end());
        column_starts_.push_back(static_cast<int>(rows_.size()));
    }
    // Where each entry of each element matrix goes.
    system_mass_.assign(rows_.size(), 0.0);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        for (std::size_t p = 0; p < element_rows; ++p)
            for (std::size_t q = 0; q <= p; ++q) {
                const auto [column, row] =
                    std::minmax(equation_of_[freedom(mesh.elements[e], p)], equation_of_[freedom(mesh.elements[e], q)]);
                if (column < 0) continue;
                const auto first = rows_.begin() + column_starts_[static_cast<std::size_t>(column)],
                           last = rows_.begin() + column_starts_[static_cast<std::size_t>(column) + 1];
                const auto nonzero = static_cast<std::size_t>(std::lower_bound(first, last, row) - rows_.begin());
                pairs.emplace_back(nonzero, e * packed_size + packed_index(p, q));
                if (p % 2 == q % 2) system_mass_[nonzero] += element_mass_[e][quad8::node_count * (p / 2) + q / 2];
            }
    stiffness_entries_ = make_lists(rows_.size(), pairs);
}

double Assembly::internal_forces(std::span<const double> u, std::span<double> forces, BlockLoop loop) {
    in_blocks(elements_->packs(), packs_per_block, loop, [&](std::size_t first, std::size_t last) {
        elements_->internal_forces(u, first, last, element_forces_, smallest_J_);
    });
    in_blocks(nodes(), nodes_per_block, loop, [&](std::size_t first, std::size_t last) {
        for (std::size_t a = first; a < last; ++a) {
            double f_x = 0, f_y = 0;
            for (std::size_t k = node_elements_.starts[a]; k < node_elements_.starts[a + 1]; ++k) {
                f_x += element_forces_[node_elements_.entries[k]];
                f_y += element_forces_[node_elements_.entries[k] + lanes];
            }
            forces[2 * a] = f_x;
            forces[2 * a + 1] = f_y;
        }
    });
    return *std::min_element(smallest_J_.begin(), smallest_J_.end());
}

void Assembly::multiply_mass(std::span<const double> x, std::span<double> y, BlockLoop loop) const {
    in_blocks(nodes(), nodes_per_block, loop, [&](std::size_t first, std::size_t last) {
        for (std::size_t a = first; a < last; ++a) {
            double y_x = 0, y_y = 0;
            for (std::size_t k = mass_columns_.starts[a]; k < mass_columns_.starts[a + 1]; ++k) {
                const std::size_t b = mass_columns_.entries[k];
                y_x += mass_values_[k] * x[2 * b];
                y_y += mass_values_[k] * x[2 * b + 1];
            }
            y[2 * a] = y_x;
            y[2 * a + 1] = y_y;
        }
    });
}

void Assembly::system_matrix(std::span<const double> u, double stiffness_factor, double mass_factor,
                             std::span<double> values, BlockLoop loop) {
    in_blocks(elements_->elements(), elements_per_block, loop,
              [&](std::size_t first, std::size_t last) { elements_->tangents(u, first, last, element_matrices_); });
    in_blocks(equations(), columns_per_block, loop, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c) {
            const auto begin = static_cast<std::size_t>(column_starts_[c]);
            const auto end = static_cast<std::size_t>(column_starts_[c + 1]);
            for (std::size_t n = begin; n < end; ++n) {
                double K = 0;
                for (std::size_t k = stiffness_entries_.starts[n]; k < stiffness_entries_.starts[n + 1]; ++k)
                    K += element_matrices_[stiffness_entries_.entries[k]];
                values[n] = stiffness_factor * K + mass_factor * system_mass_[n];
                if (n == begin) stiffness_diagonal_[c] = K;  // rows are ascending: the diagonal comes first
            }
        }
    });
}

}  // namespace aquagraph::solid
