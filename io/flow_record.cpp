#include "io/flow_record.hpp"

#include <algorithm>
#include <stdexcept>

namespace aquagraph::io {
namespace {

// As embedded: each coordinate in two bytes, each field in one.
std::size_t embedded_bytes(const FlowRecord::Frame& frame) {
    std::size_t bytes =
        2 * (frame.x.size() + frame.y.size() + frame.z.size()) + frame.pressure.size() + frame.speed.size();
    for (const auto& outline : frame.outlines) bytes += 4 * outline.size();
    for (const auto& panel : frame.walls) bytes += 4 * panel.size();
    return bytes;
}

// Every stride-th entry. Particles are kept in a spatial order, so this thins evenly over the flow.
std::vector<float> thinned(std::span<const double> values, std::size_t stride) {
    std::vector<float> kept;
    kept.reserve(values.size() / stride + 1);
    for (std::size_t i = 0; i < values.size(); i += stride) kept.push_back(static_cast<float>(values[i]));
    return kept;
}

}  // namespace

FlowRecord::FlowRecord(double spacing, Limits limits) : spacing_(spacing), limits_(limits) {}

void FlowRecord::add(const ReportFrame& frame) {
    const std::size_t n = frame.x.size();
    if (frame.y.size() != n || (!frame.z.empty() && frame.z.size() != n) ||
        (!frame.pressure.empty() && frame.pressure.size() != n) || (!frame.speed.empty() && frame.speed.size() != n))
        throw std::invalid_argument("the fields of a report frame differ in length");
    if (seen_++ % stride_ != 0) return;
    const std::size_t every = std::max<std::size_t>(1, (n + limits_.particles - 1) / limits_.particles);
    Frame kept{frame.time,
               every,
               thinned(frame.x, every),
               thinned(frame.y, every),
               thinned(frame.z, every),
               thinned(frame.pressure, every),
               thinned(frame.speed, every),
               frame.outlines,
               frame.walls};
    bytes_ += embedded_bytes(kept);
    frames_.push_back(std::move(kept));
    while (frames_.size() > 2 && (bytes_ > limits_.bytes || frames_.size() > limits_.frames)) {
        std::size_t left = 0;
        for (std::size_t i = 0; i < frames_.size(); i += 2) {
            if (i != left) frames_[left] = std::move(frames_[i]);
            ++left;
        }
        frames_.resize(left);
        stride_ *= 2;
        bytes_ = 0;
        for (const Frame& remaining : frames_) bytes_ += embedded_bytes(remaining);
    }
}

}  // namespace aquagraph::io
