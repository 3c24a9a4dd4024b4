// The model of a scene to be looked at: built only, or with its listing run to the end.
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/diagnostics.hpp"
#include "engine/listings.hpp"
#include "engine/model.hpp"
#include "tasks/executor.hpp"
#include "tests/engine/results_of_run.hpp"

namespace aquagraph::test {

// A scene built but not run: its parts and the listing of a cycle, to be looked at or run task by task.
struct Built {
    ScratchFolder folder;
    io::Scene scene;
    std::unique_ptr<engine::Model<2>> model;
    std::vector<tasks::Task> listing;
    tasks::Executor executor;

    explicit Built(const std::string& text, int threads = 2)
        : scene(io::read_scene(folder.write("scene.toml", text))),
          model(engine::make_model<2>(scene)),
          listing(engine::coupling_cycle(*model, scene.coupling)),
          executor(threads) {}

    void start() {
        executor.execute([&] { engine::start(*model, scene); });
    }
    std::size_t place(const std::string& name) const {
        for (std::size_t k = 0; k < listing.size(); ++k)
            if (listing[k].name == name) return k;
        throw std::out_of_range("no task '" + name + "' in the listing");
    }
    bool has(const std::string& name) const {
        for (const tasks::Task& task : listing)
            if (task.name == name) return true;
        return false;
    }
    void run(const std::string& name) {
        executor.execute([&] { listing[place(name)].body(); });
    }
    // The fluid's load on the solid as things stand: no step is made.
    void compute_loads() {
        for (const char* name : {"neighbour search (step 1)", "wall motion (interface)", "ghosts (interface)",
                                 "gradients (interface)", "ghost gradients (interface)", "interface loads"})
            run(name);
    }
};

// A scene whose listing has run to its end, task by task.
template <int D>
struct ModelRun {
    ScratchFolder folder;
    io::Scene scene;
    std::unique_ptr<engine::Model<D>> model;
    std::vector<engine::Diagnostic> diagnostics;
    tasks::Executor executor{2};

    explicit ModelRun(const std::string& text, const FilesBeside& files = {}) : scene(read(text, files)) {
        model = engine::make_model<D>(scene);
        diagnostics = engine::make_diagnostics(scene, *model);
        const auto listing = engine::coupling_cycle(*model, scene.coupling);
        executor.execute([&] {
            engine::start(*model, scene);
            for (const tasks::Task& task : engine::first_evaluation(*model)) task.body();
            while (model->clock.time < model->clock.end)
                for (const tasks::Task& task : listing) task.body();
            for (const engine::Diagnostic& diagnostic : diagnostics) diagnostic.task.body();
        });
    }
    std::size_t count() const { return model->fluid->particles.count; }
    geometry::Vec<D> x(std::size_t i) const {
        geometry::Vec<D> place;
        for (std::size_t d = 0; d < D; ++d) place[int(d)] = model->fluid->particles.x[d][i];
        return place;
    }
    double fastest() const {
        const auto& s = model->fluid->particles;
        double v2 = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            double sum = 0;
            for (std::size_t d = 0; d < D; ++d) sum += s.v[d][i] * s.v[d][i];
            v2 = std::max(v2, sum);
        }
        return std::sqrt(v2);
    }
    // Columns of the diagnostics at the end.
    std::vector<double> row() const {
        std::vector<double> row;
        for (const engine::Diagnostic& diagnostic : diagnostics) diagnostic.part.append(row);
        return row;
    }

  private:
    io::Scene read(const std::string& text, const FilesBeside& files) {
        for (const auto& [name, content] : files) folder.write(name, content);
        return io::read_scene(folder.write("scene.toml", text));
    }
};

}  // namespace aquagraph::test
