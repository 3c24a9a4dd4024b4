// The [[probe]]s of a scene: where they are now, and what the fluid is there.
#pragma once
#include <vector>

#include "engine/model.hpp"
#include "io/history.hpp"
#include "physics/fluid/probes.hpp"

namespace aquagraph::engine {

// One probe. It keeps what it has measured last, one number per column.
template <int D>
class Probe {
  public:
    // The walls must stand where they begin, their geometry up to date. Throws io::SceneError where the probe is more
    // than a spacing off the wall it names.
    Probe(const io::Scene& scene, std::size_t number, const Model<D>& model);

    std::vector<io::HistoryColumn> columns() const;
    void measure(const Model<D>& model);
    const std::vector<double>& values() const { return values_; }

  private:
    void sit_on_wall(const io::Scene& scene, std::size_t number, const fluid::Panels<D>& panels, double spacing);

    std::string name_;
    io::ProbeQuantity quantity_;
    fluid::Interpolation interpolation_;
    fluid::Vec<D> point_;
    int panel_ = -1;                 // that it sits on …
    std::array<double, D> shape_{};  // … at this place: weights of its vertices
    std::vector<double> values_;
    fluid::PlaceInFluid<D> place_;
    fluid::SurfaceOver<D> surface_;
};

extern template class Probe<2>;
extern template class Probe<3>;

}  // namespace aquagraph::engine
