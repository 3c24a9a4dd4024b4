// The list of frames with their times that ParaView opens as one animation: fluid.hdf.series.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace aquagraph::io {

struct SeriesEntry {
    std::string name;  // of the frame's file, beside the series
    double time = 0;   // [s]
};

class FrameSeries {
  public:
    explicit FrameSeries(std::filesystem::path file);  // "…/fluid.hdf.series"; written with the first frame
    // Goes on with a series that is there, and takes frames later than last_time [s] out of it.
    static FrameSeries resume(std::filesystem::path file, double last_time);

    // Adds a frame and rewrites the file atomically. Throws std::system_error.
    void add(std::string name, double time);
    const std::vector<SeriesEntry>& entries() const { return entries_; }

  private:
    void write() const;
    std::filesystem::path file_;
    std::vector<SeriesEntry> entries_;
};

// "fluid_000042.hdf"
std::string frame_name(std::string_view stem, int number);

}  // namespace aquagraph::io
