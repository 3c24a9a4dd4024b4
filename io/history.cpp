#include "io/history.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "io/atomic_file.hpp"

namespace aquagraph::io {
namespace {

using namespace std::chrono_literals;

[[noreturn]] void fail(const std::filesystem::path& file) {
    throw std::system_error(errno, std::generic_category(), file.string() + " cannot be written");
}

std::string header(const std::vector<HistoryColumn>& columns) {
    std::string line;
    for (const HistoryColumn& column : columns)
        line += fmt::format("{}{}[{}]", line.empty() ? "" : ",", column.name, column.unit.empty() ? "-" : column.unit);
    return line + '\n';
}

std::string written(std::span<const double> values) {
    fmt::memory_buffer line;
    for (const double value : values) fmt::format_to(std::back_inserter(line), "{}{}", line.size() ? "," : "", value);
    line.push_back('\n');
    return fmt::to_string(line);
}

HistoryColumn column_of(std::string_view cell) {
    const std::size_t bracket = cell.find('[');
    if (bracket == std::string_view::npos || !cell.ends_with(']')) return {std::string(cell), ""};
    const std::string_view unit = cell.substr(bracket + 1, cell.size() - bracket - 2);
    return {std::string(cell.substr(0, bracket)), unit == "-" ? "" : std::string(unit)};
}

std::vector<std::string_view> cells(std::string_view line) {
    std::vector<std::string_view> found;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        found.push_back(line.substr(begin, end - begin));
        begin = end + 1;
    }
    return found;
}

}  // namespace

HistoryWriter::HistoryWriter(std::filesystem::path file, std::vector<HistoryColumn> columns)
    : file_(std::move(file)), columns_(columns.size()), stream_(std::fopen(file_.c_str(), "wb")) {
    if (!stream_) fail(file_);
    put(header(columns));
    flush();
}

HistoryWriter HistoryWriter::resume(std::filesystem::path file, std::vector<HistoryColumn> columns, double last_time) {
    if (!std::filesystem::exists(file)) return HistoryWriter(std::move(file), std::move(columns));
    const History old = read_history(file);
    if (header(old.columns) != header(columns))
        throw std::runtime_error(fmt::format("{} has other columns than this run writes", file.string()));
    std::string kept = read_file(file);
    std::size_t rows = 0, end = kept.find('\n') + 1;
    while (rows < old.rows() && old.time()[rows] <= last_time) {
        end = kept.find('\n', end) + 1;
        ++rows;
    }
    // Rewritten as a whole, so that a crash in between leaves the old file or the new one.
    if (end != kept.size()) {
        kept.resize(end);
        write_file_atomically(file, kept);
    }
    HistoryWriter writer;
    writer.file_ = std::move(file);
    writer.columns_ = columns.size();
    writer.stream_.reset(std::fopen(writer.file_.c_str(), "ab"));
    if (!writer.stream_) fail(writer.file_);
    return writer;
}

void HistoryWriter::row(std::span<const double> values) {
    if (values.size() != columns_)
        throw std::invalid_argument(fmt::format("a history row of {} values for {} columns", values.size(), columns_));
    put(written(values));
    if (std::chrono::steady_clock::now() - flushed_ > 500ms) flush();
}

void HistoryWriter::put(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size()) fail(file_);
}

void HistoryWriter::flush() {
    if (std::fflush(stream_.get()) != 0) fail(file_);
    flushed_ = std::chrono::steady_clock::now();
}

void HistoryWriter::sync() {
    flush();
    if (fsync(fileno(stream_.get())) != 0 && errno != EINVAL) fail(file_);  // EINVAL: no file that lies on a disk
}

std::optional<std::size_t> History::find(std::string_view name) const {
    for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns[i].name == name) return i;
    return std::nullopt;
}

std::span<const double> History::time() const& {
    if (values.empty()) return {};
    return values.front();
}

std::span<const double> History::column(std::string_view name) const& {
    if (const auto index = find(name)) return values[*index];
    std::vector<std::string_view> names;
    for (const HistoryColumn& column : columns) names.push_back(column.name);
    throw std::out_of_range(fmt::format("the history has no column \"{}\"; it has {}", name, fmt::join(names, ", ")));
}

History read_history(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    History history;
    std::string_view rest = text;
    for (int number = 1; rest.find('\n') != std::string_view::npos; ++number) {
        const std::size_t end = rest.find('\n');
        const auto row = cells(rest.substr(0, end));
        rest.remove_prefix(end + 1);
        if (number == 1) {
            for (const std::string_view cell : row) history.columns.push_back(column_of(cell));
            history.values.resize(row.size());
            continue;
        }
        if (row.size() != history.columns.size())
            throw std::runtime_error(fmt::format("{}:{}: {} values for {} columns", file.string(), number, row.size(),
                                                 history.columns.size()));
        for (std::size_t c = 0; c < row.size(); ++c) {
            double value = 0;
            const auto [stop, error] = std::from_chars(row[c].data(), row[c].data() + row[c].size(), value);
            if (error != std::errc{} || stop != row[c].data() + row[c].size())
                throw std::runtime_error(fmt::format("{}:{}: \"{}\" is no number", file.string(), number, row[c]));
            history.values[c].push_back(value);
        }
    }
    if (history.columns.empty()) throw std::runtime_error(fmt::format("{} has no header", file.string()));
    return history;
}

}  // namespace aquagraph::io
