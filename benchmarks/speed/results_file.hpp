// A section of benchmarks/RESULTS.md: the lines between two markers, so that what other programs have measured stays.
#pragma once
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace aquagraph::benchmarks {

// Replaces the section `name`, or appends it to the file; makes the file where there is none.
inline void write_section(const std::filesystem::path& file, const std::string& name, const std::string& text) {
    const std::string begin = "<!-- begin " + name + " -->\n", end = "<!-- end " + name + " -->\n";
    std::string content;
    if (std::ifstream in(file); in) {
        std::ostringstream all;
        all << in.rdbuf();
        content = all.str();
    }
    const std::size_t from = content.find(begin), to = content.find(end);
    if ((from == std::string::npos) != (to == std::string::npos) || (from != std::string::npos && to < from))
        throw std::runtime_error(file.string() + ": the markers of section '" + name +
                                 "' do not match; mend or remove them");
    const std::string section = begin + text + end;
    if (from == std::string::npos)
        content += "\n" + section;
    else
        content.replace(from, to + end.size() - from, section);
    std::ofstream out(file);
    out << content;
    if (!out.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

}  // namespace aquagraph::benchmarks
