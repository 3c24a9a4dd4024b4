// What is read out of a trace, against one whose numbers are known.
#include "engine/trace_summary.hpp"

#include <doctest/doctest.h>

#include <sstream>
#include <stdexcept>

#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

struct Event {
    std::string name;
    int thread;
    double begin, end;  // [ms]
    bool block = false;
};

std::string trace_of(const std::vector<Event>& events) {
    std::ostringstream text;
    text << "{\"displayTimeUnit\":\"ms\",\"otherData\":{\"dropped_events\":7},\"traceEvents\":[\n"
         << R"({"name":"process_name","ph":"M","pid":1,"tid":0,"args":{"name":"aquagraph"}})";
    for (const int thread : {0, 1})
        text << ",\n{\"name\":\"thread_name\",\"ph\":\"M\",\"pid\":1,\"tid\":" << thread << ",\"args\":{\"name\":\""
             << (thread == 0 ? "main" : "worker 1") << "\"}}";
    for (const Event& e : events)
        text << ",\n{\"name\":\"" << e.name << "\",\"cat\":\"" << (e.block ? "block" : "any")
             << "\",\"ph\":\"X\",\"pid\":1,\"tid\":" << e.thread << ",\"ts\":" << 1000 * e.begin
             << ",\"dur\":" << 1000 * (e.end - e.begin) << ",\"args\":{\"run\":0}}";
    text << "\n]}\n";
    return text.str();
}

}  // namespace

TEST_CASE("overlap, idle time and the bound of a cycle are those of the trace") {
    // An exchange ends at 1 ms. From there: fluxes on both threads, 1 to 7 ms, in blocks; the solve beside them on
    // thread 1, 3 to 6 ms; loads 7 to 8 ms, exchange 8 to 8.5 ms.
    const std::vector<Event> events{
        {"exchange", 0, 0.5, 1},
        {"fluxes (stage 1)", 0, 1, 7},          // 0.5 ms by itself, blocks 1.5 to 5 ms, then waits to 7 ms
        {"fluxes (stage 1)", 0, 1.5, 5, true},  //
        {"fluxes (stage 1)", 1, 1.5, 3, true},  // the solve comes between: the block after it ends late
        {"FE Newton solve", 1, 3, 6},
        {"fluxes (stage 1)", 1, 6, 7, true},
        {"interface loads", 1, 7, 8},
        {"exchange", 0, 8, 8.5}};
    const ScratchFolder folder;
    const engine::TraceSummary s = engine::summarise_trace(folder.write("trace.json", trace_of(events)));
    CHECK(s.cycles == 1);
    CHECK(s.dropped == 7);
    CHECK(s.wall == Approx(7.5e-3));
    CHECK(s.solid == Approx(3e-3));
    CHECK(s.hidden == Approx(3e-3));  // thread 0 is busy from 3 to 6 ms
    REQUIRE(s.threads.size() == 2);
    CHECK(s.threads[0].name == "main");
    // Between 5 and 6 ms no block of the fluxes runs: the fluxes' own thread is counted as busy with its own part.
    CHECK(s.threads[0].busy == Approx(0.5e-3 + 3.5e-3 + 1e-3 + 0.5e-3));
    CHECK(s.threads[0].waiting == Approx(1e-3));  // 6 to 7 ms
    CHECK(s.threads[0].idle == Approx(1e-3));     // 7 to 8 ms
    CHECK(s.threads[1].busy == Approx(1.5e-3 + 3e-3 + 1e-3 + 1e-3));
    CHECK(s.threads[1].idle == Approx(1e-3));  // 1 to 1.5 ms and during the exchange
    CHECK(s.work == Approx(5.5e-3 + 6.5e-3));
    CHECK(s.side_by_side);
    // Own parts and longest blocks: fluxes 1.5 + 3.5 ms, loads 1 ms, exchange 0.5 ms; beside it the solve's 3 ms.
    CHECK(s.fluid_chain == Approx(6.5e-3));
    CHECK(s.solve_chain == Approx(3e-3));
    CHECK(s.critical_path() == Approx(6.5e-3));
    CHECK(s.bound() == Approx(6.5e-3));
    std::ostringstream said;
    engine::print(s, said);
    CHECK(said.str().find("1 cycles of 7.5 ms") != std::string::npos);
    CHECK(said.str().find("100.0 % of it hidden") != std::string::npos);
    CHECK(said.str().find("the cycle takes 1.154 times that") != std::string::npos);
}

TEST_CASE("one after the other, both chains add up") {
    const std::vector<Event> events{
        {"exchange", 0, 0, 1}, {"interface loads", 0, 1, 3}, {"FE Newton solve", 0, 3, 5}, {"exchange", 0, 5, 6}};
    const ScratchFolder folder;
    const engine::TraceSummary s = engine::summarise_trace(folder.write("trace.json", trace_of(events)));
    CHECK_FALSE(s.side_by_side);
    CHECK(s.hidden == 0);
    CHECK(s.threads.size() == 1);
    CHECK(s.critical_path() == Approx(5e-3));
    CHECK(s.cycle == Approx(5e-3));
}

TEST_CASE("a file that is no trace is refused") {
    const ScratchFolder folder;
    CHECK_THROWS_WITH_AS(engine::summarise_trace(folder.write("a.json", "{}\n")), doctest::Contains("run --trace"),
                         std::runtime_error);
    CHECK_THROWS_AS(engine::summarise_trace(folder.write("b.json", "{\"traceEvents\":[\n{\"name\":3}\n]}\n")),
                    std::runtime_error);
    CHECK_THROWS_AS(engine::summarise_trace(folder / "nothing.json"), std::system_error);
}

TEST_CASE("the trace of a run is summarised") {
    const ScratchFolder folder;
    const io::Scene scene = io::read_scene(folder.write("scene.toml", gate));
    std::ostringstream out, err;
    REQUIRE(engine::run(scene, {.folder = folder / "results", .trace = folder / "trace.json", .threads = 2}, out,
                        err) == engine::success);
    const engine::TraceSummary s = engine::summarise_trace(folder / "trace.json");
    CHECK(s.cycles > 50);
    CHECK(s.solid > 0);
    CHECK(s.hidden <= s.solid);
    CHECK(s.bound() > 0);
    CHECK(s.cycle >= s.bound() * (1 - 1e-9));
    for (const auto& thread : s.threads)
        CHECK(thread.busy + thread.waiting + thread.idle == Approx(s.wall).epsilon(1e-9));
    CHECK(out.str().find("hidden behind the fluid") != std::string::npos);
}
