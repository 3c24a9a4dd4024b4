#include "engine/checkpoints.hpp"

#include <limits>

#include "engine/model_state.hpp"
#include "io/checkpoint_file.hpp"

namespace aquagraph::engine {

namespace {

// Everything, in one order.
template <class Archive, int D>
void archive_run(Archive& fields, RunFigures& figures, Results<D>& results, Model<D>& model) {
    fields.section("figures");
    fields(figures);
    fields.section("results");
    fields(results);
    archive(fields, model);
}

}  // namespace

template <int D>
Checkpoints<D>::Checkpoints(const io::Scene& scene, Model<D>& model, Results<D>& results, double minutes,
                            const std::optional<RestartPoint>& from)
    : scene_(scene),
      model_(model),
      results_(results),
      interval_(minutes > 0 ? 60 * minutes : std::numeric_limits<double>::infinity()),
      written_(Clock::now()) {
    // The file that the run goes on from is the last good one.
    const std::filesystem::path first = checkpoint_file(results.folder(), 0);
    if (from && std::filesystem::exists(first) && std::filesystem::equivalent(from->file, first)) next_slot_ = 1;
}

template <int D>
RunFigures Checkpoints<D>::restore(const RestartPoint& from) {
    RunFigures figures;
    io::ArchiveReader fields(from.state);
    try {
        archive_run(fields, figures, results_, model_);
        fields.must_be_at_the_end();
        remake(model_);
    } catch (const std::exception& error) {
        throw io::CheckpointError(from.file.string() + " cannot be used: " + error.what() +
                                  "; go on with that program, or start from the beginning, without --restart");
    }
    results_.resume();
    // Files are cut back: a later checkpoint could not go on with them.
    for (const int slot : {0, 1}) {
        const std::filesystem::path file = checkpoint_file(results_.folder(), slot);
        try {
            if (!std::filesystem::exists(file) || io::read_checkpoint(file).about.at("steps") <= from.steps) continue;
        } catch (const std::exception&) {  // damaged
        }
        std::filesystem::remove(file);
    }
    return figures;
}

template <int D>
bool Checkpoints<D>::is_due() const {
    return Clock::now() - written_ >= interval_;
}

template <int D>
void Checkpoints<D>::write(RunFigures figures) {
    if (model_.clock.steps == 0) return;
    results_.sync();  // rows that the checkpoint counts on
    io::ArchiveWriter fields;
    archive_run(fields, figures, results_, model_);
    io::write_checkpoint(checkpoint_file(results_.folder(), next_slot_),
                         about_run(scene_, model_.clock.time, model_.clock.steps), fields.take());
    next_slot_ = 1 - next_slot_;
    written_ = Clock::now();
}

template class Checkpoints<2>;
template class Checkpoints<3>;

}  // namespace aquagraph::engine
