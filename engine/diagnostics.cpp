#include "engine/diagnostics.hpp"

#include <algorithm>
#include <memory>

#include "engine/probes.hpp"
#include "physics/fluid/gradients.hpp"
#include "physics/fluid/rebuild.hpp"
#include "physics/fluid/walls/wall_forces.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"
#include "tasks/walls.hpp"

namespace aquagraph::engine {

namespace {

namespace resource = tasks::resource;

template <int D>
Diagnostic probes(const io::Scene& scene, const Model<D>& model) {
    // Held by pointer: the graph copies bodies.
    auto all = std::make_shared<std::vector<Probe<D>>>();
    HistoryPart part;
    for (std::size_t k = 0; k < scene.probes.size(); ++k) {
        for (const io::HistoryColumn& column : all->emplace_back(scene, k, model).columns())
            part.columns.push_back(column);
    }
    part.append = [all](std::vector<double>& row) {
        for (const Probe<D>& probe : *all) row.insert(row.end(), probe.values().begin(), probe.values().end());
    };
    return {
        {.name = "probes",
         .reads = {resource::fluid_lists, resource::fluid_state, resource::walls},
         .writes = {},
         .body = [all,
                  &model] { tasks::for_each_block(all->size(), [&](std::size_t k) { (*all)[k].measure(model); }); }},
        part,
        {}};
}

// The water's force on the walls that ask for it, at the end of the cycle: from the state reached there, with ghosts
// and gradients of their own. Nothing that the next step reads is changed.
template <int D>
class WallForcesTask {
  public:
    WallForcesTask(const io::Scene& scene, Model<D>& model) : fluid_(*model.fluid), walls_(*model.walls) {
        for (std::size_t w = 0; w < scene.walls.size(); ++w)
            if (scene.walls[w].force) forces_.emplace_back(int(w));
    }

    void measure() {
        if (fluid_.rebuilds == 0) rebuild_lists(fluid_, &walls_, tasks::parallel_loop);  // before the first step
        tasks::ghost_state(fluid_, walls_, "").body();
        fullness_ = fluid_.particles.fullness;
        for (fluid::WallForces<D>& wall : forces_) {
            wall.rebuild(fluid_, walls_);
            gradients(wall.gradient_clusters());
        }
        tasks::ghost_gradients(fluid_, walls_, "").body();
        for (fluid::WallForces<D>& wall : forces_)
            tasks::for_each_block(wall.blocks(), [&](std::size_t block) { wall.compute(fluid_, block); });
        std::copy(fullness_.begin(), fullness_.end(), fluid_.particles.fullness.begin());
    }

    void archive(io::AnyArchive fields) {
        for (fluid::WallForces<D>& wall : forces_) fields(wall);
    }

    void append(std::vector<double>& row) const {
        for (const fluid::WallForces<D>& wall : forces_) {
            const fluid::Vec<D> force = wall.force();
            row.insert(row.end(), force.begin(), force.end());
        }
    }

  private:
    void gradients(const std::vector<std::uint32_t>& clusters) {
        constexpr std::size_t per_block = 8;
        tasks::for_each_block((clusters.size() + per_block - 1) / per_block, [&](std::size_t block) {
            for (std::size_t k = block * per_block; k < std::min(clusters.size(), (block + 1) * per_block); ++k)
                compute_gradients(fluid_.particles, fluid_.lists, fluid_.kernel,
                                  lanes_of_cluster(fluid_.particles, clusters[k]), fluid_.gradients());
        });
    }

    fluid::Fluid<D>& fluid_;
    fluid::GhostWalls<D>& walls_;
    std::vector<fluid::WallForces<D>> forces_;
    fluid::Scalars fullness_;
};

// The same with walls of normal fluxes: the pressure at their points, and friction where water sticks to them. It is
// what every panel bears by itself; the reaction to the scheme's momentum balance would mix walls that meet in a
// corner.
template <int D>
class FluxWallForcesTask {
  public:
    FluxWallForcesTask(const io::Scene& scene, Model<D>& model)
        : fluid_(*model.fluid), walls_(*model.flux_walls), total_(scene.walls.size()) {
        for (std::size_t w = 0; w < scene.walls.size(); ++w)
            if (scene.walls[w].force) asked_.push_back(w);
    }

