// Columns of history.csv that sum over the water as the scene asks: [[integral]], [[extreme]], [[field_error]].
// Sums run over the particles in their order in memory, which is the same for any number of threads.
#pragma once
#include <string>
#include <vector>

#include "io/history.hpp"
#include "io/scene.hpp"
#include "physics/fluid/equation_of_state.hpp"
#include "physics/fluid/particles.hpp"

namespace aquagraph::engine {

class FieldColumns {
  public:
    // None where the scene asks for none.
    explicit FieldColumns(const io::Scene& scene);
    ~FieldColumns();
    FieldColumns(FieldColumns&&) noexcept;

    const std::vector<io::HistoryColumn>& columns() const { return columns_; }

    // The key of the scene that asks for a column: "integral[0].name"; empty for another's column.
    std::string key_of(const std::string& column) const;

    // One value per column, added to `row`. Not a number: an extreme or mean of no particle at all, an error that is
    // divided by a norm of zero.
    template <int D>
    void append(const fluid::Particles<D>& particles, const fluid::Tait& tait, double time, std::vector<double>& row);

  private:
    struct Integral;
    struct Extreme;
    struct FieldError;
    std::vector<io::HistoryColumn> columns_;
    std::vector<std::string> keys_;  // of the columns
    std::vector<Integral> integrals_;
    std::vector<Extreme> extremes_;
    std::vector<FieldError> errors_;
};

}  // namespace aquagraph::engine
