#include "io/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "io/atomic_file.hpp"

namespace aquagraph::io {
namespace {

// Chunks of about a hundred thousand values: large enough to compress well, small enough for a reader's chunk cache.
constexpr std::size_t values_per_chunk = 1 << 17;
// Smaller arrays gain nothing from a filter.
constexpr std::size_t worth_compressing = 256;

// The innermost reason HDF5 has on its stack: what the operating system said, where it did.
std::string reason() {
    std::string text;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_UPWARD,
        [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
            auto& innermost = *static_cast<std::string*>(found);
            if (innermost.empty() && error->desc) innermost = error->desc;
            return 0;
        },
        &text);
    return text.empty() ? "unknown reason" : text;
}

// HDF5 would print its error stack itself; here it becomes the text of an exception.
void keep_quiet() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

class Id {
  public:
    Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Id() {
        if (id_ >= 0) close_(id_);
    }
    Id(const Id&) = delete;
    Id& operator=(const Id&) = delete;
    operator hid_t() const { return id_; }
    bool good() const { return id_ >= 0; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
    throw std::runtime_error(fmt::format("{}: {}: {}", file.string(), what, reason()));
}

void must(bool good, const std::filesystem::path& file, const std::string& what) {
    if (!good) fail(file, what);
}

template <class T>
hid_t native();
template <>
hid_t native<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
hid_t native<float>() {
    return H5T_NATIVE_FLOAT;
}
template <>
hid_t native<std::int64_t>() {
    return H5T_NATIVE_INT64;
}
template <>
hid_t native<std::int32_t>() {
    return H5T_NATIVE_INT32;
}
template <>
hid_t native<std::uint8_t>() {
    return H5T_NATIVE_UINT8;
}

}  // namespace

Hdf5File Hdf5File::create(const std::filesystem::path& file) {
    keep_quiet();
    // In memory first: a full disk then is one failed write of ours, with the system's reason, and not a file that the
    // library can neither finish nor let go.
    const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, 1 << 20, false);
    const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    must(id >= 0, file, "cannot be written");
    return {id, file, true};
}

