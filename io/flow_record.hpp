// The flow as the report plays it: frames thinned out as the run goes, so that a long run costs no more memory than a
// short one.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/scene.hpp"

namespace aquagraph::io {

// What the engine gives: spans are only read while FlowRecord::add runs.
struct ReportFrame {
    double time = 0;                           // [s]
    std::span<const double> x, y;              // particles [m]
    std::span<const double> pressure;          // [Pa]; as long as x, or empty
    std::span<const double> speed;             // [m/s]; as long as x, or empty
    std::vector<std::vector<Point>> outlines;  // of the solids, closed polygons, deformed [m]
    std::span<const double> z{};               // in 3D: as long as x [m]
    std::vector<std::vector<Point>> walls{};   // panels of walls that move, where they are now [m]
};

class FlowRecord {
  public:
    struct Limits {
        std::size_t bytes = 2'200'000;  // of all frames together, before base64
        std::size_t frames = 240;
        std::size_t particles = 12'000;  // per frame; more are thinned evenly
    };
    struct Frame {
        double time = 0;
        std::size_t every = 1;                        // of so many particles one is kept
        std::vector<float> x, y, z, pressure, speed;  // z: in 3D
        std::vector<std::vector<Point>> outlines, walls;

        template <class Archive>
        void archive(Archive& fields) {
            fields(time, every, x, y, z, pressure, speed, outlines, walls);
        }
    };

    // spacing: Δx [m], the size of a drawn particle.
    explicit FlowRecord(double spacing) : FlowRecord(spacing, Limits{}) {}
    FlowRecord(double spacing, Limits limits);

    // Keeps the frame or drops it: once the limits are reached every second frame goes and only every second one is
    // taken from then on. Cheap where it is dropped. `wanted()` says beforehand whether the next one would be kept.
    bool wanted() const { return seen_ % stride_ == 0; }
    void add(const ReportFrame& frame);

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(frames_, seen_, stride_, bytes_);
    }

    double spacing() const { return spacing_; }
    const std::vector<Frame>& frames() const { return frames_; }

  private:
    double spacing_;
    Limits limits_;
    std::vector<Frame> frames_;
    std::size_t seen_ = 0, stride_ = 1, bytes_ = 0;
};

}  // namespace aquagraph::io
