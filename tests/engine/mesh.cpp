// A body read from a Gmsh file is the body of the same box.
#include <doctest/doctest.h>

#include <sstream>

#include "engine/model.hpp"
#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// The gate of `gate`, 1 × 10 quadrilaterals of four nodes, as Gmsh 4.1 writes it; the whole of it is called "rubber".
std::string gate_mesh() {
    constexpr int columns = 1, rows = 10;
    const auto node = [](int i, int j) { return j * (columns + 1) + i + 1; };
    std::ostringstream mesh;
    mesh.precision(17);
    mesh << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
            "$PhysicalNames\n5\n2 5 \"rubber\"\n1 1 \"left\"\n1 2 \"bottom\"\n1 3 \"right\"\n1 4 "
            "\"top\"\n$EndPhysicalNames\n"
            "$Entities\n0 4 1 0\n";
    for (int side = 1; side <= 4; ++side) mesh << side << " 0.1 0 0 0.105 0.079 0 1 " << side << " 0\n";
    const int nodes = (columns + 1) * (rows + 1);
    mesh << "1 0.1 0 0 0.105 0.079 0 1 5 4 1 2 3 4\n$EndEntities\n$Nodes\n1 " << nodes << " 1 " << nodes << "\n2 1 0 "
         << nodes << "\n";
    for (int n = 1; n <= nodes; ++n) mesh << n << "\n";
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) mesh << 0.1 + 0.005 * i / columns << " " << 0.079 * j / rows << " 0\n";
    constexpr int elements = 2 * rows + 2 * columns + rows * columns;
    mesh << "$EndNodes\n$Elements\n5 " << elements << " 1 " << elements << "\n";
    int tag = 0;
    const auto line = [&](int a, int b) { mesh << ++tag << " " << a << " " << b << "\n"; };
    mesh << "1 1 1 " << rows << "\n";
    for (int j = 0; j < rows; ++j) line(node(0, j), node(0, j + 1));
    mesh << "1 2 1 " << columns << "\n";
    for (int i = 0; i < columns; ++i) line(node(i, 0), node(i + 1, 0));
    mesh << "1 3 1 " << rows << "\n";
    for (int j = 0; j < rows; ++j) line(node(columns, j), node(columns, j + 1));
    mesh << "1 4 1 " << columns << "\n";
    for (int i = 0; i < columns; ++i) line(node(i, rows), node(i + 1, rows));
    mesh << "2 1 3 " << rows * columns << "\n";
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            mesh << ++tag << " " << node(i, j) << " " << node(i + 1, j) << " " << node(i + 1, j + 1) << " "
                 << node(i, j + 1) << "\n";
    mesh << "$EndElements\n";
    return mesh.str();
}

std::string with_mesh() {
    const std::string box = "[solid.box]\nmin = [0.1, 0.0]\nmax = [0.105, 0.079]\nelements = [1, 10]\n";
    return with(with(gate, box, ""), "name = \"gate\"\n", "name = \"gate\"\nmesh = \"gate.msh\"\n");
}

// One quadrilateral of eight nodes where the gate's box is, twice as wide; its left edge bulges by this much.
std::string bulging_mesh(double bulge) {
    const double top = 0.079, middle = 0.0395;
    std::ostringstream mesh;
    mesh.precision(17);
    mesh << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
            "$PhysicalNames\n5\n1 1 \"left\"\n1 2 \"bottom\"\n1 3 \"right\"\n1 4 \"top\"\n2 5 "
            "\"rubber\"\n$EndPhysicalNames\n"
            "$Nodes\n8\n";
    const double x[][2] = {{0.1, 0},   {0.11, 0},      {0.11, top},  {0.1, top},
                           {0.105, 0}, {0.11, middle}, {0.105, top}, {0.1 - bulge, middle}};
    for (int n = 0; n < 8; ++n) mesh << n + 1 << " " << x[n][0] << " " << x[n][1] << " 0\n";
    mesh << "$EndNodes\n$Elements\n5\n"
            "1 8 2 1 1 4 1 8\n2 8 2 2 2 1 2 5\n3 8 2 3 3 2 3 6\n4 8 2 4 4 3 4 7\n"
            "5 16 2 5 5 1 2 3 4 5 6 7 8\n$EndElements\n";
    return mesh.str();
}

}  // namespace

