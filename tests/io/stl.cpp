// STL files, ASCII and binary: the same triangles; everything wrong is said with its line or triangle.
#include "io/stl.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <bit>
#include <string>

#include "physics/geometry/shapes.hpp"
#include "physics/geometry/surface_defects.hpp"
#include "scratch.hpp"
#include "stl_writer.hpp"

using namespace aquagraph;
using geometry::Vec;
using test::ascii_stl;
using test::binary_stl;

namespace {

geometry::Surface<3> brick() {
    return geometry::box<3>(Vec<3>(0, 0, 0), Vec<3>(1, 2, 0.5), geometry::FluidSide::outside);
}

std::string replaced(std::string text, std::string_view old, std::string_view by) {
    const auto at = text.find(old);
    REQUIRE(at != std::string::npos);
    return text.replace(at, old.size(), by);
}

void refused(const std::string& content, const char* message) {
    CHECK_THROWS_WITH_AS(io::parse_stl(content), doctest::Contains(message), io::StlError);
}

}  // namespace

TEST_CASE("ASCII and binary files give the triangles that were written") {
    const auto written = brick();
    for (const std::string& content : {ascii_stl(written), binary_stl(written, "a header"),
                                       binary_stl(written, "solid, says the header of a binary file")}) {
        auto read = io::parse_stl(content);
        REQUIRE(read.facets.size() == 12);
        REQUIRE(read.vertices.size() == 36);
        for (std::size_t f = 0; f < 12; ++f)
            for (std::size_t k = 0; k < 3; ++k) CHECK(read.vertex(f, k) == written.vertex(f, k));
        geometry::weld(read, 1e-6);
        CHECK(read.vertices.size() == 8);
        CHECK(geometry::find_defects(read, true).empty());
        CHECK(geometry::enclosed_volume(read) == doctest::Approx(1));
    }
    test::ScratchFolder folder;
    CHECK(io::read_stl(folder.write("brick.stl", ascii_stl(written))).facets.size() == 12);
    CHECK_THROWS_AS(io::read_stl(folder / "none.stl"), std::system_error);
}

TEST_CASE("capital letters, two bodies in one file, Windows line ends") {
    std::string text = ascii_stl(brick());
    text += text;
    std::string other;
    for (const char c : text) {
        if (c == '\n') other += '\r';
        other += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    CHECK(io::parse_stl(other).facets.size() == 24);
}

TEST_CASE("files that are no STL") {
    refused("", "not an STL file");
    refused("hello", "not an STL file");
    refused(std::string(200, 'x'), "neither ASCII");
    refused("solid nothing\nendsolid nothing\n", "no triangle");
    const std::string text = ascii_stl(brick());
    refused(text.substr(0, text.size() / 2), "the file ends");
    refused(replaced(text, "endsolid body", ""), "the file ends without `endsolid`");
    refused(replaced(text, "vertex 0 0 0", "vertex 0 zero 0"), "line 4: a number is expected, but there stands `zero`");
    refused(replaced(text, "vertex 0 0 0", "vertex 0 nan 0"), "line 4: a number is expected");
    refused(replaced(text, "outer loop", "loop"), "line 3: `outer` is expected, but there stands `loop`");
    refused(replaced(text, "normal -1 0 0", "normal 1 0 0"), "line 2: the stated normal (1, 0, 0) looks the other way");
    const std::string bytes = binary_stl(brick(), "");
    refused(bytes.substr(0, bytes.size() - 7), "684 bytes, but there are 677");
    std::string wild = bytes;
    for (int k = 0; k < 4; ++k) wild[84 + 50 + 12 + static_cast<std::size_t>(k)] = char(0xff);
    refused(wild, "triangle 2 has a coordinate that is not a number");
    CHECK(io::parse_stl(replaced(text, "normal -1 0 0", "normal 0 0 0")).facets.size() == 12);
}
