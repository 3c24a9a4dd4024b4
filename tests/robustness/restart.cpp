// The program stopped, killed and started again: it ends in the bits of a run that was left alone. Checkpoints that
// are damaged, of something else, or that cannot be written.
#include <doctest/doctest.h>

#include <csignal>
#include <random>

#include "io/atomic_file.hpp"
#include "io/checkpoint_file.hpp"
#include "tests/engine/session.hpp"
#include "tests/graph/waiting.hpp"
#include "tests/robustness/program.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

const std::vector<std::string> run{"run", "scene.toml", "--out", "results", "--quiet", "--threads", "2"};

std::vector<std::string> run_with(std::vector<std::string> more) {
    more.insert(more.begin(), run.begin(), run.end());
    return more;
}

// A run to its end with a checkpoint after nearly every cycle, and what it has left.
struct WithCheckpoints {
    ScratchFolder folder;
    ResultsFolder results{folder / "results"};
    std::filesystem::path older, newer;
    std::string whole;

    explicit WithCheckpoints(const std::string& text) {
        folder.write("scene.toml", text);
        Program program(folder, run_with({"--checkpoint-every", "1e-5"}));
        REQUIRE(program.wait() == 0);
        older = engine::checkpoint_file(results.path, 0);
        newer = engine::checkpoint_file(results.path, 1);
        const auto steps = [](const std::filesystem::path& file) -> long {
            return io::read_checkpoint(file).about.at("steps");
        };
        if (steps(older) > steps(newer)) std::swap(older, newer);
        whole = results_of(results);
    }
    // Starts again and says how it ended.
    std::string again(std::vector<std::string> more, int code) {
        Program program(folder, run_with(std::move(more)));
        CHECK(program.wait() == code);
        CHECK(program.err().find("terminate") == std::string::npos);
        return program.err();
    }
    void overwrite(const std::filesystem::path& file, const std::string& bytes) {
        std::ofstream(file, std::ios::binary) << bytes;
    }
};

using Refusals = std::vector<std::pair<std::string, std::string>>;  // a checkpoint and what is wrong with it

bool says(const std::string& text, const std::string& what) {
    return text.find(what) != std::string::npos;
}

void check_killed(const std::string& scene, int times) {
    const ScratchFolder folder;
    folder.write("scene.toml", scene);
    Program alone(folder, {"run", "scene.toml", "--out", "whole", "--quiet", "--checkpoint-every", "0"});
    const auto begin = std::chrono::steady_clock::now();
    REQUIRE(alone.wait(std::chrono::seconds(60)) == 0);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;

    const ResultsFolder whole{folder / "whole"}, results{folder / "results"};
    const auto arguments = run_with({"--restart", "auto", "--checkpoint-every", "2e-4"});
    std::mt19937 random(7);
    // All of these together on average get through half of the run.
    std::uniform_real_distribution<double> moment(0.01, took.count() / times + 0.01);
    for (int k = 0; k < times; ++k) {
        Program program(folder, arguments);
        std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
        REQUIRE(program.running());
        program.send(SIGKILL);
        REQUIRE(program.wait() == 128 + SIGKILL);
        CHECK_FALSE(says(program.err(), "passing over"));  // a checkpoint is whole or it is not there
    }
    Program last(folder, arguments);
    REQUIRE(last.wait(std::chrono::seconds(60)) == 0);
    CHECK(says(last.err(), "continuing from"));
    CHECK(results_of(results) == results_of(whole));
    const nlohmann::json a = whole.summary(), b = results.summary();
    for (const char* count : {"steps", "coupling_cycles", "particles", "neighbour_list_rebuilds", "solid"})
        CHECK(a.at(count) == b.at(count));
    for (const char* task : {"fluxes", "FE Newton solve"})
        CHECK(a.at("tasks").at(task).at("calls") == b.at("tasks").at(task).at("calls"));
    CHECK(b.at("restarts") >= 3);
    CHECK(a.at("restarts") == 0);
}

}  // namespace

TEST_CASE("killed twenty times, the run ends in the same bits") {
    check_killed(with(gate, "end = 0.02", "end = 0.16"), 20);
}

