#include "physics/solid/calculix_export.hpp"

#include <cmath>
#include <map>
#include <stdexcept>

namespace aquagraph::solid {

namespace {

std::string element_type(int dimension, std::size_t nodes, const PlaneCondition plane, Integration integration,
                         LinearElements linear) {
    const std::string reduced = integration == Integration::reduced ? "R" : "";
    if (dimension == 2) {
        if (nodes == 4)
            throw std::invalid_argument(
                "CalculiX has no equal of linear quadrilaterals with enhanced strains: take "
                "quadratic ones");
        return (plane == PlaneCondition::strain ? "CPE8" : "CPS8") + reduced;
    }
    if (nodes == 8) return linear == LinearElements::enhanced ? "C3D8I" : "C3D8";
    return nodes == 10 ? "C3D10" : "C3D20" + reduced;
}

void write_material(std::ostream& deck, const Material& material, const std::string& name) {
    if (!material.cords.empty()) throw std::invalid_argument("CalculiX has no equal of cords in rubber");
    deck << "*MATERIAL, NAME=" << name << "\n";
    const double E = material.youngs_modulus, nu = material.poissons_ratio;
    switch (material.law) {
        case MaterialLaw::saint_venant_kirchhoff:
        case MaterialLaw::linear:
            deck << "*ELASTIC\n" << E << ", " << nu << "\n";
            break;
        case MaterialLaw::neo_hookean:  // C10 = µ/2, D1 = 2/κ
            deck << "*HYPERELASTIC, NEO HOOKE\n" << E / (4 * (1 + nu)) << ", " << 6 * (1 - 2 * nu) / E << "\n";
            break;
        case MaterialLaw::mooney_rivlin:
            deck << "*HYPERELASTIC, MOONEY-RIVLIN\n"
                 << material.c10 << ", " << material.c01 << ", " << 2 / material.bulk_modulus << "\n";
            break;
        default:
            throw std::invalid_argument("CalculiX has no equal of this material law");
    }
    deck << "*DENSITY\n" << material.density << "\n";
}

// Numbers from 1, sixteen on a line.
template <class List>
void write_numbers(std::ostream& deck, const List& list) {
    std::size_t k = 0;
    for (const int index : list) deck << index + 1 << (++k % 16 == 0 || k == list.size() ? "\n" : ", ");
}

template <int D>
class DeckWriter {
  public:
    DeckWriter(std::ostream& deck, const Mesh<D>& mesh, const Options<D>& options, const CalculixRun& run)
        : deck_(deck), mesh_(mesh), options_(options), run_(run) {}

    void everything() {
        body();
        deck_ << "*NSET, NSET=PRINTED\n";
        if (run_.printed.empty())
            deck_ << "ALL\n";
        else
            write_numbers(deck_, run_.printed);
        amplitudes();
        if (run_.static_start && !run_.is_static) step(true, 1, 1, false);
        step(run_.is_static, run_.step, run_.end, true);
    }

    // The body and a static step, from whose restart file others go on.
    void start(std::span<const double> forces, bool under_gravity) {
        if (D == 2 && options_.plane == PlaneCondition::stress)
            throw std::invalid_argument("a body that CalculiX takes step by step must be in plane strain, or in space");
        // ccx finds the first accelerations with all the integration points of the mass. Elements whose stresses have
        // fewer then start every step out of balance, and swing up.
        for (const auto& element : mesh_.elements)
            if (element.size() != (D == 2 ? 8 : 20) || options_.integration != Integration::full)
                throw std::invalid_argument(
                    "step by step CalculiX takes quadratic quadrilaterals and hexahedra with integration = \"full\"");
        slab_ = D == 2;
        body();
        // "*STEP, AMPLITUDE" makes the names of amplitudes that later steps ask for.
        begin_step("RAMP");
        deck_ << "*STATIC\n1, 1\n";
        controls();
        deck_ << "*CLOAD\n";
        point_loads(forces, forces);
        if (under_gravity) gravity("");
        print_state();
    }

