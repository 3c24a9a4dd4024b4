// Collects what is wrong in a scene file while it is read, so that one run of the reader reports everything.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene_reader.hpp"

namespace aquagraph::io {

using Positions = std::map<std::string, SourcePosition>;

// The place of a key, or of the nearest enclosing table that has one, or the top of the file.
SourcePosition position_of(const Positions& positions, std::string_view key);

class Complaints {
  public:
    Positions positions;  // of every key and table met so far

    // Where `key` stands.
    void add(std::string_view key, std::string message, std::string help);
    void add_at(SourcePosition position, std::string_view key, std::string message, std::string help);

    // Whether something is wrong at or below a key: checks that build on its value are then left out.
    bool touch(std::string_view key) const;
    bool empty() const { return all_.empty(); }
    std::vector<SceneComplaint> in_order_of_the_file() const;

  private:
    std::vector<SceneComplaint> all_;
};

}  // namespace aquagraph::io