TEST_CASE("killed ten times, a run whose cycles are iterated ends in the same bits") {
    check_killed(with(with_coupling(gate, "iterated", 2), "end = 0.02", "end = 0.1"), 10);
}

TEST_CASE("signals leave a checkpoint, and the run goes on from there with the same bits") {
    struct Ending {
        int signal, code;
        const char* says;
    };
    const std::string text = with(gate, "end = 0.02", "end = 0.06");
    const ScratchFolder folder;
    folder.write("scene.toml", text);
    Program alone(folder, {"run", "scene.toml", "--out", "whole", "--quiet"});
    REQUIRE(alone.wait() == 0);
    const std::string whole = results_of({folder / "whole"});
    const ResultsFolder results{folder / "results"};
    for (const Ending& ending : {Ending{SIGUSR1, 4, "stopped at t = "}, Ending{SIGINT, 130, "interrupted at t = "},
                                 Ending{SIGTERM, 130, "interrupted at t = "}}) {
        CAPTURE(ending.signal);
        std::filesystem::remove_all(results.path);
        Program program(folder, run_with({"--checkpoint-every", "0"}));
        REQUIRE(tests::comes_true([&] { return std::filesystem::exists(results.path / "solid_000001.hdf"); }));
        program.send(ending.signal);
        REQUIRE(program.wait() == ending.code);
        CHECK(says(program.err(), ending.says));
        CHECK(says(program.err(), "--restart auto"));
        CHECK(results.summary().at("outcome") == "interrupted");
        CHECK(results_of(results) != whole);
        CHECK(std::filesystem::exists(engine::checkpoint_file(results.path, 0)));
        CHECK_FALSE(std::filesystem::exists(engine::checkpoint_file(results.path, 1)));

        Program second(folder, run_with({"--restart", "auto"}));
        REQUIRE(second.wait() == 0);
        CHECK(results_of(results) == whole);
        CHECK(results.summary().at("restarts") == 1);
        CHECK(results.summary().at("wall_seconds") > 0);
    }
}

TEST_CASE("a damaged checkpoint is passed over or refused") {
    WithCheckpoints made(gate);
    const std::string older = contents(made.older), newer = contents(made.newer);

    made.overwrite(made.newer, newer.substr(0, newer.size() / 2));
    const std::string cut = made.again({"--restart", made.newer.string()}, 2);
    CHECK(says(cut, made.newer.filename().string() + " is cut off"));
    CHECK(says(cut, "go on from results/" + made.older.filename().string()));
    CHECK(results_of(made.results) == made.whole);  // refused: nothing touched
    const std::string passed = made.again({"--restart", "auto"}, 0);
    CHECK(says(passed, "passing over a checkpoint"));
    CHECK(says(passed, made.newer.filename().string() + " is cut off"));
    CHECK(says(passed, "continuing from results/" + made.older.filename().string()));
    CHECK(results_of(made.results) == made.whole);

    std::string damaged = older;
    damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] + 1);
    made.overwrite(made.older, damaged);
    made.overwrite(made.newer, "not a checkpoint at all, but longer than its head is: 0123456789 0123456789\n");
    const std::string none_left = "there is no other in results: start from the beginning, without --restart";
    for (const auto& [file, wrong] :
         Refusals{{made.older.string(), made.older.filename().string() + " is damaged"},
                  {made.newer.string(), made.newer.filename().string() + " is no checkpoint of aquagraph"},
                  {"nowhere.aquagraph", "nowhere.aquagraph cannot be read: No such file"}}) {
        const std::string said = made.again({"--restart", file}, 2);
        CAPTURE(said);
        CHECK(says(said, wrong));
        CHECK(says(said, none_left));
    }
    CHECK(results_of(made.results) == made.whole);
    const std::string none = made.again({"--restart", "auto"}, 0);
    CHECK(says(none, "no good checkpoint in results: starting from the beginning"));
    CHECK(results_of(made.results) == made.whole);
    CHECK(made.results.summary().at("restarts") == 0);
}

