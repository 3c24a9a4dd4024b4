// One frame in one HDF5 file that ParaView opens: VTKHDF 1.0, UnstructuredGrid.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace aquagraph::io {

// Numbers are VTK's.
enum class CellType : std::uint8_t {
    vertex = 1,
    line = 3,
    triangle = 5,
    quad = 9,
    hexahedron = 12,
    quadratic_edge = 21,
    quadratic_triangle = 22,
    quadratic_quad = 23,
    quadratic_tetra = 24,
    quadratic_hexahedron = 25
};
int nodes_per_cell(CellType type);

using VtkValues = std::variant<std::span<const double>, std::span<const float>, std::span<const std::int32_t>,
                               std::span<const std::int64_t>, std::span<const std::uint8_t>>;

// A named array, one span per component: {"pressure [Pa]", {p}}, {"velocity [m/s]", {vx, vy}}. Two components are
// written as three, the last zero, as ParaView takes vectors. All components have the same type and length. The spans
// are only read while write_vtk_hdf runs.
struct VtkArray {
    std::string name;
    std::vector<VtkValues> components;
};

enum class Precision { float32, float64 };  // in which doubles are stored

struct VtkFrame {
    std::span<const double> x, y, z;  // [m], one entry per point; z may be empty: 0
    CellType cell_type = CellType::vertex;
    std::span<const std::int32_t>
        connectivity;                    // nodes_per_cell entries per cell; empty with vertex: one cell per point
    std::vector<VtkArray> point_arrays;  // one entry per point
    std::vector<VtkArray> cell_arrays;   // one entry per cell
    double time = 0;                     // [s], kept as field data "TimeValue"
    Precision precision = Precision::float64;
};

// Written under a temporary name, then renamed: a reader never sees half a file. gzip level 1 with shuffle, chunked.
// Throws std::invalid_argument where lengths do not match, std::runtime_error naming the file where writing fails.
void write_vtk_hdf(const std::filesystem::path& file, const VtkFrame& frame);

}  // namespace aquagraph::io
