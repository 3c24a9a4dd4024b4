// What a checkpoint holds of the model: everything that the coming cycles depend on and that the scene does not say.
#pragma once
#include "engine/model.hpp"
#include "io/archive.hpp"

namespace aquagraph::engine {

// Each part lists its fields in its own archive(), for writing and for reading. A new piece of state goes in there, or
// in here where it belongs to no part.
template <class Archive, int D>
void archive(Archive& fields, Model<D>& model) {
    fields.section("clock");
    fields(model.clock);
    if (model.walls) {
        fields.section("ghost walls");
        fields(*model.walls);
    }
    if (model.flux_walls) {
        fields.section("walls of normal fluxes");
        fields(*model.flux_walls);
    }
    if (model.fluid) {
        fields.section("fluid");
        fields(*model.fluid);
    }
    for (fluid::WallWork<D>& work : model.wall_works) {
        fields.section("work of " + work.name);
        fields(work);
    }
    if (model.interface) {
        fields.section("interface");
        fields(*model.interface, model.cycle_step);
    }
    if (model.solid) {
        fields.section("solid");
        solid::State state;
        if (!fields.reads()) solver_of(model).save(state);
        fields(state);
        if (fields.reads()) solver_of(model).restore(state);
    }
    if (model.structure) {
        fields.section("structure");
        fields(model.structure->step);
    }
    fields.section("end of the model");
}

// After reading: what follows from the state, neighbour lists and what is collected from them.
template <int D>
void remake(Model<D>& model);

}  // namespace aquagraph::engine