    void next_step(const CalculixStep& step) {
        deck_.precision(13);
        deck_ << "*RESTART, READ\n";
        begin_step(step.first ? "STEP" : "RAMP");
        deck_ << "*DYNAMIC, DIRECT, ALPHA=" << options_.alpha << "\n" << step.size << ", " << step.size << "\n";
        controls();
        deck_ << "*CLOAD\n";
        point_loads(step.forces, step.forces_before);
        if (step.first) gravity("");
        print_state();
    }

  private:
    void body() {
        if (D == 2)
            (void)element_type(D, mesh_.elements[0].size(), options_.plane, options_.integration,
                               options_.linear_elements);
        if (options_.scheme == Scheme::newmark && options_.alpha != 0 && !run_.is_static)
            throw std::invalid_argument(
                "CalculiX has no Newmark scheme without weighted forces: take hht, or alpha = 0");
        if (options_.scheme == Scheme::central_difference && !run_.is_static)
            throw std::invalid_argument("central differences are not exported: take hht");
        if (!options_.motions.empty() || !options_.rigid_bodies.empty() || !options_.pressures.empty() ||
            !options_.contacts.empty() || options_.mass_damping > 0 || options_.stiffness_damping > 0)
            throw std::invalid_argument(
                "prescribed motions, rigid bodies, pressures, contacts and damping are not exported to CalculiX");
        deck_.precision(13);  // ccx reads fields of twenty characters, a sign and an exponent among them
        deck_ << "*HEADING\n" << run_.title << "\n";
        if (slab_)
            slab();
        else
            nodes_and_elements();
        materials();
        for (std::size_t k = 0; k < options_.clamps.size(); ++k) {
            deck_ << "*NSET, NSET=CLAMP" << k + 1 << "\n";
            write_numbers(deck_, mesh_.node_set(options_.clamps[k].set));
            deck_ << "*BOUNDARY\n";
            for (std::size_t d = 0; d < D; ++d)
                if (options_.clamps[k].fixed[d]) deck_ << "CLAMP" << k + 1 << ", " << d + 1 << ", " << d + 1 << "\n";
        }
    }

    void begin_step(const char* amplitude) {
        deck_ << "*STEP, INC=1000" << (nonlinear() ? ", NLGEOM" : "") << ", AMPLITUDE=" << amplitude << "\n";
    }

    // Equilibrium to rounding, as here, instead of to half a per cent: residual and correction, relative.
    void controls() { deck_ << "*CONTROLS, PARAMETERS=FIELD\n1e-9, 1e-8\n"; }

    // A force that has gone must be told so.
    void point_loads(std::span<const double> forces, std::span<const double> before) {
        for (std::size_t f = 0; f < forces.size(); ++f)
            if (forces[f] != 0 || (!before.empty() && before[f] != 0))
                deck_ << f / D + 1 << ", " << f % D + 1 << ", " << forces[f] << "\n";
    }

    void gravity(const char* parameters) {
        double g = 0;
        for (const double component : options_.gravity) g += component * component;
        if (g == 0) return;
        g = std::sqrt(g);
        deck_ << "*DLOAD" << parameters << "\nBODY, GRAV, " << g;
        for (const double component : options_.gravity) deck_ << ", " << component / g;
        deck_ << (D == 2 ? ", 0\n" : "\n");
    }

    void print_state() {
        deck_ << "*NODE PRINT, NSET=ALL\nU, V\n";
        energies();
        deck_ << "*RESTART, WRITE, FREQUENCY=1\n*END STEP\n";
    }

    // A motion after a static step needs them: they cannot be computed unless they are asked for in the first step.
    void energies() { deck_ << "*EL PRINT, ELSET=BODY, TOTALS=ONLY\nELSE\n"; }

    bool nonlinear() const {
        bool any = options_.material.law != MaterialLaw::linear;
        for (const Part& part : options_.parts) any = any || part.material.law != MaterialLaw::linear;
        return any;
    }

