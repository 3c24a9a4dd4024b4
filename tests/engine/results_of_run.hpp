// Runs a scene from beginning to end within the test and reads what it has left.
#pragma once
#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "engine/run.hpp"
#include "io/hdf5_file.hpp"
#include "io/history.hpp"
#include "tests/engine/scenes.hpp"

namespace aquagraph::test {

struct FrameOnDisk {
    std::string name;
    double time;
};

// What lies in a folder of results, however it came there.
struct ResultsFolder {
    std::filesystem::path path;

    io::History history() const { return io::read_history(path / "history.csv"); }
    std::vector<double> column(const std::string& name) const {
        const io::History all = history();
        const std::span<const double> values = all.column(name);
        return {values.begin(), values.end()};
    }
    nlohmann::json summary() const { return nlohmann::json::parse(contents(path / "summary.json")); }
    std::string report() const { return contents(path / "report.html"); }
    std::vector<FrameOnDisk> frames(const std::string& stem) const {
        std::vector<FrameOnDisk> list;
        const auto series = nlohmann::json::parse(contents(path / (stem + ".hdf.series")));
        for (const auto& entry : series.at("files")) list.push_back({entry.at("name"), entry.at("time")});
        return list;
    }
    io::Hdf5File open(const FrameOnDisk& frame) const { return io::Hdf5File::open(path / frame.name); }
    std::size_t frames_on_disk(const std::string& stem) const {
        std::size_t found = 0;
        for (const auto& entry : std::filesystem::directory_iterator(path)) {
            const std::string name = entry.path().filename().string();
            found += name.starts_with(stem + "_") && name.ends_with(".hdf");
        }
        return found;
    }
};

// The numbers of a frame, bit by bit: HDF5 may put times of writing beside them.
inline std::string numbers_of(const io::Hdf5File& file, std::vector<std::string> datasets) {
    std::string bits;
    for (const std::string& name : datasets) {
        const std::string type = file.type_name(name);
        const auto append = [&](const auto& values) {
            bits.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
        };
        if (type == "int64")
            append(file.read<std::int64_t>(name));
        else if (type == "float32")
            append(file.read<float>(name));
        else
            append(file.read<double>(name));
    }
    return bits;
}

// Files that lie beside a scene: name and content.
using FilesBeside = std::vector<std::pair<std::string, std::string>>;

struct Finished {
    ScratchFolder scratch;
    ResultsFolder results;
    engine::ExitCode code;
    std::ostringstream out, err;

    explicit Finished(const std::string& text, int threads = 2, const FilesBeside& files = {}) {
        for (const auto& [name, content] : files) scratch.write(name, content);
        const io::Scene scene = io::read_scene(scratch.write("scene.toml", text));
        results.path = scratch / "results";
        code = engine::run(scene, {.folder = results.path, .trace = {}, .threads = threads, .quiet = true}, out, err);
    }
};

// The bits of a run's history, on so many threads.
inline std::string history_text(const std::string& text, int threads) {
    return contents(Finished(text, threads).results.path / "history.csv");
}

}  // namespace aquagraph::test
