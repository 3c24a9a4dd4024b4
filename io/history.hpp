// history.csv: one row per sample, written as the run goes. The header names each column with its unit, "tip_x[m]"; the
// first column is time[s]. Numbers are the shortest decimals that read back to the same double.
#pragma once
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace aquagraph::io {

struct HistoryColumn {
    std::string name;  // "tip_x"
    std::string unit;  // "m"; empty: none, written "name[-]"
};

class HistoryWriter {
  public:
    // A new file; one that is there is replaced. The first column must be the time.
    // Throws std::system_error naming the file where it cannot be written, here and in every member below.
    HistoryWriter(std::filesystem::path file, std::vector<HistoryColumn> columns);

    // Goes on with a file that is there (a new one where it is not): rows later than `last_time` [s] and a row cut off
    // by a crash are dropped, the others stay as they are, byte by byte. Throws std::runtime_error where its columns
    // are others.
    static HistoryWriter resume(std::filesystem::path file, std::vector<HistoryColumn> columns, double last_time);

    // One value per column. Reaches the file within a second.
    void row(std::span<const double> values);
    void flush();
    void sync();  // and waits until it is on the disk

    const std::filesystem::path& file() const { return file_; }

  private:
    HistoryWriter() = default;
    struct Close {
        void operator()(std::FILE* stream) const { std::fclose(stream); }
    };
    void put(std::string_view text);

    std::filesystem::path file_;
    std::size_t columns_ = 0;
    std::unique_ptr<std::FILE, Close> stream_;
    std::chrono::steady_clock::time_point flushed_{};
};

struct History {
    std::vector<HistoryColumn> columns;
    std::vector<std::vector<double>> values;  // one vector per column, all as long as there are rows

    std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
    std::optional<std::size_t> find(std::string_view name) const;  // by name without unit
    // The first column [s], and the one of this name: views of this history, hence not of one that is about to go.
    // Throws std::out_of_range, naming the columns there are.
    std::span<const double> time() const&;
    std::span<const double> column(std::string_view name) const&;
    std::span<const double> time() const&& = delete;
    std::span<const double> column(std::string_view name) const&& = delete;
};

// A last row without its line end is left out. Throws std::system_error or std::runtime_error with file and line.
History read_history(const std::filesystem::path& file);

}  // namespace aquagraph::io
