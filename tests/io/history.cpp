// The history reads back as written, survives a crash and a full disk says so; the comparison is right on known
// functions.
#include "io/history.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/atomic_file.hpp"
#include "io/comparison.hpp"
#include "io/summary.hpp"
#include "scratch.hpp"

using namespace aquagraph;
using test::ScratchFolder;

namespace {
const std::vector<io::HistoryColumn> columns{{"time", "s"}, {"tip_x", "m"}, {"count", ""}};

// Views of what is about to go would be views of nothing.
template <class T>
concept GivesViews = requires(T&& history) {
    std::forward<T>(history).time();
    std::forward<T>(history).column("tip_x");
};
static_assert(GivesViews<io::History&> && GivesViews<const io::History&> && !GivesViews<io::History>);
}  // namespace

TEST_CASE("the history reads back bit by bit") {
    ScratchFolder folder;
    const std::vector<std::vector<double>> rows{
        {0, 0, 1}, {0.1, 1.0 / 3, 2}, {0.2, -std::numeric_limits<double>::denorm_min(), 1e300}};
    {
        io::HistoryWriter writer(folder / "history.csv", columns);
        for (const auto& row : rows) writer.row(row);
        CHECK_THROWS_AS(writer.row(std::vector<double>{1, 2}), std::invalid_argument);
    }
    CHECK(io::read_file(folder / "history.csv")
              .starts_with("time[s],tip_x[m],count[-]\n0,0,1\n0.1,0.3333333333333333,2\n"));
    const io::History history = io::read_history(folder / "history.csv");
    CHECK(history.rows() == 3);
    CHECK(history.columns[1].name == "tip_x");
    CHECK(history.columns[1].unit == "m");
    CHECK(history.columns[2].unit == "");
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t c = 0; c < columns.size(); ++c) CHECK(history.values[c][i] == rows[i][c]);
    CHECK(history.time()[2] == 0.2);
    CHECK_THROWS_WITH_AS(history.column("tip_z"), "the history has no column \"tip_z\"; it has time, tip_x, count",
                         std::out_of_range);
}

TEST_CASE("NaN is written and read") {
    ScratchFolder folder;
    io::HistoryWriter writer(folder / "history.csv", columns);
    writer.row(std::vector<double>{0, std::nan(""), INFINITY});
    writer.flush();
    const io::History history = io::read_history(folder / "history.csv");
    CHECK(std::isnan(history.values[1][0]));
    CHECK(std::isinf(history.values[2][0]));
}

TEST_CASE("a resumed history goes on where the checkpoint was taken") {
    ScratchFolder folder;
    const auto file = folder.write("history.csv", "time[s],tip_x[m],count[-]\n0,0,0\n0.1,1,1\n0.2,2,2\n0.3,3");
    {
        io::HistoryWriter writer = io::HistoryWriter::resume(file, columns, 0.15);
        writer.row(std::vector<double>{0.16, 5, 6});
    }
    CHECK(io::read_file(file) == "time[s],tip_x[m],count[-]\n0,0,0\n0.1,1,1\n0.16,5,6\n");
    CHECK_THROWS_AS(io::HistoryWriter::resume(file, {{"time", "s"}}, 1), std::runtime_error);
    { io::HistoryWriter writer = io::HistoryWriter::resume(folder / "new.csv", columns, 0); }
    CHECK(io::read_history(folder / "new.csv").rows() == 0);
}

TEST_CASE("what is wrong with a history is said") {
    ScratchFolder folder;
    CHECK_THROWS_WITH_AS(io::HistoryWriter(folder / "none/history.csv", columns),
                         doctest::Contains("No such file or directory"), std::system_error);
    CHECK_THROWS_AS(io::read_history(folder / "none.csv"), std::system_error);
    CHECK_THROWS_WITH_AS(io::read_history(folder.write("a.csv", "time[s],a[m]\n0,1\n0\n")),
                         doctest::Contains("a.csv:3: 1 values for 2 columns"), std::runtime_error);
    CHECK_THROWS_WITH_AS(io::read_history(folder.write("b.csv", "time[s]\nx\n")),
                         doctest::Contains("b.csv:2: \"x\" is no number"), std::runtime_error);
    CHECK_THROWS_AS(io::read_history(folder.write("c.csv", "")), std::runtime_error);
    if (!std::filesystem::exists("/dev/full")) return;
    CHECK_THROWS_WITH_AS(io::HistoryWriter("/dev/full", columns), doctest::Contains("No space left"),
                         std::system_error);
}