    void nodes_and_elements() {
        deck_ << "*NODE, NSET=ALL\n";
        for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
            deck_ << n + 1;
            for (const double x : mesh_.nodes[n]) deck_ << ", " << x;
            deck_ << (D == 2 ? ", 0\n" : "\n");
        }
        deck_ << "*ELEMENT, ELSET=BODY, TYPE="
              << element_type(D, mesh_.elements[0].size(), options_.plane, options_.integration,
                              options_.linear_elements)
              << "\n";
        for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
            deck_ << e + 1;
            std::size_t k = 0;
            for (const NodeIndex a : mesh_.elements[e]) deck_ << (++k % 11 == 0 ? ",\n" : ", ") << a + 1;
            deck_ << "\n";
        }
    }

    // ccx makes solid elements of plane ones, and prints no velocities at most of their nodes. So here it gets a slab,
    // one element deep, whose nodes move alike across its depth: those at z = 0 have the numbers of the plane's.
    void slab() {
        const std::size_t n = mesh_.nodes.size();
        std::vector<bool> corner(n, false);
        for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
            for (std::size_t k = 0; k < 4; ++k) corner[std::size_t(mesh_.elements[e][k])] = true;
        const auto node = [&](std::size_t number, std::size_t a, double z) {
            deck_ << number << ", " << mesh_.nodes[a][0] << ", " << mesh_.nodes[a][1] << ", " << z << "\n";
        };
        deck_ << "*NODE, NSET=ALL\n";
        for (std::size_t a = 0; a < n; ++a) node(a + 1, a, 0);
        deck_ << "*NODE, NSET=BEHIND\n";
        for (std::size_t a = 0; a < n; ++a) node(n + a + 1, a, options_.thickness);
        for (std::size_t a = 0; a < n; ++a)
            if (corner[a]) node(2 * n + a + 1, a, 0.5 * options_.thickness);
        deck_ << "*ELEMENT, ELSET=BODY, TYPE=C3D20" << (options_.integration == Integration::reduced ? "R" : "")
              << "\n";
        for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
            deck_ << e + 1;
            std::size_t entries = 0;
            const auto row = [&](std::size_t from, std::size_t layer) {
                for (std::size_t k = from; k < from + 4; ++k)
                    deck_ << (++entries % 11 == 0 ? ",\n" : ", ") << layer * n + std::size_t(mesh_.elements[e][k]) + 1;
            };
            row(0, 0);
            row(0, 1);
            row(4, 0);
            row(4, 1);
            row(0, 2);
            deck_ << "\n";
        }
        deck_ << "*BOUNDARY\nALL, 3, 3\nBEHIND, 3, 3\n*EQUATION\n";
        for (std::size_t layer = 1; layer <= 2; ++layer)
            for (std::size_t a = 0; a < n; ++a)
                for (int d = 1; d <= 2; ++d)
                    if (layer == 1 || corner[a])
                        deck_ << "2\n" << layer * n + a + 1 << ", " << d << ", 1, " << a + 1 << ", " << d << ", -1\n";
    }

    // An element in several parts is of the last.
    void materials() {
        std::vector<std::size_t> part_of(mesh_.elements.size(), 0);
        for (std::size_t p = 0; p < options_.parts.size(); ++p)
            for (const ElementIndex e : mesh_.element_set(options_.parts[p].set)) part_of[std::size_t(e)] = p + 1;
        for (std::size_t p = 0; p <= options_.parts.size(); ++p) {
            std::vector<int> members;
            for (std::size_t e = 0; e < part_of.size(); ++e)
                if (part_of[e] == p) members.push_back(int(e));
            if (members.empty()) continue;
            const std::string number = std::to_string(p);
            write_material(deck_, p == 0 ? options_.material : options_.parts[p - 1].material, "MATERIAL" + number);
            deck_ << "*ELSET, ELSET=PART" << number << "\n";
            write_numbers(deck_, members);
            deck_ << "*SOLID SECTION, ELSET=PART" << number << ", MATERIAL=MATERIAL" << number << "\n";
            if (D == 2 && !slab_) deck_ << options_.thickness << "\n";
        }
    }

    // The factors at the ends of the steps, between which ccx draws straight lines.
    void amplitudes() {
        for (std::size_t k = 0; k < run_.loads.size(); ++k) {
            if (!run_.loads[k].factor) continue;
            deck_ << "*AMPLITUDE, NAME=FACTOR" << k + 1 << "\n";
            const long steps = std::lround(std::ceil(run_.end / run_.step * (1 - 1e-9)));
            for (long s = 0; s <= steps; ++s) {
                const double t = run_.end * double(s) / double(steps);
                deck_ << t << ", " << run_.loads[k].factor(t) << "\n";
            }
        }
    }

    void step(bool is_static, double dt, double end, bool printed) {
        deck_ << "*STEP, INC=1000000" << (nonlinear() ? ", NLGEOM" : "") << "\n";
        if (is_static)
            deck_ << "*STATIC\n";
        else
            deck_ << "*DYNAMIC, DIRECT, ALPHA=" << options_.alpha << "\n";
        deck_ << dt << ", " << end << "\n";
        controls();
        const std::size_t loads = !printed && run_.unloaded_start ? 0 : run_.loads.size();
        for (std::size_t k = 0; k < loads; ++k) {
            const DeadLoad& load = run_.loads[k];
            const bool in_time = static_cast<bool>(load.factor) && printed;
            const double factor = load.factor && !printed ? load.factor(0) : 1;
            deck_ << "*CLOAD" << (k == 0 ? ", OP=NEW" : "");
            if (in_time) deck_ << ", AMPLITUDE=FACTOR" << k + 1;
            deck_ << "\n";
            for (std::size_t f = 0; f < load.forces.size(); ++f)
                if (load.forces[f] != 0)
                    deck_ << f / D + 1 << ", " << f % D + 1 << ", " << factor * load.forces[f] << "\n";
        }
        gravity(", OP=NEW");
        if (!printed) energies();
        if (printed) deck_ << "*NODE PRINT, NSET=PRINTED, FREQUENCY=" << run_.print_every << "\nU\n";
        deck_ << "*END STEP\n";
    }

    std::ostream& deck_;
    const Mesh<D>& mesh_;
    const Options<D>& options_;
    const CalculixRun run_;
    bool slab_ = false;
};

}  // namespace

