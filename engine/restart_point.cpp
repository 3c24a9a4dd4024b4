#include "engine/restart_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <system_error>
#include <vector>

#include "engine/version.hpp"
#include "io/atomic_file.hpp"
#include "io/checkpoint_file.hpp"
#include "io/scene_json.hpp"
#include "io/scene_solid_files.hpp"

namespace aquagraph::engine {

namespace {

using Json = nlohmann::json;

constexpr std::size_t differences_shown = 8;
// Where nothing can be done about the checkpoint itself.
constexpr const char* afresh = "start from the beginning, without --restart";

// Name and checksum of a file that the scene reads: the name alone would not tell that its content has changed.
Json input_file(const std::filesystem::path& file) {
    return fmt::format("{}, checksum {:016x}", file.filename().string(), io::checksum(io::read_file(file)));
}

Json input_files(const io::Scene& scene) {
    Json files = Json::object();
    if (scene.solid)
        for (const auto& [key, file] : io::files_of(*scene.solid)) files[key] = input_file(file);
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const io::WallScene& wall = scene.walls[w];
        if (wall.stl) files[fmt::format("wall[{}].stl.file", w)] = input_file(wall.stl->file);
        if (wall.motion && !wall.motion->table.empty())
            files[fmt::format("wall[{}].motion.table", w)] = input_file(wall.motion->table);
    }
    if (scene.fluid)
        for (const io::RegionScene& region : scene.fluid->regions)
            if (region.stl) files[region.key + ".stl"] = input_file(region.stl->file);
    return files;
}

// What the computed state depends on.
Json fixed_part(Json scene) {
    for (const char* key : {"title", "compare", "time"}) scene.erase(key);
    for (const char* key : {"frame_interval", "history_interval", "checkpoint_interval"}) scene["output"].erase(key);
    return scene;
}

// "/fluid/box/0/min" -> "fluid.box[0].min"
std::string key_of(const std::string& pointer) {
    std::string key;
    for (std::size_t begin = 1; begin <= pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
        const std::string part = pointer.substr(begin, end - begin);
        const bool number = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
        key += number ? "[" + part + "]" : (key.empty() ? "" : ".") + part;
        begin = end + 1;
    }
    return key;
}

void add_differences(const Json& before, const Json& now, std::vector<std::string>& lines) {
    const Json a = before.flatten(), b = now.flatten();
    const auto word = [](const Json& side, const std::string& pointer) {
        return side.contains(pointer) ? side[pointer].dump() : std::string("not there");
    };
    Json all = a;
    all.update(b);
    for (const auto& [pointer, value] : all.items())
        if (!a.contains(pointer) || !b.contains(pointer) || a[pointer] != b[pointer])
            lines.push_back(
                fmt::format("{}: {} in the checkpoint, {} now", key_of(pointer), word(a, pointer), word(b, pointer)));
}

// Throws if the checkpoint is of another version or of another scene.
void check_fits(const std::filesystem::path& file, const Json& about, const io::Scene& scene) {
    const std::string written_by = about.value("version", "unknown");
    if (written_by != version)
        throw io::CheckpointError(
            fmt::format("{} was written by aquagraph {}, and this is {}: go on with that version, or {}", file.string(),
                        written_by, version, afresh));
    std::vector<std::string> lines;
    add_differences(fixed_part(about.at("scene")), fixed_part(io::to_json(scene)), lines);
    add_differences(about.at("files"), input_files(scene), lines);
    if (lines.empty()) return;
    const std::size_t more = lines.size() - std::min(lines.size(), differences_shown);
    lines.resize(lines.size() - more);
    std::string text = fmt::format(
        "{} is of another scene; only its title, [time], the intervals of [output] and "
        "[[compare]] may change:",
        file.string());
    for (const std::string& line : lines) text += "\n  " + line;
    if (more > 0) text += fmt::format("\n  and {} more", more);
    throw io::CheckpointError(fmt::format("{}\ngo on with the scene as it was, or {}", text, afresh));
}

struct WholeCheckpoint {
    std::filesystem::path file;
    io::CheckpointFile read;
    long steps() const { return read.about.at("steps"); }
};

// Throws io::CheckpointError, and std::system_error where the file cannot be read.
WholeCheckpoint whole_checkpoint(const std::filesystem::path& file) {
    WholeCheckpoint whole{file, io::read_checkpoint(file)};
    for (const char* key : {"scene", "files", "time_s", "steps"})
        if (!whole.read.about.contains(key))
            throw io::OtherFormat(fmt::format("{} does not say its \"{}\"", file.string(), key));
    return whole;
}

// Of the two in a folder; pass_over(error) is told why one is not taken. Throws io::OtherFormat: neither is then
// likely to be of any use.
template <class PassOver>
std::optional<WholeCheckpoint> newest_whole(const std::filesystem::path& folder, PassOver&& pass_over) {
    std::optional<WholeCheckpoint> newest;
    for (const int slot : {0, 1}) {
        const std::filesystem::path file = checkpoint_file(folder, slot);
        if (!std::filesystem::exists(file)) continue;
        try {
            WholeCheckpoint whole = whole_checkpoint(file);
            if (!newest || whole.steps() > newest->steps()) newest = std::move(whole);
        } catch (const io::OtherFormat&) {
            throw;
        } catch (const std::exception& error) {  // the other one may be whole
            pass_over(error);
        }
    }
    return newest;
}

// What to do where the checkpoint that was asked for is of no use.
std::string instead(const std::filesystem::path& folder) {
    try {
        if (const auto whole = newest_whole(folder, [](const std::exception&) {}))
            return fmt::format("go on from {}, as --restart auto does", whole->file.string());
    } catch (const io::CheckpointError&) {
    }
    return fmt::format("there is no other in {}: {}", folder.string(), afresh);
}

RestartPoint restart_point(WholeCheckpoint&& from, const io::Scene& scene, std::ostream& said) {
    check_fits(from.file, from.read.about, scene);
    said << fmt::format("continuing from {}: t = {:.6g} s, step {}\n", from.file.string(),
                        from.read.about.at("time_s").get<double>(), from.steps());
    return {from.file, from.steps(), std::move(from.read.state)};
}

}  // namespace