namespace {

io::History history_of(double (*f)(double), double end, int rows) {
    io::History history{{{"time", "s"}, {"tip_x", "m"}}, {{}, {}}};
    for (int i = 0; i <= rows; ++i) {
        history.values[0].push_back(end * i / rows);
        history.values[1].push_back(f(history.values[0].back()));
    }
    return history;
}

io::Compare compare_to(const std::filesystem::path& file) {
    io::Compare compare;
    compare.column = "tip_x";
    compare.file = file;
    compare.label = "reference";
    compare.window = {0, 1};
    return compare;
}

}  // namespace

TEST_CASE("references come with any separator, words between, in any order") {
    ScratchFolder folder;
    const auto file =
        folder.write("curve.txt", "# time value\nt;v\n2.0, 20\r\n+1.0\t10\n# more\n 0.5 5e0 7\n1.5;15\n \r\n\n");
    io::Compare compare = compare_to(file);
    io::Curve curve = io::read_reference(compare);
    CHECK(curve.time == std::vector<double>{0.5, 1, 1.5, 2});
    CHECK(curve.value == std::vector<double>{5, 10, 15, 20});
    compare.time_scale = 2;
    compare.value_scale = -1;
    compare.value_offset = 3;
    curve = io::read_reference(compare);
    CHECK(curve.time.front() == 1);
    CHECK(curve.value.front() == -2);
}

TEST_CASE("a point of a reference that cannot be read is not passed over") {
    ScratchFolder folder;
    for (const auto& [text, says] :
         {std::pair{"0, 0\n1, two\n2, 4\n", ":2: two numbers are expected, but there stands `1, two`"},
          std::pair{"t, v\n0, 0\n1, nan\n", ":3: two numbers"}, std::pair{"0, 0\n1\n", ":2: two numbers"},
          std::pair{"0, 0\n\ninf 3\n", ":3: two numbers"}, std::pair{"t, v\n", "no line with two numbers"}}) {
        const auto file = folder.write("curve.csv", text);
        CHECK_THROWS_WITH_AS(io::read_reference(compare_to(file)), doctest::Contains(says), std::runtime_error);
    }
}

TEST_CASE("errors against known functions") {
    ScratchFolder folder;
    // Computed: t, exact under linear interpolation. Reference: 1.5 t, so the difference at t is 0.5 t.
    const auto file = folder.write("curve.csv", "0, 0\n0.25, 0.375\n0.5, 0.75\n1.0, 1.5\n1.5, 2.25\n");
    const io::History history = history_of([](double t) { return t; }, 1, 7);
    const io::Comparison all = io::compare_with(compare_to(file), history);
    CHECK(all.points == 4);
    CHECK(all.points_in_window == 4);
    CHECK(all.rms == doctest::Approx(std::sqrt((0.125 * 0.125 + 0.25 * 0.25 + 0.5 * 0.5) / 4)));
    CHECK(all.peak == 1.5);
    CHECK(all.normalised == doctest::Approx(all.rms / 1.5));
    CHECK(all.largest == doctest::Approx(0.5));
    CHECK(all.largest_time == 1);
    CHECK(all.unit == "m");

    io::Compare part = compare_to(file);
    part.window = {0.2, 0.6};
    const io::Comparison within = io::compare_with(part, history);
    CHECK(within.points == 2);
    CHECK(within.largest == doctest::Approx(0.25));

    part.window = {0, 2};
    CHECK(io::compare_with(part, history).points_in_window == 5);
    CHECK(io::compare_with(part, history).points == 4);

    part.window = {3, 4};
    CHECK(std::isnan(io::compare_with(part, history).rms));
    part.column = "tip_q";
    CHECK_THROWS_AS(io::compare_with(part, history), std::out_of_range);
}

TEST_CASE("a curve against itself has no error, a run that blew up has no number") {
    ScratchFolder folder;
    const auto file = folder.write("curve.csv", "0.1, 0.01\n0.4, 0.16\n0.8, 0.64\n");
    const io::History square = history_of([](double t) { return t * t; }, 1, 10);
    CHECK(io::compare_with(compare_to(file), square).rms < 1e-15);
    const io::History broken = history_of([](double t) { return t < 0.5 ? t * t : std::nan(""); }, 1, 10);
    CHECK(std::isnan(io::compare_with(compare_to(file), broken).rms));
    CHECK(std::isnan(io::compare_with(compare_to(file), broken).largest));
}

TEST_CASE("the summary is written whole") {
    ScratchFolder folder;
    io::Comparison comparison;
    comparison.column = "tip_x";
    comparison.rms = std::nan("");
    io::write_summary(folder / "summary.json", {{"comparisons", {io::to_json(comparison)}}});
    const auto read = nlohmann::json::parse(io::read_file(folder / "summary.json"));
    CHECK(read["comparisons"][0]["column"] == "tip_x");
    CHECK(read["comparisons"][0]["rms"].is_null());
    CHECK_THROWS_AS(io::write_summary(folder / "none/summary.json", {}), std::system_error);
}
