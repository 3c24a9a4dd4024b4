// Checkpoints on the disk: whole or refused; and the archive of their state, which reads what it has written and
// nothing else.
#include "io/checkpoint_file.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <type_traits>
#include <vector>

#include "io/archive.hpp"
#include "io/atomic_file.hpp"
#include "physics/fluid/walls/panels.hpp"
#include "tests/io/scratch.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

enum class Colour { red, green };

struct Inner {
    int number = 0;
    std::string text;
    template <class Archive>
    void archive(Archive& fields) {
        fields(number, text);
    }
    bool operator==(const Inner&) const = default;
};

struct Outer {
    double value = 0;
    bool flag = false;
    Colour colour = Colour::red;
    double force[2] = {0, 0};
    std::vector<double> values;
    std::array<std::vector<float>, 2> arrays;
    std::vector<Inner> parts;
    std::vector<std::vector<int>> lists;
    std::vector<fluid::Vec3> places;
    template <class Archive>
    void archive(Archive& fields) {
        fields(value, flag, colour, force, values, arrays, parts, lists, places);
    }
};

Outer example() {
    Outer made;
    made.value = 0.1;
    made.flag = true;
    made.colour = Colour::green;
    made.force[1] = -3;
    made.values = {1, 2, 3};
    made.arrays = {std::vector<float>{4}, {}};
    made.parts = {{1, "one"}, {2, ""}};
    made.lists = {{}, {5, 6}};
    made.places = {fluid::Vec3(7, 8, 9)};
    return made;
}

std::string bytes_of(Outer& outer) {
    io::ArchiveWriter fields;
    fields.section("all");
    fields(outer);
    return fields.take();
}

std::string error_of(const std::filesystem::path& file) {
    try {
        io::read_checkpoint(file);
    } catch (const io::CheckpointError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

// It reads the bytes where they are.
static_assert(std::is_constructible_v<io::ArchiveReader, const std::string&> &&
              !std::is_constructible_v<io::ArchiveReader, std::string>);

TEST_CASE("an archive gives back what it was given") {
    Outer written = example(), read;
    const std::string bytes = bytes_of(written);
    io::ArchiveReader fields(bytes);
    fields.section("all");
    fields(read);
    fields.must_be_at_the_end();
    CHECK(bytes_of(read) == bytes);
    CHECK(read.value == 0.1);
    CHECK(read.flag);
    CHECK(read.colour == Colour::green);
    CHECK(read.force[1] == -3);
    CHECK(read.values == written.values);
    CHECK(read.arrays == written.arrays);
    CHECK(read.parts == written.parts);
    CHECK(read.lists == written.lists);
    CHECK(read.places[0] == fluid::Vec3(7, 8, 9));
}

TEST_CASE("bytes between the fields of a struct are the same, whatever was there") {
    struct Gaps {
        char small;
        double large;
        char last;
    };
    static_assert(sizeof(Gaps) > 2 * sizeof(char) + sizeof(double));
    const auto bytes = [](int before) {
        Gaps one;
        std::memset(static_cast<void*>(&one), before, sizeof one);
        one.small = 1;
        one.large = 2;
        one.last = 3;
        std::vector<Gaps> many(2);
        std::memcpy(static_cast<void*>(&many[1]), &one, sizeof one);
        io::ArchiveWriter fields;
        fields(one, many);
        return fields.take();
    };
    CHECK(bytes(0x55) == bytes(0xAA));
    const std::string written = bytes(0x55);
    Gaps one{};
    std::vector<Gaps> many;
    io::ArchiveReader fields(written);
    fields(one, many);
    REQUIRE(many.size() == 2);
    for (const Gaps& read : {one, many[1]}) {
        CHECK(read.small == 1);
        CHECK(read.large == 2);
        CHECK(read.last == 3);
    }
}

TEST_CASE("an archive of other fields is refused by the name of its part") {
    Outer written = example();
    const std::string bytes = bytes_of(written);
    const auto refused = [&](auto& field, const std::string& section) {
        io::ArchiveReader fields(bytes);
        CHECK_THROWS_WITH_AS((fields.section(section), fields(field)), doctest::Contains(section.c_str()),
                             io::ArchiveError);
    };
    Outer other;
    refused(other, "none");
    float narrow = 0;
    refused(narrow, "all");
    std::vector<double> values;
    refused(values, "all");
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        io::ArchiveReader fields(std::string_view(bytes).substr(0, length));
        CHECK_THROWS_AS((fields.section("all"), fields(other)), io::ArchiveError);
    }
    io::ArchiveReader more(bytes);
    more.section("all");
    CHECK_THROWS_AS(more.must_be_at_the_end(), io::ArchiveError);
}

TEST_CASE("a checkpoint with any byte changed, or cut off anywhere, is refused") {
    const ScratchFolder folder;
    const auto file = folder / "checkpoint";
    std::string state = "the state, of a length that is no multiple of eight";
    io::write_checkpoint(file, {{"version", "1"}}, state);
    const io::CheckpointFile read = io::read_checkpoint(file);
    CHECK(read.state == state);
    CHECK(read.about.at("version") == "1");
    CHECK_FALSE(std::filesystem::exists(io::temporary_name(file)));

    const std::string whole = io::read_file(file);
    for (std::size_t place = 0; place < whole.size(); ++place) {
        CAPTURE(place);
        for (const int bit : {0, 3, 7}) {
            std::string changed = whole;
            changed[place] = char(changed[place] ^ (1 << bit));
            CHECK(error_of(folder.write("changed", changed)) != "");
        }
        CHECK(error_of(folder.write("cut", whole.substr(0, place))).find("cut") != std::string::npos);
    }
    CHECK(error_of(folder.write("longer", whole + "x")) != "");
    CHECK(error_of(folder.write("foreign", "time[s],tip_x[m]\n0,0\n")).find("no checkpoint of aquagraph") !=
          std::string::npos);
    std::string newer = whole;
    newer[newer.find('\n') + 1] = char(io::checkpoint_format + 1);
    CHECK_THROWS_WITH_AS(io::read_checkpoint(folder.write("newer", newer)), doctest::Contains("format 2"),
                         io::OtherFormat);
    CHECK_THROWS_AS(io::read_checkpoint(folder / "none"), std::system_error);
}

TEST_CASE("a checkpoint that cannot be written leaves the last one as it is") {
    const ScratchFolder folder;
    const auto file = folder / "checkpoint";
    io::write_checkpoint(file, {{"version", "1"}}, "good");
    if (std::filesystem::exists("/dev/full")) {
        std::filesystem::create_symlink("/dev/full", io::temporary_name(file));
        CHECK_THROWS_WITH_AS(io::write_checkpoint(file, {}, std::string(100000, 'x')),
                             doctest::Contains("No space left"), std::system_error);
        CHECK_FALSE(std::filesystem::is_symlink(io::temporary_name(file)));
    }
    std::filesystem::create_directory(io::temporary_name(file));
    CHECK_THROWS_WITH_AS(io::write_checkpoint(file, {}, "x"), doctest::Contains("checkpoint cannot be written"),
                         std::system_error);
    CHECK(io::read_checkpoint(file).state == "good");
}