std::filesystem::path checkpoint_file(const std::filesystem::path& folder, int slot) {
    return folder / fmt::format("checkpoint_{}.aquagraph", slot + 1);
}

Json about_run(const io::Scene& scene, double time, long steps) {
    return {{"program", "aquagraph"},
            {"version", version},
            {"dimension", scene.dimension},
            {"time_s", time},
            {"steps", steps},
            {"scene", io::to_json(scene)},
            {"scene_file", {{"name", scene.file.filename().string()}, {"text", scene.text}, {"set", scene.overrides}}},
            {"files", input_files(scene)}};
}

std::optional<RestartPoint> find_restart_point(const io::Scene& scene, const std::filesystem::path& folder,
                                               const std::string& restart, std::ostream& said) {
    if (restart.empty()) return std::nullopt;
    std::optional<WholeCheckpoint> from;
    try {
        if (restart == "auto")
            from = newest_whole(folder, [&](const std::exception& error) {
                said << fmt::format("passing over a checkpoint: {}\n", error.what());
            });
        else
            from = whole_checkpoint(restart);
    } catch (const io::OtherFormat& error) {
        throw io::CheckpointError(fmt::format("{}; go on with the program that wrote it, or {}", error.what(), afresh));
    } catch (const std::runtime_error& error) {
        throw io::CheckpointError(fmt::format("{}; {}", error.what(), instead(folder)));
    }
    if (!from) {
        said << fmt::format("no good checkpoint in {}: starting from the beginning\n", folder.string());
        return std::nullopt;
    }
    return restart_point(std::move(*from), scene, said);
}

}  // namespace aquagraph::engine
