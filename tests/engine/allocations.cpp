// A cycle that neither rebuilds lists nor factorises asks for no memory.
#include <doctest/doctest.h>

#include "tasks/task_graph.hpp"
#include "tests/engine/allocation_count.hpp"
#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

struct Steady {
    int cycles = 0;        // without a rebuild or a factorisation
    long allocations = 0;  // in these
    long elsewhere = 0;    // in the other cycles: what the counter sees at all
};

Steady count_in_cycles(const std::string& text, int cycles) {
    Built built(with(text, "end = 0.", "end = 10."));  // as many cycles as wanted
    built.start();
    engine::Model<2>& model = *built.model;
    tasks::TaskGraph graph(std::move(built.listing), built.executor);
    // Arrays find their size, threads make their buffers.
    for (int cycle = 0; cycle < 10; ++cycle) graph.run();
    Steady steady;
    const auto factorisations = [&] { return model.solid ? model.solid->statistics().factorisations : 0; };
    for (int cycle = 0; cycle < cycles; ++cycle) {
        const long rebuilds = model.fluid->rebuilds, factorised = factorisations(), before = allocations();
        graph.run();
        const long made = allocations() - before;
        if (model.fluid->rebuilds != rebuilds || factorisations() != factorised) {
            steady.elsewhere += made;
            continue;
        }
        ++steady.cycles;
        steady.allocations += made;
    }
    return steady;
}

}  // namespace

TEST_CASE("a steady cycle allocates nothing") {
    const long before = allocations();
    {
        std::vector<double> one(100);
        aquagraph::AlignedVector<double> other(100);
    }
    REQUIRE(allocations() >= before + 2);  // the counter counts

    for (const auto& [name, text] :
         {std::pair{"gate, CPS", with_coupling(gate, "cps", 1)},
          std::pair{"gate, CSS, p = 3", with_coupling(gate, "css", 3)},
          std::pair{"gate, energy conservative", with(gate, "ratio = 1", "load = \"energy_conservative\"")},
          std::pair{"gate, averaged pressure", with(gate, "ratio = 1", "load = \"averaged_pressure\"")},
          std::pair{"column", column}}) {
        CAPTURE(name);
        const Steady steady = count_in_cycles(text, 60);
        INFO(steady.cycles, " steady cycles, ", steady.elsewhere, " allocations in the others");
        CHECK(steady.cycles >= 10);
        CHECK(steady.allocations == 0);
    }
}
