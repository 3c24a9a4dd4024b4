#include "io/complaints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

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

// Blanks up to the column, counted in characters as an editor does; tabs stay tabs so that the caret stands below its
// target.
std::string caret(std::string_view line, int column) {
    std::string margin;
    int at = 1;
    for (const char c : line) {
        const bool continues_a_character = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
        if (continues_a_character) continue;
        if (at++ >= column) break;
        margin += c == '\t' ? '\t' : ' ';
    }
    while (at++ < column) margin += ' ';
    return margin + '^';
}

std::string written(const std::filesystem::path& file, std::string_view text, const SceneComplaint& complaint) {
    if (complaint.position.line <= 0)
        return fmt::format("{}: error: {}\nhelp: {}", file.string(), complaint.message, complaint.help);
    const auto [line, column] = complaint.position;
    const std::string_view source = line_of(text, line);
    if (source.starts_with(override_mark))
        return fmt::format("{}: error: {}\nhelp: {}", source.substr(2), complaint.message, complaint.help);
    return fmt::format("{}:{}:{}: error: {}\n    {}\n    {}\nhelp: {}", file.string(), line, column, complaint.message,
                       source, caret(source, column), complaint.help);
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
