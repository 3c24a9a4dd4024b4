#include "io/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace aquagraph::io {
namespace {

struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using Stream = std::unique_ptr<std::FILE, Close>;

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) {
    throw std::system_error(errno, std::generic_category(), file.string() + " " + what);
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& file) {
    std::filesystem::path name = file;
    name += ".part";
    return name;
}

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
    const std::filesystem::path part = temporary_name(file);
    Stream stream(std::fopen(part.c_str(), "wb"));
    if (!stream) fail(file, "cannot be written");
    const bool written = std::fwrite(content.data(), 1, content.size(), stream.get()) == content.size() &&
                         std::fflush(stream.get()) == 0;
    if (!written) {
        const int reason = errno;
        stream.reset();
        std::remove(part.c_str());
        errno = reason;
        fail(file, "cannot be written");
    }
    stream.reset();
    if (std::rename(part.c_str(), file.c_str()) != 0) fail(file, "cannot be replaced");
}

std::string read_file(const std::filesystem::path& file) {
    Stream stream(std::fopen(file.c_str(), "rb"));
    if (!stream) fail(file, "cannot be read");
    std::string content;
    char buffer[1 << 16];
    while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, stream.get())) content.append(buffer, got);
    if (std::ferror(stream.get())) fail(file, "cannot be read");
    return content;
}

}  // namespace aquagraph::io
