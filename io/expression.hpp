// Formulas in scene files: "U * sin(2*pi*x/L)", evaluated by muParser, which also names what functions there are
// (sin cos tan asin acos atan atan2 sinh cosh tanh exp ln log10 sqrt abs sign min max …, a ? b : c, ^ for powers).
// Two things come on top: the constant pi, and
//     series(n, from, to, step, term)    the sum of `term` with n = from, from + step, … to
// of whole numbers, written out before the formula is compiled: series solutions fit on a line. They may be nested.
#pragma once
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace aquagraph::io {

// Names with fixed values beside pi: those of [constants].
using Constants = std::map<std::string, double, std::less<>>;

// what(): what is wrong with the formula, and where in it.
class ExpressionError : public std::runtime_error {
  public:
    ExpressionError(const std::string& what, std::string unknown = {})
        : std::runtime_error(what), unknown_(std::move(unknown)) {}
    const std::string& unknown() const { return unknown_; }  // the name that nobody knows, if that is it

  private:
    std::string unknown_;
};

class Expression {
  public:
    // Throws ExpressionError for anything that is not one value made of these variables and constants. A variable that
    // has the name of a constant hides it.
    Expression(std::string_view formula, std::vector<std::string> variables, const Constants& constants = {});
    ~Expression();
    Expression(Expression&&) noexcept;
    Expression& operator=(Expression&&) noexcept;

    // One value per variable, in the order given. May be infinite or no number: 1/0, sqrt(-1). One evaluation at a time
    // per object: different threads need different objects.
    double operator()(std::span<const double> values) const;

    const std::string& text() const { return text_; }

  private:
    struct Compiled;
    std::string text_;
    std::unique_ptr<Compiled> compiled_;
};

// The value of a formula without variables.
double constant_value(std::string_view formula, const Constants& constants);

// Letters, digits and _, beginning with a letter, and not the name of one of the functions or of pi.
bool usable_as_constant(std::string_view name);

}  // namespace aquagraph::io
