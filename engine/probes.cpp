#include "engine/probes.hpp"

#include <fmt/format.h>

#include <limits>

#include "io/scene_reader.hpp"

namespace aquagraph::engine {

template <int D>
Probe<D>::Probe(const io::Scene& scene, std::size_t number, const Model<D>& model) {
    const io::ProbeScene& from = scene.probes[number];
    name_ = from.name;
    quantity_ = from.quantity;
    interpolation_ = from.interpolation == io::ProbeInterpolation::linear ? fluid::Interpolation::linear
                                                                          : fluid::Interpolation::shepard;
    for (int d = 0; d < D; ++d) point_[d] = from.point[std::size_t(d)];
    if (!from.wall.empty()) sit_on_wall(scene, number, panels_of(model), scene.fluid->spacing);
    values_.assign(columns().size(), 0.0);
}

template <int D>
void Probe<D>::sit_on_wall(const io::Scene& scene, std::size_t number, const fluid::Panels<D>& panels, double spacing) {
    const std::string& wall = scene.probes[number].wall;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < panels.size(); ++k) {
        if (panels.name(k) != wall) continue;
        const auto shape = panels.shape_functions_on(k, point_);
        fluid::Vec<D> foot = fluid::Vec<D>::Zero();
        for (std::size_t v = 0; v < D; ++v) foot += shape[v] * panels.vertex(k, v);
        const double distance = (point_ - foot).norm();
        if (distance >= least) continue;
        least = distance;
        panel_ = int(k);
        shape_ = shape;
    }
    if (!(least <= spacing))
        throw io::scene_error(scene, fmt::format("probe[{}].point", number),
                              fmt::format("the probe '{}' is {:.4g} m away from wall '{}'", name_, least, wall),
                              "put it on the wall, or take `wall` out");
}

template <int D>
std::vector<io::HistoryColumn> Probe<D>::columns() const {
    if (quantity_ == io::ProbeQuantity::pressure) return {{name_ + "_pressure", "Pa"}};
    if (quantity_ == io::ProbeQuantity::level) return {{name_ + "_level", "m"}};
    std::vector<io::HistoryColumn> columns;
    for (std::size_t d = 0; d < D; ++d) columns.push_back({name_ + "_velocity_" + "xyz"[d], "m/s"});
    return columns;
}

template <int D>
void Probe<D>::measure(const Model<D>& model) {
    const fluid::Fluid<D>& fluid = *model.fluid;
    if (quantity_ == io::ProbeQuantity::level) {
        std::array<double, D> foot;
        for (std::size_t d = 0; d < D; ++d) foot[d] = point_[int(d)];
        values_[0] = surface_.height(fluid, foot);
        return;
    }
    fluid::Vec<D> x = point_;
    std::optional<fluid::Vec<D>> side;
    if (panel_ >= 0) {
        const fluid::Panels<D>& panels = panels_of(model);
        const auto k = std::size_t(panel_);
        x.setZero();
        for (std::size_t v = 0; v < D; ++v) x += shape_[v] * panels.vertex(k, v);
        side = panels.normal[k];
    }
    place_.look(fluid, x, side, interpolation_);
    if (quantity_ == io::ProbeQuantity::pressure)
        values_[0] = place_.of(fluid.particles.p);
    else
        for (std::size_t d = 0; d < D; ++d) values_[d] = place_.of(fluid.particles.v[d]);
}

template class Probe<2>;
template class Probe<3>;

}  // namespace aquagraph::engine
