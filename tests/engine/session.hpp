// A run in pieces: so many cycles, a checkpoint, on to the end, as engine/run.cpp does it in one go.
#pragma once
#include <limits>
#include <memory>
#include <sstream>

#include "engine/checkpoints.hpp"
#include "engine/cycle_graphs.hpp"
#include "engine/listings.hpp"
#include "engine/model_state.hpp"
#include "tests/engine/results_of_run.hpp"

namespace aquagraph::test {

template <int D>
class Session {
  public:
    io::Scene scene;
    tasks::Executor executor;
    std::unique_ptr<engine::Model<D>> model;
    engine::Results<D> results;
    engine::Checkpoints<D> checkpoints;
    engine::CycleGraphs<D> graphs;
    long cycles = 0;

    Session(const std::filesystem::path& file, const std::filesystem::path& folder, int threads,
            const std::optional<engine::RestartPoint>& from = {})
        : scene(io::read_scene(file)),
          executor(threads),
          model(engine::make_model<D>(scene)),
          results(scene, *model, folder, from.has_value()),
          checkpoints(scene, *model, results, 0, from),
          graphs(*model, scene, results, executor, nullptr) {
        if (from) {
            executor.execute([&] { checkpoints.restore(*from); });
            return;
        }
        executor.execute([&] {
            engine::start(*model, scene);
            for (const tasks::Task& task : engine::first_evaluation(*model)) task.body();
            results.measure();
        });
        results.history_if_due();
        results.frame_if_due();
    }

    void run(long most = std::numeric_limits<long>::max()) {
        for (long k = 0; k < most && model->clock.time < model->clock.end * (1 - 1e-12); ++k, ++cycles) graphs.run();
        results.sync();
    }

    // Of everything that goes on.
    std::string state() {
        io::ArchiveWriter fields;
        engine::archive(fields, *model);
        fields(results);
        return fields.take();
    }
};

// History, list of frames and the numbers of all frames.
inline std::string results_of(const ResultsFolder& folder) {
    std::string all = contents(folder.path / "history.csv");
    for (const std::string stem : {"fluid", "solid"}) {
        if (!std::filesystem::exists(folder.path / (stem + ".hdf.series"))) continue;
        all += contents(folder.path / (stem + ".hdf.series"));
        for (const FrameOnDisk& frame : folder.frames(stem))
            all += numbers_of(folder.open(frame),
                              {"VTKHDF/Points", "VTKHDF/PointData/velocity",
                               stem == "fluid" ? "VTKHDF/PointData/pressure" : "VTKHDF/PointData/displacement"});
        all += std::to_string(folder.frames_on_disk(stem));
    }
    return all;
}

}  // namespace aquagraph::test