TEST_CASE("a gate from a mesh file moves as the gate of a box") {
    Finished from_box(gate);
    ScratchFolder folder;
    folder.write("gate.msh", gate_mesh());
    engine::RunOptions options;
    options.folder = folder / "results";
    options.quiet = true;
    std::ostringstream out, err;
    REQUIRE(engine::run(io::read_scene(folder.write("scene.toml", with_mesh())), options, out, err) == engine::success);
    const io::History a = from_box.results.history(), b = io::read_history(options.folder / "history.csv");
    REQUIRE(a.rows() == b.rows());
    // Nodes are numbered otherwise, so sums are rounded otherwise.
    for (std::size_t k = 0; k < a.rows(); ++k)
        CHECK(a.column("tip_x")[k] == doctest::Approx(b.column("tip_x")[k]).epsilon(1e-6));
    CHECK(a.column("tip_x").back() > 1e-3);
}

TEST_CASE("a mesh without the wet surface is refused with its place in the scene") {
    ScratchFolder folder;
    folder.write("gate.msh", gate_mesh());
    engine::RunOptions options;
    options.folder = folder / "results";
    std::ostringstream out, err;
    const io::Scene scene = io::read_scene(
        folder.write("scene.toml", with(with_mesh(), "[\"left\", \"bottom\"", "[\"lefft\", \"bottom\"")));
    CHECK_THROWS_WITH_AS(engine::run(scene, options, out, err), doctest::Contains("no surface 'lefft'"),
                         io::SceneError);
    CHECK_FALSE(std::filesystem::exists(options.folder));
}

TEST_CASE("a wet set that is no surface is refused with its place in the scene") {
    ScratchFolder folder;
    folder.write("gate.msh", gate_mesh());
    std::ostringstream out, err;
    const std::string text = with(with_mesh(), "\"bottom\", \"right\"]", "\"bottom\", \"rubber\"]");
    const io::Scene scene = io::read_scene(folder.write("scene.toml", text));
    const std::string said = refusal_by([&] { engine::make_model<2>(scene); });
    const std::size_t line = count(text.substr(0, text.find("\"rubber\"")), "\n") + 1;
    CHECK(said.find("scene.toml:" + std::to_string(line) + ":") != std::string::npos);
    CHECK(said.find("'rubber' is a set of nodes, and no surface") != std::string::npos);
    CHECK(said.find("bottom, left, right, top") != std::string::npos);
}

TEST_CASE("a body that no water can reach is refused with its place in the scene") {
    ScratchFolder folder;
    folder.write("gate.msh", gate_mesh());
    const auto said = [&](const std::string& text) {
        const io::Scene scene = io::read_scene(folder.write("scene.toml", text));
        return refusal_by([&] { engine::make_model<2>(scene); });
    };
    const std::string away =
        with(gate, "min = [0.1, 0.0]\nmax = [0.105, 0.079]", "min = [0.7, 0.0]\nmax = [0.705, 0.079]");
    const std::string box = said(away);
    CHECK(box.find("scene.toml:" + std::to_string(count(away.substr(0, away.find("[solid.box]")), "\n") + 1) + ":") !=
          std::string::npos);
    CHECK(box.find("no water will ever reach them") != std::string::npos);
    CHECK(box.find("enlarge [domain]") != std::string::npos);
    // The gate of the mesh, and a domain that ends before it.
    const std::string narrow =
        with(with(with_mesh(), "max = [0.5, 0.3]", "max = [0.07, 0.3]"), "max = [0.1, 0.14]", "max = [0.06, 0.14]");
    CHECK(said(narrow).find("no water will ever reach them") != std::string::npos);
    // Near enough to be reached, it is taken.
    CHECK(said(with(gate, "max = [0.5, 0.3]", "max = [0.101, 0.3]")) == "");
}

TEST_CASE("water inside a curved side of a body is refused, and water that ends before it is taken") {
    const auto said = [&](double bulge, const char* water) {
        ScratchFolder folder;
        folder.write("gate.msh", bulging_mesh(bulge));
        const std::string text = with(with_mesh(), "max = [0.1, 0.14]", std::string("max = [") + water + ", 0.14]");
        const io::Scene scene = io::read_scene(folder.write("scene.toml", text));
        return refusal_by([&] { engine::make_model<2>(scene); });
    };
    // Particles stand 2.5 and 7.5 mm before the chord of the corners.
    CHECK(said(0, "0.1") == "");
    CHECK(said(0.004, "0.1").find("there is water inside the solid") != std::string::npos);
    CHECK(said(0.002, "0.1") == "");
    CHECK(said(0.007, "0.095") == "");
    CHECK(said(0.008, "0.095").find("there is water inside the solid") != std::string::npos);
}
