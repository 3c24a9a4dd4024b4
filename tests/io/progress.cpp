// The progress line is neither too frequent nor silent.
#include "io/progress.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

using namespace aquagraph;

namespace {
struct Setting {
    std::ostringstream out;
    double now = 0;
    io::Progress::Clock clock() {
        return [this] { return std::chrono::duration<double>(now); };
    }
    long count(char c) const {
        const std::string text = out.str();
        return std::count(text.begin(), text.end(), c);
    }
};
}  // namespace

TEST_CASE("on a terminal the line is rewritten at most five times a second") {
    Setting setting;
    io::Progress progress(setting.out, true, 1.0, 0, setting.clock());
    for (int i = 1; i <= 1000; ++i) {
        setting.now = 0.01 * i;
        progress.update({0.001 * i, i, 1e-4, "sound speed"});
    }
    CHECK(setting.count('\r') <= 51);
    CHECK(setting.count('\r') >= 45);
    CHECK(setting.count('\n') == 0);
    progress.finish();
    CHECK(setting.count('\n') == 1);
    CHECK(setting.out.str().find("\rt = 1 s of 1 (100 %), step 1000, Δt = 0.0001 s (sound speed), took 10 s") !=
          std::string::npos);
}

TEST_CASE("a shorter line wipes the longer one before it") {
    Setting setting;
    io::Progress progress(setting.out, true, 1.0, 0, setting.clock());
    progress.update({0.25, 1, 1e-4, "a long word for it"});
    setting.now = 1;
    progress.update({0.5, 2, 1e-4, "short"});
    const std::string text = setting.out.str();
    const auto first = text.find('\r', 1);
    REQUIRE(first != std::string::npos);
    CHECK(text.size() - first == first);
}

TEST_CASE("elsewhere a plain line is written at most every ten seconds, and at the end") {
    Setting setting;
    io::Progress progress(setting.out, false, 1.0, 0, setting.clock());
    for (int i = 1; i <= 350; ++i) {
        setting.now = 0.1 * i;
        progress.update({0.002 * i, i, 1e-4, "solid"});
    }
    CHECK(setting.count('\n') == 3);
    CHECK(setting.count('\r') == 0);
    progress.finish();
    CHECK(setting.count('\n') == 4);
    CHECK(setting.out.str().find("t = 0.2 s of 1 (20 %), step 100, Δt = 0.0001 s (solid), 40 s left\n") !=
          std::string::npos);
    CHECK(setting.out.str().ends_with("t = 0.7 s of 1 (70 %), step 350, Δt = 0.0001 s (solid), 15 s left\n"));
}

TEST_CASE("a resumed run estimates from where it started") {
    Setting setting;
    io::Progress progress(setting.out, true, 1.0, 0.5, setting.clock());
    setting.now = 60;
    progress.update({0.75, 10, 1e-4, ""});
    CHECK(setting.out.str().find("(50 %), step 10, Δt = 0.0001 s, 1:00 min left") != std::string::npos);
}

TEST_CASE("nothing happened, nothing is said") {
    Setting setting;
    io::Progress progress(setting.out, false, 1.0, 0, setting.clock());
    progress.finish();
    CHECK(setting.out.str().empty());
}
