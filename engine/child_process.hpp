// A program run to its end as a child process, so that its crash is not ours.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace aquagraph::engine {

struct ChildEnd {
    int code = 0;            // exit code
    int signal = 0;          // that ended it; 0: none
    bool timed_out = false;  // ended by us after the limit
    double cpu_seconds = 0;  // of all its threads
};

struct ChildPlace {
    std::filesystem::path folder;  // in which it is started; empty: this one's
    bool own_group = false;        // a Ctrl-C at the terminal reaches us alone
};

// A program without a slash in its name is looked for in PATH. Its output goes to the file `said`. `stop` is asked
// every few milliseconds: once true, the child gets SIGTERM and is waited for. Throws std::system_error where it cannot
// be started.
ChildEnd run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const std::filesystem::path& said, double time_limit, const std::function<bool()>& stop,
                   const ChildPlace& place = {});

}  // namespace aquagraph::engine