template <int D>
void write_calculix(std::ostream& deck, const Mesh<D>& mesh, const Options<D>& options, const CalculixRun& run) {
    DeckWriter<D>(deck, mesh, options, run).everything();
}

template <int D>
void write_calculix_start(std::ostream& deck, const Mesh<D>& mesh, const Options<D>& options,
                          std::span<const double> forces, bool under_gravity) {
    CalculixRun run;
    run.title = "start";
    DeckWriter<D>(deck, mesh, options, run).start(forces, under_gravity);
}

template <int D>
void write_calculix_step(std::ostream& deck, const Mesh<D>& mesh, const Options<D>& options, const CalculixStep& step) {
    DeckWriter<D>(deck, mesh, options, {}).next_step(step);
}

#define AQUAGRAPH_INSTANTIATE(D)                                                                                  \
    template void write_calculix(std::ostream&, const Mesh<D>&, const Options<D>&, const CalculixRun&);           \
    template void write_calculix_start(std::ostream&, const Mesh<D>&, const Options<D>&, std::span<const double>, \
                                       bool);                                                                     \
    template void write_calculix_step(std::ostream&, const Mesh<D>&, const Options<D>&, const CalculixStep&);
AQUAGRAPH_INSTANTIATE(2)
AQUAGRAPH_INSTANTIATE(3)
#undef AQUAGRAPH_INSTANTIATE

}  // namespace aquagraph::solid
