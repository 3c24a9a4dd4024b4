// Texts of files: read, changed in one place, searched.
#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace aquagraph::test {

// `text` with the first `from` replaced. A test that changes nothing would test nothing: throws if `from` is missing.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the text holds no '" + std::string(from) + "'");
    return text.replace(at, from.size(), to);
}

inline std::string without(const std::string& text, std::string_view part) {
    return with(text, part, "");
}

inline std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error("cannot read " + file.filename().string());
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::size_t count(std::string_view text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size()))
        ++found;
    return found;
}

}  // namespace aquagraph::test
