#include "io/stl.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "io/atomic_file.hpp"

namespace aquagraph::io {
namespace {

using geometry::Vec;

constexpr std::size_t header_size = 84, record_size = 50;  // of binary files

void add(geometry::Surface<3>& surface, const Vec<3>& stated_normal, const std::array<Vec<3>, 3>& corners,
         const std::string& place) {
    const int base = int(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
    surface.facets.push_back({base, base + 1, base + 2});
    // Many programs write no normal (zero), and none writes it precisely; but it must not look the other way.
    const Vec<3> normal = surface.front(surface.facets.size() - 1);
    if (stated_normal.norm() > 0.5 && stated_normal.allFinite() && normal.norm() > 0 &&
        normal.normalized().dot(stated_normal.normalized()) < -0.5)
        throw StlError(
            fmt::format("{}: the stated normal ({:g}, {:g}, {:g}) looks the other way than the order of the "
                        "vertices, at ({:g}, {:g}, {:g})",
                        place, stated_normal.x(), stated_normal.y(), stated_normal.z(), corners[0].x(), corners[0].y(),
                        corners[0].z()));
}

// Words of an ASCII file, with the line that each stands in.
class Words {
  public:
    explicit Words(std::string_view text) : rest_(text) {}

    int line() const { return line_; }
    bool end() {
        skip_blanks();
        return rest_.empty();
    }
    std::string_view next() {
        if (end()) throw StlError(fmt::format("line {}: the file ends in the middle of a triangle", line_));
        std::size_t size = 0;
        while (size < rest_.size() && !blank(rest_[size])) ++size;
        const std::string_view word = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return word;
    }
    void skip_line() {
        const std::size_t end = rest_.find('\n');
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end);
    }
    void expect(std::string_view word) {
        const std::string_view found = next();
        if (!same(found, word))
            throw StlError(fmt::format("line {}: `{}` is expected, but there stands `{}`", line_, word, found));
    }
    double number() {
        std::string_view word = next();
        const std::string_view whole = word;
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
            throw StlError(fmt::format("line {}: a number is expected, but there stands `{}`", line_, whole));
        return value;
    }
    Vec<3> point() {
        const double x = number(), y = number();
        return {x, y, number()};
    }
    // Keywords are written in either case.
    static bool same(std::string_view a, std::string_view b) {
        if (a.size() != b.size()) return false;
        for (std::size_t k = 0; k < a.size(); ++k)
            if (std::tolower(static_cast<unsigned char>(a[k])) != std::tolower(static_cast<unsigned char>(b[k])))
                return false;
        return true;
    }

  private:
    static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }
    void skip_blanks() {
        while (!rest_.empty() && blank(rest_.front())) {
            if (rest_.front() == '\n') ++line_;
            rest_.remove_prefix(1);
        }
    }
    std::string_view rest_;
    int line_ = 1;
};

geometry::Surface<3> ascii(std::string_view content) {
    geometry::Surface<3> surface;
    Words words(content);
    bool in_solid = false;
    while (!words.end()) {
        const std::string_view word = words.next();
        if (Words::same(word, in_solid ? "endsolid" : "solid")) {
            words.skip_line();  // its name
            in_solid = !in_solid;
            continue;
        }
        if (!in_solid || !Words::same(word, "facet"))
            throw StlError(fmt::format("line {}: `{}` is expected, but there stands `{}`", words.line(),
                                       in_solid ? "facet" : "solid", word));
        const int line = words.line();
        words.expect("normal");
        const Vec<3> normal = words.point();
        words.expect("outer");
        words.expect("loop");
        std::array<Vec<3>, 3> corners;
        for (Vec<3>& corner : corners) {
            words.expect("vertex");
            corner = words.point();
        }
        words.expect("endloop");
        words.expect("endfacet");
        add(surface, normal, corners, fmt::format("line {}", line));
    }
    if (in_solid) throw StlError(fmt::format("line {}: the file ends without `endsolid`", words.line()));
    return surface;
}

std::uint32_t little_endian(const char* bytes) {
    std::uint32_t value = 0;
    for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
    return value;
}

geometry::Surface<3> binary(std::string_view content) {
    geometry::Surface<3> surface;
    const std::size_t n = little_endian(content.data() + 80);
    for (std::size_t t = 0; t < n; ++t) {
        std::array<Vec<3>, 4> values;
        for (std::size_t k = 0; k < 12; ++k)
            values[k / 3][Eigen::Index(k % 3)] =
                double(std::bit_cast<float>(little_endian(content.data() + header_size + t * record_size + 4 * k)));
        for (std::size_t k = 1; k < 4; ++k)
            if (!values[k].allFinite())
                throw StlError(fmt::format("triangle {} has a coordinate that is not a number", t + 1));
        add(surface, values[0], {values[1], values[2], values[3]}, fmt::format("triangle {}", t + 1));
    }
    return surface;
}

}  // namespace

geometry::Surface<3> parse_stl(std::string_view content) {
    // Binary headers may begin with "solid" too: the size decides.
    const bool has_count = content.size() >= header_size;
    const std::size_t count = has_count ? little_endian(content.data() + 80) : 0;
    const bool sized_as_binary = has_count && content.size() == header_size + count * record_size;
    geometry::Surface<3> surface;
    if (sized_as_binary)
        surface = binary(content);
    else if (Words words(content); !words.end() && Words::same(words.next(), "solid"))
        surface = ascii(content);
    else if (has_count)
        throw StlError(
            fmt::format("neither ASCII (no `solid` at the beginning) nor binary: {} triangles would take {} "
                        "bytes, but there are {}",
                        count, header_size + count * record_size, content.size()));
    else
        throw StlError("not an STL file: neither `solid` at the beginning nor a binary header");
    if (surface.facets.empty()) throw StlError("there is no triangle in it");
    return surface;
}

geometry::Surface<3> read_stl(const std::filesystem::path& file) {
    return parse_stl(read_file(file));
}

}  // namespace aquagraph::io
