#include "io/checkpoint_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "io/atomic_file.hpp"

namespace aquagraph::io {

namespace {

constexpr std::string_view mark = "aquagraph checkpoint\n";
constexpr std::size_t number = sizeof(std::uint64_t);
constexpr std::size_t before_json = mark.size() + 3 * number;

std::string text(std::uint64_t value) {
    return {reinterpret_cast<const char*>(&value), number};
}

std::uint64_t value_at(std::string_view bytes, std::size_t place) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + place, number);
    return value;
}

}  // namespace

// Each step maps the sum so far one to one for a given word, and the word one to one for a given sum.
std::uint64_t checksum(std::string_view bytes, std::uint64_t start) {
    std::uint64_t sum = start ^ (0x9e3779b97f4a7c15u + bytes.size());
    const auto add = [&](std::uint64_t word) {
        sum = (sum ^ word) * 0xd6e8feb86659fd93u;
        sum ^= sum >> 32;
    };
    std::size_t at = 0;
    for (; at + number <= bytes.size(); at += number) add(value_at(bytes, at));
    if (at < bytes.size()) {
        std::uint64_t last = 0;
        std::memcpy(&last, bytes.data() + at, bytes.size() - at);
        add(last);
    }
    return sum;
}

void write_checkpoint(const std::filesystem::path& file, const nlohmann::json& about, std::string_view state) {
    const std::string json = about.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    const std::string head =
        std::string(mark) + text(checkpoint_format) + text(json.size()) + text(state.size()) + json;
    const std::string sum = text(checksum(state, checksum(head)));
    write_file_durably(file, std::array<std::string_view, 3>{head, state, sum});
}

CheckpointFile read_checkpoint(const std::filesystem::path& file) {
    const std::string all = read_file(file);
    const auto fail = [&](const std::string& what) { throw CheckpointError(file.string() + " " + what); };
    if (all.size() < before_json || !all.starts_with(mark)) {
        const bool begun = all.starts_with(mark) || mark.starts_with(all);
        fail(begun ? "is cut off" : "is no checkpoint of aquagraph");
    }
    const std::uint64_t format = value_at(all, mark.size()), json = value_at(all, mark.size() + number),
                        state = value_at(all, mark.size() + 2 * number);
    if (format != checkpoint_format)
        throw OtherFormat(fmt::format("{} is a checkpoint of format {}, and this program reads format {}",
                                      file.string(), format, checkpoint_format));
    const std::uint64_t most = all.size();  // lengths out of a damaged head may be anything
    if (json > most || state > most || before_json + json + state + number > most)
        fail(fmt::format("is cut off: it ends after {} bytes", all.size()));
    const std::size_t head = before_json + json, end = head + state;
    if (all.size() != end + number || value_at(all, end) != checksum(std::string_view(all).substr(head, state),
                                                                     checksum(std::string_view(all).substr(0, head))))
        fail("is damaged: its checksum does not fit");
    CheckpointFile read;
    read.about = nlohmann::json::parse(all.begin() + std::ptrdiff_t(before_json), all.begin() + std::ptrdiff_t(head));
    read.state = all.substr(head, state);
    return read;
}

}  // namespace aquagraph::io
