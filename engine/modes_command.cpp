#include "engine/modes_command.hpp"

#include <fmt/format.h>

#include <ostream>
#include <string>

#include "engine/body_parts.hpp"
#include "engine/frames.hpp"
#include "io/atomic_file.hpp"
#include "io/scene_reader.hpp"
#include "io/series.hpp"
#include "tasks/executor.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::engine {

namespace {

void remove_old_modes(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("mode_") && name.ends_with(".hdf")) std::filesystem::remove(entry.path());
    }
}

template <int D>
void write_modes(const std::filesystem::path& folder, const solid::Solver<D>& solver,
                 const std::vector<solid::NaturalMode>& modes) {
    io::make_folder(folder);
    remove_old_modes(folder);
    std::string table =
        "mode,frequency[Hz],eigenvalue[1/s2],mass_x,mass_y" + std::string(D == 3 ? ",mass_z" : "") + "\n";
    io::FrameSeries series(folder / "modes.hdf.series");
    for (std::size_t k = 0; k < modes.size(); ++k) {
        const int number = int(k) + 1;
        table += fmt::format("{},{},{}", number, modes[k].frequency, modes[k].eigenvalue);
        for (std::size_t d = 0; d < D; ++d) table += fmt::format(",{}", modes[k].mass_fraction[d]);
        table += "\n";
        const std::string name = io::frame_name("mode", number);
        write_mode_frame(folder / name, solver, modes[k], number);
        series.add(name, number);
    }
    io::write_file_atomically(folder / "modes.csv", table);
}

template <int D>
ExitCode modes_in(const io::Scene& scene, const ModesOptions& options, std::ostream& out, std::ostream& err) {
    tasks::Executor executor(options.threads);
    Model<D> model;
    if (scene.fluid)
        model.solid = make_solid<D>(scene);
    else
        make_structure(scene, model);
    std::vector<solid::NaturalMode> modes;
    try {
        executor.execute([&] {
            static_start(scene, model);
            if (model.structure && model.structure->is_static) {
                sum_at(model.structure->loads, scene.end_time, model.structure->forces);
                model.solid->set_time(scene.end_time);
                model.solid->solve_static(model.structure->forces, tasks::parallel_loop);
            }
            modes = model.solid->natural_modes(options.count, tasks::parallel_loop);
        });
    } catch (const solid::ConvergenceError& error) {
        err << "aquagraph: " << error.what() << "\n";
        return run_failed;
    } catch (const std::invalid_argument& error) {
        throw io::scene_error(scene, "solid", error.what(), "give another --count, or more elements");
    }
    const std::filesystem::path folder =
        options.folder.empty() ? std::filesystem::path("results") / scene.name : options.folder;
    write_modes(folder, *model.solid, modes);

    double farthest = 0;
    for (const double u : model.solid->displacements()) farthest = std::max(farthest, std::abs(u));
    out << fmt::format(
        "{}: {} natural modes about {}\n", scene.title, modes.size(),
        farthest > 0 ? fmt::format("an equilibrium with displacements up to {:.4g} m", farthest) : "the body as drawn");
    out << fmt::format("{:>5} {:>14} {:>14}   {}\n", "mode", "frequency [Hz]", "period [s]",
                       D == 2 ? "share of the mass along x, y" : "share of the mass along x, y, z");
    for (std::size_t k = 0; k < modes.size(); ++k) {
        std::string shares;
        for (std::size_t d = 0; d < D; ++d) shares += fmt::format(" {:>6.1f} %", 100 * modes[k].mass_fraction[d]);
        out << fmt::format("{:>5} {:>14.6g} {:>14.6g}   {}{}\n", k + 1, modes[k].frequency, 1 / modes[k].frequency,
                           shares, modes[k].frequency < -modes.back().frequency * 1e-3 ? "   unstable" : "");
    }
    out << "shapes and modes.csv in " << folder.string() << "\n";
    return success;
}

}  // namespace

ExitCode modes(const io::Scene& scene, const ModesOptions& options, std::ostream& out, std::ostream& err) {
    if (!scene.solid)
        throw io::scene_error(scene, "fluid", "there is no body in this scene whose modes could be found",
                              "add [solid]");
    return scene.dimension == 3 ? modes_in<3>(scene, options, out, err) : modes_in<2>(scene, options, out, err);
}

}  // namespace aquagraph::engine
