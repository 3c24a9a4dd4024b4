// What the reader says of a scene that it refuses.
#pragma once
#include <string>

#include "io/scene_reader.hpp"
#include "tests/io/scratch.hpp"

namespace aquagraph::test {

// The message with which `read` refuses a scene; nothing if it does not.
template <class Read>
std::string refusal_by(const Read& read) {
    try {
        read();
    } catch (const io::SceneError& error) {
        return error.what();
    }
    return {};
}

inline std::string refusal(const std::string& text) {
    const ScratchFolder folder;
    return refusal_by([&] { io::read_scene(folder.write("scene.toml", text)); });
}

}  // namespace aquagraph::test
