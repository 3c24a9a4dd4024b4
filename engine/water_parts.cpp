#include "engine/water_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <span>

#include "engine/water_places.hpp"
#include "io/scene_reader.hpp"
#include "io/scene_surfaces.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::engine {

namespace {

template <int D>
geometry::Vec<D> vec(const io::Point& point) {
    geometry::Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = point[std::size_t(d)];
    return x;
}

template <int D>
class Filling {
  public:
    explicit Filling(const io::Scene& scene) : scene_(scene), from_(*scene.fluid) {
        level_ = io::surface_level(from_, D);
        for (std::size_t i = 0; i < from_.boxes.size(); ++i) box(from_.boxes[i], fmt::format("fluid.box[{}]", i));
        for (const io::RegionScene& region : from_.regions) add(region);
    }

    std::vector<fluid::Water<D>> water;
    std::vector<FilledBody> bodies;
    std::vector<fluid::Region<D>> regions;  // one for each body

  private:
    void box(const io::WaterBox& box, const std::string& key) {
        const fluid::FillBox<D> shape{box.min.as<D>(), box.max.as<D>()};
        const bool hydrostatic = from_.initial_pressure == io::InitialPressure::hydrostatic;
        fluid::Region<D> region{geometry::box<D>(vec<D>(box.min), vec<D>(box.max), geometry::FluidSide::outside), 0,
                                std::nullopt};
        keep(key, places_in(shape, from_.spacing), std::move(region), box.velocity, hydrostatic);
    }

    void add(const io::RegionScene& from) {
        fluid::Region<D> region{io::region_surface<D>(from, from_.spacing), from.clearance * from_.spacing, from.level};
        fluid::Places<D> places =
            from_.relax ? full_places_in(region, from_.spacing) : places_in(region, from_.spacing);
        if (places.x.empty())
            throw io::scene_error(scene_, from.key, "this body of water is too thin for a single particle",
                                  "make it larger or the spacing smaller");
        fluid::RelaxationResult relaxation;
        if (from_.relax)
            relaxation = relax(places, region, from_.spacing, from_.support_ratio * from_.spacing,
                               from_.relax_tolerance, tasks::parallel_loop);
        keep(from.key, std::move(places), std::move(region), from.velocity, io::is_hydrostatic(from, from_));
        bodies.back().relaxed = from_.relax;
        bodies.back().relaxation = relaxation;
    }

    void keep(const std::string& key, fluid::Places<D> places, fluid::Region<D> region, const io::Point& velocity,
              bool hydrostatic) {
        bodies.push_back({.key = key,
                          .volume = region.volume(),
                          .filled = places.volume * double(places.x.size()),
                          .particles = places.x.size(),
                          .relaxed = false,
                          .relaxation = {}});
        water.push_back({.places = std::move(places),
                         .velocity = vec<D>(velocity),
                         .surface_level = hydrostatic ? std::optional(level_) : std::nullopt});
        regions.push_back(std::move(region));
    }

    const io::Scene& scene_;
    const io::FluidScene& from_;
    double level_;
};

}  // namespace

template <int D>
std::vector<FilledBody> fill_with_water(const io::Scene& scene, const fluid::Tait& tait,
                                        fluid::Particles<D>& particles) {
    Filling<D> filling(scene);
    std::vector<std::string> keys;
    for (const FilledBody& body : filling.bodies) keys.push_back(body.key);
    refuse_overlapping_water<D>(scene, keys, filling.regions, filling.water);
    refuse_water_behind_walls<D>(scene, keys, filling.water);
    fill<D>(particles, filling.water, tait, -scene.gravity[D - 1]);
    return std::move(filling.bodies);
}

template std::vector<FilledBody> fill_with_water(const io::Scene&, const fluid::Tait&, fluid::Particles<2>&);
template std::vector<FilledBody> fill_with_water(const io::Scene&, const fluid::Tait&, fluid::Particles<3>&);

}  // namespace aquagraph::engine
