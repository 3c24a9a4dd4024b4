// How numbers are said in what the program prints.
#pragma once
#include <fmt/format.h>

#include <string>

namespace aquagraph::io {

// "1 thread", "2 threads".
inline std::string counted(long number, const char* thing) {
    return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

}  // namespace aquagraph::io
