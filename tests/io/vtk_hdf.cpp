// Frames are read back through the HDF5 library, and by ParaView itself where it is installed.
#include "io/vtk_hdf.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/series.hpp"
#include "scratch.hpp"

using namespace aquagraph;
using test::ScratchFolder;

namespace {

struct Particles {
    std::vector<double> x, y, pressure, vx, vy;
    std::vector<std::int32_t> level;
    explicit Particles(std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
            const double s = static_cast<double>(i);
            x.push_back(0.1 * s);
            y.push_back(-0.5 * s);
            pressure.push_back(1000 + s);
            vx.push_back(s);
            vy.push_back(2 * s);
            level.push_back(static_cast<std::int32_t>(i % 3));
        }
    }
    io::VtkFrame frame() const {
        io::VtkFrame frame;
        frame.x = x;
        frame.y = y;
        frame.time = 0.25;
        frame.point_arrays = {{"pressure", {std::span(pressure)}},
                              {"velocity", {std::span(vx), std::span(vy)}},
                              {"level", {std::span(level)}}};
        return frame;
    }
};

// One eight-node quadrilateral.
struct Quad {
    std::vector<double> x{0, 2, 2, 0, 1, 2, 1, 0}, y{0, 0, 1, 1, 0, 0.5, 1, 0.5}, stress{7};
    std::vector<std::int32_t> nodes{0, 1, 2, 3, 4, 5, 6, 7};
    io::VtkFrame frame() const {
        io::VtkFrame frame;
        frame.x = x;
        frame.y = y;
        frame.cell_type = io::CellType::quadratic_quad;
        frame.connectivity = nodes;
        frame.point_arrays = {{"displacement", {std::span(x), std::span(y)}}};
        frame.cell_arrays = {{"stress", {std::span(stress)}}};
        return frame;
    }
};

std::string output_of(const std::string& command) {
    std::string text;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    char buffer[4096];
    while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe.get())) text.append(buffer, got);
    return text;
}

}  // namespace

TEST_CASE("a frame of particles has VTKHDF's layout") {
    ScratchFolder folder;
    const Particles particles(1000);
    io::write_vtk_hdf(folder / "fluid.hdf", particles.frame());
    CHECK(!std::filesystem::exists(io::temporary_name(folder / "fluid.hdf")));
    const io::Hdf5File file = io::Hdf5File::open(folder / "fluid.hdf");
    CHECK(file.integers_attribute("VTKHDF", "Version") == std::vector<std::int64_t>{1, 0});
    CHECK(file.text_attribute("VTKHDF", "Type") == "UnstructuredGrid");
    CHECK(file.text_attribute_is_fixed_ascii("VTKHDF", "Type"));
    CHECK(file.read<std::int64_t>("VTKHDF/NumberOfPoints") == std::vector<std::int64_t>{1000});
    CHECK(file.read<std::int64_t>("VTKHDF/NumberOfCells") == std::vector<std::int64_t>{1000});
    CHECK(file.read<std::int64_t>("VTKHDF/NumberOfConnectivityIds") == std::vector<std::int64_t>{1000});
    CHECK(file.shape("VTKHDF/Points") == std::vector<std::size_t>{1000, 3});
    CHECK(file.shape("VTKHDF/Offsets") == std::vector<std::size_t>{1001});
    CHECK(file.type_name("VTKHDF/Points") == "float64");
    CHECK(file.type_name("VTKHDF/Types") == "uint8");
    const auto points = file.read<double>("VTKHDF/Points");
    CHECK(points[3 * 999] == particles.x[999]);
    CHECK(points[3 * 999 + 1] == particles.y[999]);
    CHECK(points[3 * 999 + 2] == 0);
    CHECK(file.read<std::int64_t>("VTKHDF/Connectivity")[999] == 999);
    CHECK(file.read<std::uint8_t>("VTKHDF/Types")[0] == 1);
    CHECK(file.members("VTKHDF/PointData") == std::vector<std::string>{"level", "pressure", "velocity"});
    CHECK(file.read<double>("VTKHDF/PointData/pressure") == particles.pressure);
    CHECK(file.shape("VTKHDF/PointData/velocity") == std::vector<std::size_t>{1000, 3});
    CHECK(file.read<double>("VTKHDF/PointData/velocity")[3 * 7 + 1] == 14);
    CHECK(file.type_name("VTKHDF/PointData/level") == "int32");
    CHECK(file.read<double>("VTKHDF/FieldData/TimeValue") == std::vector<double>{0.25});
}

TEST_CASE("single precision is stored as such") {
    ScratchFolder folder;
    const Particles particles(300);
    io::VtkFrame frame = particles.frame();
    frame.precision = io::Precision::float32;
    io::write_vtk_hdf(folder / "fluid.hdf", frame);
    const io::Hdf5File file = io::Hdf5File::open(folder / "fluid.hdf");
    CHECK(file.type_name("VTKHDF/Points") == "float32");
    CHECK(file.type_name("VTKHDF/PointData/pressure") == "float32");
    CHECK(file.read<float>("VTKHDF/PointData/pressure")[299] == 1299.0F);
}

TEST_CASE("a frame of quadratic quadrilaterals") {
    ScratchFolder folder;
    const Quad quad;
    io::write_vtk_hdf(folder / "solid.hdf", quad.frame());
    const io::Hdf5File file = io::Hdf5File::open(folder / "solid.hdf");
    CHECK(file.read<std::int64_t>("VTKHDF/Offsets") == std::vector<std::int64_t>{0, 8});
    CHECK(file.read<std::uint8_t>("VTKHDF/Types") == std::vector<std::uint8_t>{23});
    CHECK(file.read<std::int64_t>("VTKHDF/NumberOfConnectivityIds") == std::vector<std::int64_t>{8});
    CHECK(file.read<double>("VTKHDF/CellData/stress") == quad.stress);
}

