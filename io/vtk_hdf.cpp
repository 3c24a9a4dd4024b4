// The layout is VTK's "VTKHDF file format", version 1.0, as ParaView 5.10 and later read it.
#include "io/vtk_hdf.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <stdexcept>

#include "io/hdf5_file.hpp"

namespace aquagraph::io {
namespace {

std::size_t length(const VtkValues& values) {
    return std::visit([](const auto& span) { return span.size(); }, values);
}

// One row per entry, the components side by side; two become three, with a zero.
template <class Stored, class T>
void write_interleaved(Hdf5File& file, const std::string& path, const std::vector<std::span<const T>>& components) {
    const std::size_t rows = components.front().size(), given = components.size(), columns = given == 2 ? 3 : given;
    std::vector<Stored> values(rows * columns, Stored{});
    for (std::size_t c = 0; c < given; ++c)
        for (std::size_t i = 0; i < rows; ++i) values[i * columns + c] = static_cast<Stored>(components[c][i]);
    file.dataset<Stored>(path, values, columns == 1 ? 0 : columns);
}

void write_array(Hdf5File& file, const std::string& group, const VtkArray& array, std::size_t rows,
                 Precision precision) {
    if (array.components.empty()) throw std::invalid_argument(fmt::format("the array {} has no component", array.name));
    // A slash would make a group of it.
    if (array.name.empty() || array.name.find('/') != std::string::npos)
        throw std::invalid_argument(fmt::format("\"{}\" cannot name an array", array.name));
    const std::string path = group + "/" + array.name;
    std::visit(
        [&]<class T>(std::span<const T>) {
            std::vector<std::span<const T>> components;
            for (const VtkValues& component : array.components) {
                if (!std::holds_alternative<std::span<const T>>(component))
                    throw std::invalid_argument(fmt::format("the components of {} differ in type", array.name));
                if (length(component) != rows)
                    throw std::invalid_argument(
                        fmt::format("{} has {} entries where {} are needed", array.name, length(component), rows));
                components.push_back(std::get<std::span<const T>>(component));
            }
            if constexpr (std::is_same_v<T, double>) {
                if (precision == Precision::float32) return write_interleaved<float>(file, path, components);
            }
            write_interleaved<T>(file, path, components);
        },
        array.components.front());
}

void write_points(Hdf5File& file, const VtkFrame& frame) {
    const std::size_t n = frame.x.size();
    if (frame.y.size() != n || (!frame.z.empty() && frame.z.size() != n))
        throw std::invalid_argument("the coordinates of a frame differ in length");
    std::vector<std::span<const double>> coordinates{frame.x, frame.y};
    if (!frame.z.empty()) coordinates.push_back(frame.z);
    if (frame.precision == Precision::float32)
        write_interleaved<float>(file, "VTKHDF/Points", coordinates);
    else
        write_interleaved<double>(file, "VTKHDF/Points", coordinates);
}

std::size_t write_cells(Hdf5File& file, const VtkFrame& frame) {
    const std::size_t points = frame.x.size(), nodes = static_cast<std::size_t>(nodes_per_cell(frame.cell_type));
    std::vector<std::int64_t> connectivity(frame.connectivity.begin(), frame.connectivity.end());
    if (connectivity.empty() && frame.cell_type == CellType::vertex) {
        connectivity.resize(points);
        std::iota(connectivity.begin(), connectivity.end(), 0);
    }
    if (connectivity.size() % nodes != 0)
        throw std::invalid_argument(
            fmt::format("{} nodes are no whole number of cells of {}", connectivity.size(), nodes));
    for (const std::int64_t node : connectivity)
        if (node < 0 || static_cast<std::size_t>(node) >= points)
            throw std::invalid_argument(fmt::format("a cell names node {} of {}", node, points));
    const std::size_t cells = connectivity.size() / nodes;
    std::vector<std::int64_t> offsets(cells + 1);
    for (std::size_t i = 0; i <= cells; ++i) offsets[i] = static_cast<std::int64_t>(i * nodes);
    const std::vector<std::uint8_t> types(cells, static_cast<std::uint8_t>(frame.cell_type));

    const auto count = [&](const std::string& name, std::size_t value) {
        const std::int64_t one = static_cast<std::int64_t>(value);
        file.dataset<std::int64_t>("VTKHDF/" + name, std::span(&one, 1));
    };
    count("NumberOfPoints", points);
    count("NumberOfCells", cells);
    count("NumberOfConnectivityIds", connectivity.size());
    file.dataset<std::int64_t>("VTKHDF/Connectivity", connectivity);
    file.dataset<std::int64_t>("VTKHDF/Offsets", offsets);
    file.dataset<std::uint8_t>("VTKHDF/Types", types);
    return cells;
}

void write_content(Hdf5File& file, const VtkFrame& frame) {
    constexpr std::array<std::int64_t, 2> version{1, 0};
    file.group("VTKHDF");
    file.attribute("VTKHDF", "Version", version);
    file.attribute("VTKHDF", "Type", "UnstructuredGrid");
    write_points(file, frame);
    const std::size_t cells = write_cells(file, frame);
    file.group("VTKHDF/PointData");
    for (const VtkArray& array : frame.point_arrays)
        write_array(file, "VTKHDF/PointData", array, frame.x.size(), frame.precision);
    file.group("VTKHDF/CellData");
    for (const VtkArray& array : frame.cell_arrays) write_array(file, "VTKHDF/CellData", array, cells, frame.precision);
    file.group("VTKHDF/FieldData");
    file.dataset<double>("VTKHDF/FieldData/TimeValue", std::span(&frame.time, 1));
}

}  // namespace

int nodes_per_cell(CellType type) {
    switch (type) {
        case CellType::vertex:
            return 1;
        case CellType::line:
            return 2;
        case CellType::triangle:
            return 3;
        case CellType::quad:
            return 4;
        case CellType::hexahedron:
            return 8;
        case CellType::quadratic_edge:
            return 3;
        case CellType::quadratic_triangle:
            return 6;
        case CellType::quadratic_quad:
            return 8;
        case CellType::quadratic_tetra:
            return 10;
        case CellType::quadratic_hexahedron:
            return 20;
    }
    throw std::invalid_argument("no such cell type");
}

void write_vtk_hdf(const std::filesystem::path& file, const VtkFrame& frame) {
    Hdf5File content = Hdf5File::create(file);
    write_content(content, frame);
    content.close();
}

}  // namespace aquagraph::io
