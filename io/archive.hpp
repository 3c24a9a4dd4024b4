// State as bytes and back. A part lists its fields once,
//     template <class Archive> void archive(Archive& fields) { fields(a, b, c); }
// for writing and for reading, so that the two cannot disagree. Fields are numbers, enumerations and plain structs,
// texts, vectors and arrays of fields, and parts. Each carries its kind and size and each section its name, so that
// bytes of a program that listed others are refused and not misread. In the byte order of the machine.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace aquagraph::io {

class ArchiveError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

namespace archive_kinds {

// Vectors and matrices of a fixed size are arrays of numbers, though they have constructors.
template <class T>
concept FixedMatrix = requires {
    typename T::Scalar;
    T::SizeAtCompileTime;
};
template <class T>
concept Plain = FixedMatrix<T> ||(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
template <class T, class Archive>
concept Part = requires(T& part, Archive& fields) {
    part.archive(fields);
};
template <class T>
concept Sequence = requires(T& values) {
    values.resize(std::size_t{});
    values.data();
};

enum class Mark : char { plain = 'p', sequence = 'v', list = 'l', section = 's' };

// May have bytes between its fields, which have no value.
template <class T>
concept WithGaps = std::is_class_v<T> && !FixedMatrix<T>;

}  // namespace archive_kinds

class ArchiveWriter {
  public:
    static constexpr bool reads() { return false; }
    template <class... Fields>
    void operator()(Fields&... fields) {
        (put(fields), ...);
    }
    void section(std::string_view name) {
        head(archive_kinds::Mark::section, 1, name.size());
        append(name.data(), name.size());
    }
    std::string take() { return std::move(bytes_); }

  private:
    void append(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
    // Gaps become zero, so that equal states are equal bytes.
    template <class T>
    void append_plain(const T& field) {
        if constexpr (archive_kinds::WithGaps<T>) {
            T copy = field;
#if __has_builtin(__builtin_clear_padding)
            __builtin_clear_padding(&copy);
#endif
            append(&copy, sizeof copy);
        } else {
            append(&field, sizeof field);
        }
    }
    // In front of every field: its kind, its size or that of an entry [bytes], how many there are.
    void head(archive_kinds::Mark mark, std::size_t size, std::size_t count) {
        const auto width = std::uint32_t(size);
        const auto entries = std::uint64_t(count);
        append(&mark, 1);
        append(&width, sizeof width);
        append(&entries, sizeof entries);
    }
    template <class T>
    void put(T& field) {
        using namespace archive_kinds;
        if constexpr (Part<T, ArchiveWriter>) {
            field.archive(*this);
        } else if constexpr (Plain<T>) {
            head(Mark::plain, sizeof(T), 1);
            append_plain(field);
        } else if constexpr (Sequence<T>) {
            using Entry = typename T::value_type;
            if constexpr (Plain<Entry> && !Part<Entry, ArchiveWriter>) {
                head(Mark::sequence, sizeof(Entry), field.size());
                if constexpr (WithGaps<Entry>)
                    for (Entry& entry : field) append_plain(entry);
                else
                    append(field.data(), field.size() * sizeof(Entry));
            } else {
                head(Mark::list, 0, field.size());
                for (Entry& entry : field) put(entry);
            }
        } else {  // an array of sequences
            for (auto& entry : field) put(entry);
        }
    }

    std::string bytes_;
};

// Reads what an ArchiveWriter has written; throws ArchiveError for anything else.
class ArchiveReader {
  public:
    // The bytes are read where they are, hence not those of a text that is about to go.
    explicit ArchiveReader(std::string_view bytes) : rest_(bytes) {}
    explicit ArchiveReader(std::string&&) = delete;
    static constexpr bool reads() { return true; }
    template <class... Fields>
    void operator()(Fields&... fields) {
        (get(fields), ...);
    }
    void section(std::string_view name) {
        section_ = name;
        std::string found(head(archive_kinds::Mark::section, 1), '\0');
        take(found.data(), found.size());
        if (found != name) fail("begins with '" + found + "'");
    }
    void must_be_at_the_end() const {
        if (!rest_.empty()) fail("is followed by " + std::to_string(rest_.size()) + " bytes more");
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw ArchiveError("its part '" + section_ + "' " + what +
                           ": it was written by a program whose state has other fields");
    }
    void take(void* to, std::size_t size) {
        if (size > rest_.size()) fail("ends too early");
        std::memcpy(to, rest_.data(), size);
        rest_.remove_prefix(size);
    }
    // The count; sizes and kinds must be as expected.
    std::size_t head(archive_kinds::Mark mark, std::size_t size) {
        archive_kinds::Mark found{};
        std::uint32_t width = 0;
        std::uint64_t count = 0;
        take(&found, 1);
        take(&width, sizeof width);
        take(&count, sizeof count);
        if (found != mark || width != size || count > rest_.size() / (size > 0 ? size : 1)) fail("does not fit");
        return std::size_t(count);
    }
    template <class T>
    void get(T& field) {
        using namespace archive_kinds;
        if constexpr (Part<T, ArchiveReader>) {
            field.archive(*this);
        } else if constexpr (Plain<T>) {
            head(Mark::plain, sizeof(T));
            take(static_cast<void*>(&field), sizeof(T));
        } else if constexpr (Sequence<T>) {
            using Entry = typename T::value_type;
            if constexpr (Plain<Entry> && !Part<Entry, ArchiveReader>) {
                field.resize(head(Mark::sequence, sizeof(Entry)));
                take(static_cast<void*>(field.data()), field.size() * sizeof(Entry));
            } else {
                field.resize(head(Mark::list, 0));
                for (Entry& entry : field) get(entry);
            }
        } else {
            for (auto& entry : field) get(entry);
        }
    }

    std::string_view rest_;
    std::string section_ = "start";
};

// One or the other, for parts that are only known by a function that takes it.
class AnyArchive {
  public:
    AnyArchive(ArchiveWriter& writer) : writer_(&writer) {}  // NOLINT: implicit on purpose
    AnyArchive(ArchiveReader& reader) : reader_(&reader) {}  // NOLINT
    bool reads() const { return reader_ != nullptr; }
    template <class... Fields>
    void operator()(Fields&... fields) {
        reader_ ? (*reader_)(fields...) : (*writer_)(fields...);
    }

  private:
    ArchiveWriter* writer_ = nullptr;
    ArchiveReader* reader_ = nullptr;
};

}  // namespace aquagraph::io
