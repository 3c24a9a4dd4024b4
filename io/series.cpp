#include "io/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/atomic_file.hpp"

namespace aquagraph::io {

FrameSeries::FrameSeries(std::filesystem::path file) : file_(std::move(file)) {}

FrameSeries FrameSeries::resume(std::filesystem::path file, double last_time) {
    FrameSeries series(std::move(file));
    if (!std::filesystem::exists(series.file_)) return series;
    std::size_t later = 0;
    try {
        const auto old = nlohmann::json::parse(read_file(series.file_));
        for (const auto& entry : old.at("files")) {
            if (const double time = entry.at("time"); time <= last_time)
                series.entries_.push_back({entry.at("name"), time});
            else
                ++later;
        }
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(fmt::format("{} is no list of frames: {}", series.file_.string(), error.what()));
    }
    if (later > 0) series.write();
    return series;
}

void FrameSeries::add(std::string name, double time) {
    entries_.push_back({std::move(name), time});
    write();
}

void FrameSeries::write() const {
    nlohmann::ordered_json list{{"file-series-version", "1.0"}, {"files", nlohmann::ordered_json::array()}};
    for (const SeriesEntry& entry : entries_) list["files"].push_back({{"name", entry.name}, {"time", entry.time}});
    write_file_atomically(file_, list.dump(1) + "\n");
}

std::string frame_name(std::string_view stem, int number) {
    return fmt::format("{}_{:06}.hdf", stem, number);
}

}  // namespace aquagraph::io