TEST_CASE("no particle at all is a frame too") {
    ScratchFolder folder;
    io::write_vtk_hdf(folder / "fluid.hdf", Particles(0).frame());
    const io::Hdf5File file = io::Hdf5File::open(folder / "fluid.hdf");
    CHECK(file.shape("VTKHDF/Points") == std::vector<std::size_t>{0, 3});
    CHECK(file.read<std::int64_t>("VTKHDF/Offsets") == std::vector<std::int64_t>{0});
}

TEST_CASE("frames that do not fit together are refused and leave nothing behind") {
    ScratchFolder folder;
    const Quad quad;
    const std::vector<double> short_one{1};
    const std::vector<std::int32_t> beyond{0, 1, 2, 3, 4, 5, 6, 8};
    io::VtkFrame frame = quad.frame();
    frame.point_arrays.push_back({"short", {std::span(short_one)}});
    CHECK_THROWS_WITH_AS(io::write_vtk_hdf(folder / "a.hdf", frame), "short has 1 entries where 8 are needed",
                         std::invalid_argument);
    frame = quad.frame();
    frame.connectivity = beyond;
    CHECK_THROWS_AS(io::write_vtk_hdf(folder / "a.hdf", frame), std::invalid_argument);
    CHECK(!std::filesystem::exists(folder / "a.hdf"));
    CHECK(!std::filesystem::exists(io::temporary_name(folder / "a.hdf")));
    CHECK_THROWS_WITH_AS(io::write_vtk_hdf(folder / "none/a.hdf", quad.frame()), doctest::Contains("cannot be written"),
                         std::runtime_error);
    CHECK_THROWS_WITH_AS(io::write_vtk_hdf(folder / "none/a.hdf", quad.frame()),
                         doctest::Contains("No such file or directory"), std::runtime_error);
}

TEST_CASE("a full disk is an error") {
    if (!std::filesystem::exists("/dev/full")) return;
    ScratchFolder folder;
    std::filesystem::create_symlink("/dev/full", io::temporary_name(folder / "a.hdf"));
    CHECK_THROWS_WITH_AS(io::write_vtk_hdf(folder / "a.hdf", Particles(5000).frame()),
                         doctest::Contains("No space left"), std::runtime_error);
    CHECK(!std::filesystem::exists(folder / "a.hdf"));
}

TEST_CASE("the series lists all frames with their times") {
    ScratchFolder folder;
    io::FrameSeries series(folder / "fluid.hdf.series");
    series.add(io::frame_name("fluid", 0), 0);
    series.add(io::frame_name("fluid", 1), 0.1);
    const auto list = nlohmann::json::parse(io::read_file(folder / "fluid.hdf.series"));
    CHECK(list["file-series-version"] == "1.0");
    REQUIRE(list["files"].size() == 2);
    CHECK(list["files"][1]["name"] == "fluid_000001.hdf");
    CHECK(list["files"][1]["time"] == 0.1);

    io::FrameSeries resumed = io::FrameSeries::resume(folder / "fluid.hdf.series", 0.05);
    CHECK(resumed.entries().size() == 1);
    resumed.add("fluid_000001.hdf", 0.06);
    CHECK(nlohmann::json::parse(io::read_file(folder / "fluid.hdf.series"))["files"][1]["time"] == 0.06);
    CHECK(io::FrameSeries::resume(folder / "other.hdf.series", 1).entries().empty());
    folder.write("bad.hdf.series", "{");
    CHECK_THROWS_AS(io::FrameSeries::resume(folder / "bad.hdf.series", 1), std::runtime_error);
}

TEST_CASE("ParaView opens a frame and a series") {
    if (std::system("command -v pvpython > /dev/null 2>&1") != 0) {
        MESSAGE("skipped: ParaView (pvpython) is not installed");
        return;
    }
    ScratchFolder folder;
    const Particles particles(1000);
    const Quad quad;
    io::FrameSeries series(folder / "fluid.hdf.series");
    for (const int i : {0, 1}) {
        io::write_vtk_hdf(folder / io::frame_name("fluid", i), particles.frame());
        series.add(io::frame_name("fluid", i), 0.5 * i);
    }
    io::write_vtk_hdf(folder / "solid.hdf", quad.frame());
    const auto paraview = [&](const char* name) {
        return output_of("pvpython " AQUAGRAPH_SOURCE_DIR "/tests/io/paraview_check.py " + (folder / name).string() +
                         " 2>&1");
    };
    const std::string fluid = paraview("fluid.hdf.series");
    CAPTURE(fluid);
    CHECK(fluid.find("times 0.0 0.5") != std::string::npos);
    CHECK(fluid.find("points 1000 cells 1000 type 1\n") != std::string::npos);
    CHECK(fluid.find("point pressure 1 double 1999.0\n") != std::string::npos);
    CHECK(fluid.find("point velocity 3 double 999.0 1998.0 0.0\n") != std::string::npos);
    CHECK(fluid.find("point level 1 int 0.0\n") != std::string::npos);
    const std::string solid = paraview("solid.hdf");
    CAPTURE(solid);
    CHECK(solid.find("points 8 cells 1 type 23\n") != std::string::npos);
    CHECK(solid.find("last point 0.0 0.5 0.0\n") != std::string::npos);
    CHECK(solid.find("cell stress 1 double 7.0\n") != std::string::npos);
}
