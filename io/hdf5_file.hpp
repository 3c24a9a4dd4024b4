// A thin, typed hold on the HDF5 C library: what the frames need, and what the tests read them back with. hdf5.h stays
// out of this header. Every member throws std::runtime_error naming the file and HDF5's own reason.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace aquagraph::io {

class Hdf5File {
  public:
    // Built in memory; close() writes it, as a whole and atomically. Without close() nothing is written.
    static Hdf5File create(const std::filesystem::path& file);
    static Hdf5File open(const std::filesystem::path& file);  // to read
    Hdf5File(Hdf5File&& other) noexcept;
    Hdf5File& operator=(Hdf5File&&) = delete;
    ~Hdf5File();
    // Throws std::system_error with the system's own reason where the file cannot be written.
    void close();

    void group(const std::string& path);
    void attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values);
    void attribute(const std::string& object, const std::string& name, const std::string& ascii);  // fixed length

    // values: rows × columns, row by row; columns = 0: one-dimensional. Chunked, shuffled, gzip level 1 where worth it.
    // T: double, float, std::int64_t, std::int32_t, std::uint8_t.
    template <class T>
    void dataset(const std::string& path, std::span<const T> values, std::size_t columns = 0);

    bool has(const std::string& path) const;
    std::vector<std::string> members(const std::string& group) const;
    std::vector<std::size_t> shape(const std::string& path) const;
    std::string type_name(const std::string& path) const;  // as stored: "float64", "float32", "int64", "int32", "uint8"
    template <class T>
    std::vector<T> read(const std::string& path) const;
    std::vector<std::int64_t> integers_attribute(const std::string& object, const std::string& name) const;
    std::string text_attribute(const std::string& object, const std::string& name) const;
    bool text_attribute_is_fixed_ascii(const std::string& object, const std::string& name) const;

  private:
    Hdf5File(std::int64_t id, std::filesystem::path file, bool writing)
        : id_(id), file_(std::move(file)), writing_(writing) {}
    std::int64_t id_;
    std::filesystem::path file_;
    bool writing_;
};

}  // namespace aquagraph::io