Hdf5File Hdf5File::open(const std::filesystem::path& file) {
    keep_quiet();
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    must(id >= 0, file, "cannot be read");
    return {id, file, false};
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : id_(std::exchange(other.id_, -1)), file_(std::move(other.file_)), writing_(other.writing_) {}

Hdf5File::~Hdf5File() {
    if (id_ >= 0) H5Fclose(id_);
}

void Hdf5File::close() {
    if (id_ < 0) return;
    std::string image;
    if (writing_) {
        must(H5Fflush(id_, H5F_SCOPE_GLOBAL) >= 0, file_, "cannot be completed");
        const ssize_t size = H5Fget_file_image(id_, nullptr, 0);
        image.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
        must(size > 0 && H5Fget_file_image(id_, image.data(), image.size()) == size, file_, "cannot be completed");
    }
    must(H5Fclose(std::exchange(id_, -1)) >= 0, file_, "cannot be closed");
    if (writing_) write_file_atomically(file_, image);
}

void Hdf5File::group(const std::string& path) {
    const Id made(H5Gcreate2(id_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    must(made.good(), file_, "no group " + path);
}

void Hdf5File::attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values) {
    const hsize_t size = values.size();
    const Id space(H5Screate_simple(1, &size, nullptr), H5Sclose),
        at(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
    const Id made(H5Acreate2(at, name.c_str(), H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    must(made.good() && H5Awrite(made, H5T_NATIVE_INT64, values.data()) >= 0, file_, "no attribute " + name);
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const std::string& ascii) {
    const Id type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type, ascii.size());
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_ASCII);
    const Id at(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
    const Id made(H5Acreate2(at, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    must(made.good() && H5Awrite(made, type, ascii.data()) >= 0, file_, "no attribute " + name);
}

template <class T>
void Hdf5File::dataset(const std::string& path, std::span<const T> values, std::size_t columns) {
    const std::size_t width = std::max<std::size_t>(columns, 1);
    if (values.size() % width != 0)
        throw std::invalid_argument(fmt::format("{} values are no rows of {}", values.size(), width));
    const int rank = columns == 0 ? 1 : 2;
    const hsize_t shape[2] = {values.size() / width, width};
    const Id space(H5Screate_simple(rank, shape, nullptr), H5Sclose), layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (values.size() >= worth_compressing) {
        const hsize_t chunk[2] = {std::min<hsize_t>(shape[0], values_per_chunk / width), width};
        H5Pset_chunk(layout, rank, chunk);
        H5Pset_shuffle(layout);
        H5Pset_deflate(layout, 1);
    }
    const Id made(H5Dcreate2(id_, path.c_str(), native<T>(), space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
    must(made.good(), file_, "no array " + path);
    if (!values.empty())
        must(H5Dwrite(made, native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, file_,
             "cannot write " + path);
}

bool Hdf5File::has(const std::string& path) const {
    return H5Lexists(id_, path.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
    std::vector<std::string> names;
    const Id opened(H5Gopen2(id_, group.c_str(), H5P_DEFAULT), H5Gclose);
    must(opened.good(), file_, "no group " + group);
    H5Literate(
        opened, H5_INDEX_NAME, H5_ITER_INC, nullptr,
        [](hid_t, const char* name, const H5L_info_t*, void* all) -> herr_t {
            static_cast<std::vector<std::string>*>(all)->emplace_back(name);
            return 0;
        },
        &names);
    return names;
}

std::vector<std::size_t> Hdf5File::shape(const std::string& path) const {
    const Id opened(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
    must(opened.good(), file_, "no array " + path);
    const Id space(H5Dget_space(opened), H5Sclose);
    hsize_t extent[H5S_MAX_RANK];
    const int rank = H5Sget_simple_extent_dims(space, extent, nullptr);
    return {extent, extent + std::max(rank, 0)};
}

std::string Hdf5File::type_name(const std::string& path) const {
    const Id opened(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
    must(opened.good(), file_, "no array " + path);
    const Id type(H5Dget_type(opened), H5Tclose);
    const bool whole = H5Tget_class(type) == H5T_INTEGER, with_sign = !whole || H5Tget_sign(type) == H5T_SGN_2;
    return fmt::format("{}{}{}", with_sign ? "" : "u", whole ? "int" : "float", 8 * H5Tget_size(type));
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& path) const {
    const Id opened(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
    must(opened.good(), file_, "no array " + path);
    const Id space(H5Dget_space(opened), H5Sclose);
    std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    if (!values.empty())
        must(H5Dread(opened, native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, file_,
             "cannot read " + path);
    return values;
}

std::vector<std::int64_t> Hdf5File::integers_attribute(const std::string& object, const std::string& name) const {
    const Id opened(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    must(opened.good(), file_, "no attribute " + name);
    const Id space(H5Aget_space(opened), H5Sclose);
    std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    must(H5Aread(opened, H5T_NATIVE_INT64, values.data()) >= 0, file_, "cannot read attribute " + name);
    return values;
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
    const Id opened(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    must(opened.good(), file_, "no attribute " + name);
    const Id type(H5Aget_type(opened), H5Tclose);
    std::string text(H5Tget_size(type), '\0');
    must(H5Aread(opened, type, text.data()) >= 0, file_, "cannot read attribute " + name);
    return text;
}

bool Hdf5File::text_attribute_is_fixed_ascii(const std::string& object, const std::string& name) const {
    const Id opened(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    must(opened.good(), file_, "no attribute " + name);
    const Id type(H5Aget_type(opened), H5Tclose);
    return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 && H5Tget_cset(type) == H5T_CSET_ASCII;
}

template void Hdf5File::dataset(const std::string&, std::span<const double>, std::size_t);
template void Hdf5File::dataset(const std::string&, std::span<const float>, std::size_t);
template void Hdf5File::dataset(const std::string&, std::span<const std::int64_t>, std::size_t);
template void Hdf5File::dataset(const std::string&, std::span<const std::int32_t>, std::size_t);
template void Hdf5File::dataset(const std::string&, std::span<const std::uint8_t>, std::size_t);
template std::vector<double> Hdf5File::read(const std::string&) const;
template std::vector<float> Hdf5File::read(const std::string&) const;
template std::vector<std::int64_t> Hdf5File::read(const std::string&) const;
template std::vector<std::int32_t> Hdf5File::read(const std::string&) const;
template std::vector<std::uint8_t> Hdf5File::read(const std::string&) const;

}  // namespace aquagraph::io