TEST_CASE("without a checkpoint the run starts from the beginning") {
    const ScratchFolder folder;
    folder.write("scene.toml", column);
    Program program(folder, run_with({"--restart", "auto"}));
    CHECK(program.wait() == 0);
    CHECK(says(program.err(), "starting from the beginning"));
}

TEST_CASE("a checkpoint of another scene or version is refused with what differs") {
    WithCheckpoints made(gate);
    for (const std::string& from : {std::string("auto"), made.older.string()}) {
        CAPTURE(from);
        const std::string speed = made.again({"--restart", from, "--set", "fluid.sound_speed=31"}, 2);
        CHECK(says(speed, "fluid.sound_speed: 30.0 in the checkpoint, 31.0 now"));
        CHECK(says(speed, "go on with the scene as it was, or start from the beginning"));
        CHECK(says(made.again({"--restart", from, "--set", "coupling.algorithm=css"}, 2),
                   "coupling.algorithm: \"cps\" in the checkpoint, \"css\" now"));
    }
    made.folder.write("scene.toml",
                      gate + "[[probe]]\nname = \"foot\"\nquantity = \"pressure\"\npoint = [0.05, 0.01]\n");
    CHECK(says(made.again({"--restart", "auto"}, 2), "probe[0].name: not there in the checkpoint, \"foot\" now"));
    made.folder.write("scene.toml", gate);

    // Rewritten with a right checksum, as another version would.
    io::CheckpointFile read = io::read_checkpoint(made.older);
    read.about["version"] = "0.0.1";
    io::write_checkpoint(made.folder / "old.aquagraph", read.about, read.state);
    const std::string old = made.again({"--restart", "old.aquagraph"}, 2);
    CHECK(says(old, "old.aquagraph was written by aquagraph 0.0.1"));
    CHECK(says(old, "go on with that version, or start from the beginning, without --restart"));
    // By a program that says other things of its run; and one of another format.
    nlohmann::json few = read.about;
    few.erase("files");
    io::write_checkpoint(made.folder / "few.aquagraph", few, read.state);
    std::string format = contents(made.older);
    format[format.find('\n') + 1] = char(io::checkpoint_format + 1);
    made.overwrite(made.folder / "format.aquagraph", format);
    for (const auto& [file, wrong] : Refusals{{"few.aquagraph", "few.aquagraph does not say its \"files\""},
                                              {"format.aquagraph", "format.aquagraph is a checkpoint of format 2"}}) {
        const std::string said = made.again({"--restart", file}, 2);
        CAPTURE(said);
        CHECK(says(said, wrong));
        CHECK(says(said, "go on with the program that wrote it, or start from the beginning, without --restart"));
    }
    // A state of other fields.
    read = io::read_checkpoint(made.older);
    io::write_checkpoint(made.folder / "short.aquagraph", read.about, read.state.substr(0, read.state.size() / 2));
    const std::string shortened = made.again({"--restart", "short.aquagraph"}, 2);
    CHECK(says(shortened, "short.aquagraph cannot be used: its part '"));
    CHECK(says(shortened, "go on with that program, or start from the beginning, without --restart"));
    // The results of another run.
    Program elsewhere(made.folder, {"run", "scene.toml", "--out", "elsewhere", "--restart", made.older.string()});
    CHECK(elsewhere.wait() == 2);
    CHECK(says(elsewhere.err(), "elsewhere/history.csv has no row of t = "));
    CHECK(says(elsewhere.err(), "restart in the folder of the run"));
    // Its own, but somebody has changed them.
    const std::filesystem::path history = made.results.path / "history.csv";
    const std::string rows = contents(history);
    made.overwrite(history, with(rows, "time[s],", "moment[s],"));
    const std::string others = made.again({"--restart", made.older.string()}, 2);
    CHECK(says(others, "history.csv has other columns than this run writes: restart in the folder of the run"));
    made.overwrite(history, rows);
    const std::filesystem::path list = made.results.path / "fluid.hdf.series";
    const std::string frames = contents(list);
    made.overwrite(list, "{");
    const std::string unlisted = made.again({"--restart", made.older.string()}, 2);
    CHECK(says(unlisted, "fluid.hdf.series is no list of frames"));
    CHECK(says(unlisted, "restart in the folder of the run"));
    made.overwrite(list, frames);
    made.overwrite(history, rows);
    CHECK(results_of(made.results) == made.whole);

    // What may change: the run goes on, further and with other intervals.
    made.again({"--restart", "auto", "--set", "time.end=0.03", "--set", "output.frame_interval=0.001", "--set",
                "output.checkpoint_interval=0", "--set", "title=Longer"},
               0);
    CHECK(made.results.column("time").back() == 0.03);
}

