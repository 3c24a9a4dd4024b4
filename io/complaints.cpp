#include "io/complaints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

namespace aquagraph::io {
namespace {

std::string_view line_of(std::string_view text, int line) {
    std::size_t begin = 0;
    for (int i = 1; i < line && begin < text.size(); ++i) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string_view::npos) return {};
        begin = end + 1;
    }
    std::string_view found = text.substr(begin, text.find('\n', begin) - begin);
    if (found.ends_with('\r')) found.remove_suffix(1);
    return found;
}

// The characters of a line of UTF-8; what is none, and what would move a terminal's cursor, becomes a question mark.
std::vector<std::string> characters_of(std::string_view line) {
    std::vector<std::string> characters;
    while (!line.empty()) {
        const auto first = static_cast<unsigned char>(line[0]);
        const std::size_t length = first < 0x80 ? 1 : (first & 0xE0) == 0xC0 ? 2 : (first & 0xF0) == 0xE0 ? 3 : 4;
        const std::string_view rest = line.substr(1, length - 1);
        const bool whole =
            first < 0x80 || (first >= 0xC2 && first < 0xF5 && rest.size() == length - 1 &&
                             std::all_of(rest.begin(), rest.end(), [](char c) { return (c & 0xC0) == 0x80; }));
        const bool shown = first == '\t' || (first >= 0x20 && first != 0x7F);
        characters.emplace_back(whole && shown ? line.substr(0, length) : "?");
        line.remove_prefix(whole ? length : 1);
    }
    return characters;
}

constexpr std::size_t most_shown = 120;  // characters of a line

// The line, or the part of a long one about the column (a character's number, as an editor counts), and a caret below
// it. Tabs stay tabs so that the caret stands below its target.
std::string excerpt(std::string_view line, int column) {
    const std::vector<std::string> characters = characters_of(line);
    const std::size_t target = std::size_t(std::max(column, 1)) - 1;
    std::size_t from = 0, to = characters.size();
    if (to > most_shown) {
        from = std::min(target > most_shown / 2 ? target - most_shown / 2 : 0, to - most_shown);
        to = from + most_shown;
    }
    std::string shown = from > 0 ? "…" : "", margin = from > 0 ? " " : "";
    for (std::size_t k = from; k < to; ++k) shown += characters[k];
    for (std::size_t k = from; k < target; ++k) margin += k < characters.size() && characters[k] == "\t" ? "\t" : " ";
    if (to < characters.size()) shown += "…";
    return fmt::format("    {}\n    {}^", shown, margin);
}

std::string beginning(std::string_view line) {
    const std::vector<std::string> characters = characters_of(line);
    std::string shown;
    for (std::size_t k = 0; k < std::min(characters.size(), most_shown); ++k) shown += characters[k];
    return characters.size() > most_shown ? shown + "…" : shown;
}

std::string written(const std::filesystem::path& file, std::string_view text, const SceneComplaint& complaint) {
    if (complaint.position.line <= 0)
        return fmt::format("{}: error: {}\nhelp: {}", file.string(), complaint.message, complaint.help);
    const auto [line, column] = complaint.position;
    const std::string_view source = line_of(text, line);
    if (source.starts_with(override_mark))
        return fmt::format("{}: error: {}\nhelp: {}", beginning(source.substr(2)), complaint.message, complaint.help);
    return fmt::format("{}:{}:{}: error: {}\n{}\nhelp: {}", file.string(), line, column, complaint.message,
                       excerpt(source, column), complaint.help);
}

std::string written(const std::filesystem::path& file, std::string_view text,
                    const std::vector<SceneComplaint>& complaints) {
    std::string all;
    for (const SceneComplaint& complaint : complaints)
        all += (all.empty() ? "" : "\n\n") + written(file, text, complaint);
    return all;
}

}  // namespace

SceneError::SceneError(const std::filesystem::path& file, std::string_view text, std::vector<SceneComplaint> complaints)
    : std::runtime_error(written(file, text, complaints)), complaints_(std::move(complaints)) {}

SceneError scene_error(const Scene& scene, std::string_view key, std::string message, std::string help) {
    return {scene.file,
            scene.text,
            {{std::string(key), position_of(scene.positions, key), std::move(message), std::move(help)}}};
}

SourcePosition position_of(const Positions& positions, std::string_view key) {
    for (std::string_view at = key; !at.empty();) {
        if (const auto found = positions.find(std::string(at)); found != positions.end()) return found->second;
        const std::size_t cut = at.find_last_of(".[");
        at = cut == std::string_view::npos ? std::string_view{} : at.substr(0, cut);
    }
    return {1, 1};
}

void Complaints::add(std::string_view key, std::string message, std::string help) {
    add_at(position_of(positions, key), key, std::move(message), std::move(help));
}

void Complaints::add_at(SourcePosition position, std::string_view key, std::string message, std::string help) {
    all_.push_back({std::string(key), position, std::move(message), std::move(help)});
}

bool Complaints::touch(std::string_view key) const {
    return std::any_of(all_.begin(), all_.end(), [&](const SceneComplaint& complaint) {
        if (!complaint.key.starts_with(key)) return false;
        return complaint.key.size() == key.size() || complaint.key[key.size()] == '.' ||
               complaint.key[key.size()] == '[';
    });
}

std::vector<SceneComplaint> Complaints::in_order_of_the_file() const {
    std::vector<SceneComplaint> sorted = all_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const SceneComplaint& a, const SceneComplaint& b) {
        return std::tie(a.position.line, a.position.column) < std::tie(b.position.line, b.position.column);
    });
    return sorted;
}

}  // namespace aquagraph::io
