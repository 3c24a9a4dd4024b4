#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

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

void write_file_durably(const std::filesystem::path& file, std::span<const std::string_view> pieces) {
    const std::filesystem::path part = temporary_name(file);
    Stream stream(std::fopen(part.c_str(), "wb"));
    if (!stream) fail(file, "cannot be written");
    bool written = true;
    for (const std::string_view piece : pieces)
        written = written && std::fwrite(piece.data(), 1, piece.size(), stream.get()) == piece.size();
    written = written && std::fflush(stream.get()) == 0 && fsync(fileno(stream.get())) == 0;
    const int reason = errno;
    stream.reset();
    if (!written || std::rename(part.c_str(), file.c_str()) != 0) {
        const int last = written ? errno : reason;
        std::remove(part.c_str());
        errno = last;
        fail(file, written ? "cannot be replaced" : "cannot be written");
    }
    // The new name is on the disk once its folder is.
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY); descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code wrong;
    std::filesystem::create_directories(folder, wrong);
    if (wrong) throw std::system_error(wrong, "the folder " + folder.string() + " cannot be made");
}

void check_writable(const std::filesystem::path& file) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    make_folder(folder);
    const std::filesystem::path trial = temporary_name(folder / file.filename());
    Stream stream(std::fopen(trial.c_str(), "wb"));
    if (!stream) fail(file, "cannot be written");
    stream.reset();
    std::filesystem::remove(trial);
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