TEST_CASE("a mesh that has changed under its name is seen") {
    const std::string text = with(gate, "max = [0.5, 0.3]\nedge", "max = [0.9, 0.3]\nedge");
    const std::string moved = with(text, "points = [[0.0, 0.2], [0.0, 0.0], [0.6, 0.0]]\n",
                                   "points = [[-0.05, 0.0], [0.6, 0.0]]\n[[wall]]\nname = \"piston\"\npoints = [[0.0, "
                                   "0.2], [0.0, 0.0]]\nmotion = { table = \"motion.csv\" }\n");
    const ScratchFolder folder;
    folder.write("scene.toml", moved);
    folder.write("motion.csv", "time,x\n0,0\n1,0.01\n");
    Program first(folder, run_with({"--checkpoint-every", "1e-5"}));
    REQUIRE(first.wait() == 0);
    folder.write("motion.csv", "time,x\n0,0\n1,0.02\n");
    Program second(folder, run_with({"--restart", "auto"}));
    CHECK(second.wait() == 2);
    CHECK(says(second.err(), "wall[1].motion.table: \"motion.csv, checksum "));
}

TEST_CASE("a disk that fills up ends the run and leaves the last good checkpoint") {
    if (!std::filesystem::exists("/dev/full")) return;
    WithCheckpoints made(gate);
    // What the next one is written as goes nowhere. The run has a cycle left, and gets some more.
    const std::vector<std::string> further{"--set", "time.end=0.03"};
    const auto with_more = [&](std::vector<std::string> more) {
        more.insert(more.end(), further.begin(), further.end());
        return more;
    };
    const std::filesystem::path blocked = io::temporary_name(made.older);
    std::filesystem::create_symlink("/dev/full", blocked);
    const std::string good = contents(made.newer);
    const std::string full = made.again(with_more({"--restart", made.newer.string(), "--checkpoint-every", "1e-9"}), 3);
    CHECK(says(full, made.older.filename().string() + " cannot be written: No space left on device"));
    CHECK(says(full, "is untouched: see that there is room and the right to write, then go on with --restart auto"));
    CHECK(contents(made.newer) == good);
    CHECK(made.results.summary().at("outcome") == "failed");
    CHECK(made.results.column("time").back() < 0.03);
    made.again(with_more({"--restart", "auto"}), 0);  // with room again
    CHECK(made.results.column("time").back() == 0.03);

    // A folder in which nothing can be made: a folder stands where the file is to be.
    WithCheckpoints other(column);
    const std::vector<std::string> longer{"--restart", other.newer.string(), "--checkpoint-every", "1e-9",
                                          "--set",     "time.end=0.11"};
    std::filesystem::create_directory(io::temporary_name(other.older));
    const std::string kept = contents(other.newer);
    CHECK(says(other.again(longer, 3), other.older.filename().string() + " cannot be written: Is a directory"));
    CHECK(contents(other.newer) == kept);
}

TEST_CASE("what --checkpoint-every takes") {
    for (const char* minutes : {"-1", "often"}) {
        const Call call({"run", "SCENE", "--checkpoint-every", minutes}, column);
        CHECK(call.code == 2);
        CHECK(call.left_nothing());
    }
    WithCheckpoints made(with(column, "frame_interval = 0.02", "frame_interval = 0.02\ncheckpoint_interval = 0"));
    std::filesystem::remove_all(made.results.path);
    made.again({}, 0);
    CHECK_FALSE(std::filesystem::exists(made.older));
    CHECK_FALSE(std::filesystem::exists(made.newer));
}
