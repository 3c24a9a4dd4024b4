// Surfaces as the text or the bytes of an STL file.
#pragma once
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "physics/geometry/surface.hpp"

namespace aquagraph::test {

inline std::string ascii_stl(const geometry::Surface<3>& surface) {
    const auto numbers = [](const geometry::Vec<3>& x) {
        return fmt::format("{} {} {}", x.x() + 0.0, x.y() + 0.0, x.z() + 0.0);
    };
    std::string text = "solid body\n";
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        text += fmt::format("  facet normal {}\n    outer loop\n", numbers(surface.front(f).normalized()));
        for (std::size_t k = 0; k < 3; ++k) text += fmt::format("      vertex {}\n", numbers(surface.vertex(f, k)));
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid body\n";
}

inline std::string binary_stl(const geometry::Surface<3>& surface, std::string_view header) {
    std::string bytes(80, '\0');
    bytes.replace(0, header.size(), header);
    const auto put = [&](std::uint32_t value, int size) {
        for (int k = 0; k < size; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
    };
    put(static_cast<std::uint32_t>(surface.facets.size()), 4);
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const auto point = [&](const geometry::Vec<3>& x) {
            for (int d = 0; d < 3; ++d) put(std::bit_cast<std::uint32_t>(static_cast<float>(x[d])), 4);
        };
        point(surface.front(f).normalized());
        for (std::size_t k = 0; k < 3; ++k) point(surface.vertex(f, k));
        put(0, 2);
    }
    return bytes;
}

}  // namespace aquagraph::test
