// What a scene says arrives in the plain data, defaults included; SCENES.md and STUDIES.md are complete.
#include <doctest/doctest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "io/atomic_file.hpp"
#include "io/scene_keys.hpp"
#include "io/scene_reader.hpp"
#include "io/study_file.hpp"
#include "io/suggestion.hpp"
#include "scratch.hpp"

using namespace aquagraph;

namespace {

const std::filesystem::path benchmarks = std::filesystem::path(AQUAGRAPH_SOURCE_DIR) / "benchmarks";

std::vector<std::string> toml_blocks(const std::string& markdown) {
    std::vector<std::string> blocks;
    const std::string open = "```toml\n";
    for (auto at = markdown.find(open); at != std::string::npos; at = markdown.find(open, at)) {
        at += open.size();
        blocks.push_back(markdown.substr(at, markdown.find("```", at) - at));
    }
    return blocks;
}

}  // namespace

TEST_CASE("the gate arrives as the thesis has it") {
    const io::Scene scene = io::read_scene(benchmarks / "gate_2d/scene_thesis.toml");
    CHECK(scene.name == "gate_2d_scene_thesis");
    CHECK(io::read_scene(benchmarks / "gate_2d/scene.toml").name == "gate_2d");
    CHECK(scene.file.is_absolute());
    CHECK(scene.text == io::read_file(scene.file));
    CHECK(scene.end_time == 0.4);
    CHECK(scene.gravity == io::Point{0, -9.81});
    CHECK(scene.edge == io::DomainEdge::open);
    REQUIRE(scene.fluid);
    CHECK(scene.fluid->spacing == 0.00025);
    CHECK(scene.fluid->sound_speed == 30);
    CHECK(!scene.fluid->surface_level);
    REQUIRE(scene.fluid->boxes.size() == 1);
    CHECK(scene.fluid->boxes[0].max == io::Point{0.1, 0.14});
    REQUIRE(scene.walls.size() == 2);
    CHECK(scene.walls[0].points.size() == 3);
    REQUIRE(scene.solid);
    CHECK(scene.solid->name == "gate");
    CHECK(scene.solid->elements == std::array<int, 3>{4, 40, 0});
    CHECK(scene.solid->material.law == solid::MaterialLaw::neo_hookean);
    CHECK(scene.solid->scheme == solid::Scheme::newmark);
    CHECK(scene.solid->clamps[0].fixed == std::array<bool, 3>{true, true, false});
    CHECK(scene.solid->wet == std::vector<std::string>{"left", "bottom", "right"});
    CHECK(scene.coupling.step_fraction == 0.8);
    REQUIRE(scene.comparisons.size() == 10);
    CHECK(scene.comparisons[0].window == std::array<double, 2>{0, 0.161});
    CHECK(scene.comparisons[1].window == std::array<double, 2>{0, 0.4});
    CHECK(scene.comparisons[0].file.is_absolute());
    CHECK(scene.positions.at("fluid.spacing").line == 17);
}

TEST_CASE("defaults") {
    test::ScratchFolder folder;
    const io::Scene scene = io::read_scene(
        folder.write("tank.toml",
                     "schema_version = 1\n[time]\nend = 2\n[domain]\nmin = [0, 0]\nmax = [1, 1]\n"
                     "[fluid]\nspacing = 0.1\nsound_speed = 10\n[[fluid.box]]\nmin = [0, 0]\nmax = [1, 1]\n"));
    CHECK(scene.title == scene.name);
    CHECK(scene.name.ends_with("_tank"));
    CHECK(scene.gravity == io::Point{0, -9.81});
    CHECK(scene.fluid->density == 1000);
    CHECK(scene.fluid->polytropic_exponent == 7);
    CHECK(scene.fluid->support_ratio == 4);
    CHECK(scene.fluid->cfl == 0.375);
    CHECK(scene.output.frame_interval == 0.02);
    CHECK(scene.output.history_interval == 0);
    CHECK(!scene.solid);
}

TEST_CASE("SCENES.md shows every key that the reader knows, and no other") {
    const std::string manual = io::read_file(benchmarks / "SCENES.md");
    std::size_t documented = 0;
    const std::regex row("\n\\| `([a-z_0-9]+)` \\|");
    for (auto it = std::sregex_iterator(manual.begin(), manual.end(), row); it != std::sregex_iterator(); ++it)
        ++documented;
    CHECK(documented == io::scene_keys().size());
    for (const io::SceneSection& section : io::scene_sections()) {
        CAPTURE(section.name);
        CHECK(manual.find(io::section_markdown(section)) != std::string::npos);
    }
    for (const std::string_view name : io::reserved_names())
        CHECK(manual.find(std::string("`").append(name).append("`")) != std::string::npos);
}

TEST_CASE("STUDIES.md shows every key of a study") {
    const std::string manual = io::read_file(benchmarks / "STUDIES.md");
    for (const io::SceneSection& section : io::study_table().sections) {
        CAPTURE(section.name);
        CHECK(manual.find(io::section_markdown(section, io::study_table())) != std::string::npos);
    }
}

TEST_CASE("the examples of SCENES.md are scenes") {
    const auto blocks = toml_blocks(io::read_file(benchmarks / "SCENES.md"));
    REQUIRE(blocks.size() == 2);
    test::ScratchFolder folder;
    CHECK_NOTHROW(io::read_scene(folder.write("small.toml", blocks[0])));
    CHECK_NOTHROW(io::read_scene(folder.write("plate.toml", blocks[0] + blocks[1])));
}

TEST_CASE("distances between words") {
    CHECK(io::edit_distance("spacing", "spacing") == 0);
    CHECK(io::edit_distance("spacing", "Spacing") == 0);
    CHECK(io::edit_distance("spcaing", "spacing") == 1);
    CHECK(io::edit_distance("", "abc") == 3);
    CHECK(io::edit_distance("kitten", "sitting") == 3);
    const std::vector<std::string> known{"left", "right"};
    CHECK(io::nearest("rigth", known) == "right");
    CHECK(!io::nearest("xyz", known));
}