    void measure() {
        fluid::Particles<D>& s = fluid_.particles;
        if (fluid_.rebuilds == 0) rebuild_lists(fluid_, walls_, tasks::parallel_loop);  // before the first step
        if (walls_.is_periodic()) tasks::ghost_state(fluid_, walls_.images, "").body();
        fullness_ = s.fullness;
        tasks::for_each_block(fluid_.blocks(), [&](std::size_t block) {
            if (!walls_.has_near_wall(block)) return;
            walls_.compute_gamma(s, fluid_.kernel, block);
            walls_.complete_gradients(s, fluid_.lists, fluid_.kernel, fluid_.flux, block);
        });
        vertex_forces_.assign(walls_.panels.position.size(), fluid::Vec<D>::Zero());
        walls_.add_pressure_forces(s, fluid_.kernel, fluid_.flux, fluid_.viscosity.dynamic, vertex_forces_);
        std::copy(fullness_.begin(), fullness_.end(), s.fullness.begin());
        // No two walls share vertices.
        std::vector<std::uint8_t> counted(vertex_forces_.size(), 0);
        for (fluid::Vec<D>& total : total_) total.setZero();
        for (const fluid::Panel<D>& panel : walls_.panels.panels)
            for (const int v : panel.vertex) {
                if (counted[std::size_t(v)]) continue;
                counted[std::size_t(v)] = 1;
                total_[std::size_t(panel.wall)] += vertex_forces_[std::size_t(v)];
            }
    }

    void archive(io::AnyArchive) {}  // all is found anew

    void append(std::vector<double>& row) const {
        for (const std::size_t w : asked_) row.insert(row.end(), total_[w].begin(), total_[w].end());
    }

  private:
    fluid::Fluid<D>& fluid_;
    fluid::NormalFluxWalls<D>& walls_;
    std::vector<fluid::Vec<D>> total_;
    std::vector<std::size_t> asked_;
    std::vector<fluid::Vec<D>> vertex_forces_;
    fluid::Scalars fullness_;
};

template <int D, class Forces>
Diagnostic wall_forces(const io::Scene& scene, Model<D>& model) {
    auto forces = std::make_shared<Forces>(scene, model);
    HistoryPart part;
    for (const io::WallScene& wall : scene.walls)
        for (std::size_t d = 0; d < D && wall.force; ++d)
            part.columns.push_back({wall.name + "_force_" + "xyz"[d], D == 2 ? "N/m" : "N"});
    part.append = [forces](std::vector<double>& row) { forces->append(row); };
    return {{.name = "wall forces",
             .reads = {resource::fluid_lists, resource::fluid_state, resource::walls},
             .writes = {resource::fluid_ghosts, resource::fluid_gradients, resource::ghost_gradients,
                        resource::fluid_rates, resource::wall_gamma, resource::wall_moments},
             .body = [forces] { forces->measure(); }},
            part,
            [forces](io::AnyArchive fields) { forces->archive(fields); }};
}

}  // namespace

template <int D>
std::vector<Diagnostic> make_diagnostics(const io::Scene& scene, Model<D>& model) {
    std::vector<Diagnostic> all;
    if (!scene.probes.empty()) all.push_back(probes(scene, model));
    const bool forces =
        std::any_of(scene.walls.begin(), scene.walls.end(), [](const io::WallScene& wall) { return wall.force; });
    if (forces && model.flux_walls) all.push_back(wall_forces<D, FluxWallForcesTask<D>>(scene, model));
    if (forces && !model.flux_walls) all.push_back(wall_forces<D, WallForcesTask<D>>(scene, model));
    return all;
}

template std::vector<Diagnostic> make_diagnostics(const io::Scene&, Model<2>&);
template std::vector<Diagnostic> make_diagnostics(const io::Scene&, Model<3>&);

}  // namespace aquagraph::engine
