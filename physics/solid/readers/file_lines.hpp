// The lines of a mesh file with their numbers: every error message carries the number of the line read last.
#pragma once
#include <istream>
#include <sstream>
#include <string>
#include <utility>

#include "physics/solid/mesh.hpp"

namespace aquagraph::solid {

class FileLines {
  public:
    FileLines(std::istream& input, std::string source) : input_(input), source_(std::move(source)) {}

    // The next line that is not blank, without its carriage return; false at the end.
    bool next(std::string& line) {
        while (std::getline(input_, line)) {
            ++number_;
            if (!line.empty() && line.back() == '\r') line.pop_back();
            if (line.find_first_not_of(" \t") != std::string::npos) return true;
        }
        return false;
    }
    long number() const { return number_; }
    const std::string& source() const { return source_; }

    [[noreturn]] void fail(const std::string& message) const { fail(message, number_); }
    [[noreturn]] void fail(const std::string& message, long line) const {
        throw MeshError(source_ + ", line " + std::to_string(line) + ": " + message);
    }

  private:
    std::istream& input_;
    std::string source_;
    long number_ = 0;
};

// Those of a Gmsh file: sections $Name … $EndName.
class GmshLines : public FileLines {
  public:
    using FileLines::FileLines;

    std::istringstream need(const std::string& what) {
        std::string line;
        if (!next(line)) fail("the file ends where " + what + " should follow: it is truncated");
        if (line.front() == '$') fail("found " + line + " where " + what + " should follow");
        return std::istringstream(line);
    }
    template <class... Values>
    std::istringstream read(const std::string& what, Values&... values) {
        std::istringstream line = need(what);
        (line >> ... >> values);
        if (!line) fail("cannot read " + what);
        return line;
    }
    void end(const std::string& section) {
        std::string line;
        if (!next(line)) fail("the file ends inside $" + section + ": it is truncated");
        if (line.rfind("$End" + section, 0) != 0) fail("$End" + section + " is expected here, found: " + line);
    }
};

}  // namespace aquagraph::solid
