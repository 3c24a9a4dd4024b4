#include "io/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace aquagraph::io {
namespace {

// More than any series needs; beyond it a slip of the pen would fill the memory.
constexpr std::size_t longest_formula = 1'000'000;

bool part_of_a_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool is_name(std::string_view text) {
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) == 0 &&
           std::all_of(text.begin(), text.end(), part_of_a_name);
}

std::string_view trimmed(std::string_view text) {
    const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

// Where `name` stands as a whole word, from `begin` on.
std::size_t find_word(std::string_view text, std::string_view name, std::size_t begin = 0) {
    for (std::size_t at = text.find(name, begin); at != std::string_view::npos; at = text.find(name, at + 1)) {
        const bool starts = at == 0 || (!part_of_a_name(text[at - 1]) && text[at - 1] != '.');
        const std::size_t end = at + name.size();
        if (starts && (end == text.size() || !part_of_a_name(text[end]))) return at;
    }
    return std::string_view::npos;
}

std::string with_word_replaced(std::string_view text, std::string_view name, std::string_view replacement) {
    std::string result;
    std::size_t done = 0;
    for (std::size_t at = find_word(text, name); at != std::string_view::npos; at = find_word(text, name, done)) {
        result += text.substr(done, at - done);
        result += replacement;
        done = at + name.size();
    }
    return result += text.substr(done);
}

// The arguments between the bracket at `open` and the one that closes it; `end` becomes the place behind that.
std::vector<std::string_view> arguments(std::string_view text, std::size_t open, std::size_t& end) {
    std::vector<std::string_view> found;
    int depth = 0;
    for (std::size_t at = open, begin = open + 1; at < text.size(); ++at) {
        if (text[at] == '(') ++depth;
        if (text[at] == ')') --depth;
        if (depth == 0 || (depth == 1 && text[at] == ',')) {
            found.push_back(trimmed(text.substr(begin, at - begin)));
            begin = at + 1;
        }
        if (depth == 0) {
            end = at + 1;
            return found;
        }
    }
    throw ExpressionError("the bracket of series( is not closed");
}

int whole(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw ExpressionError(
            fmt::format("series(n, from, to, step, term) takes whole numbers, but \"{}\" is none", text));
    return value;
}

// Outer series first: their index may stand in the bounds of inner ones only after it has become a number.
std::string with_series_written_out(std::string text) {
    for (std::size_t at = find_word(text, "series"); at != std::string::npos; at = find_word(text, "series")) {
        std::size_t open = at + 6, end = 0;
        while (open < text.size() && text[open] == ' ') ++open;
        if (open == text.size() || text[open] != '(') throw ExpressionError("series stands without its bracket");
        const auto parts = arguments(text, open, end);
        if (parts.size() != 5)
            throw ExpressionError(
                fmt::format("series(n, from, to, step, term) takes 5 arguments, but it has {}", parts.size()));
        if (!is_name(parts[0]))
            throw ExpressionError(fmt::format("series counts with a name, but \"{}\" is none", parts[0]));
        const int from = whole(parts[1]), to = whole(parts[2]), step = whole(parts[3]);
        if (step <= 0) throw ExpressionError("the step of series must be at least 1");
        if (to < from) throw ExpressionError(fmt::format("series runs backwards, from {} to {}", from, to));
        std::string sum = "(";
        for (long n = from; n <= to; n += step) {
            sum += fmt::format("{}({})", n == from ? "" : "+",
                               with_word_replaced(parts[4], parts[0], fmt::format("({})", n)));
            if (sum.size() > longest_formula) throw ExpressionError("a series is too long: take fewer terms");
        }
        text.replace(at, end - at, sum + ")");
        if (text.size() > longest_formula) throw ExpressionError("the series are too long: take fewer terms");
    }
    return text;
}

// muParser takes "x = 1" for an assignment, which a formula that is evaluated ten thousand times must not make.
void refuse_assignment(std::string_view text) {
    for (std::size_t at = text.find('='); at != std::string_view::npos; at = text.find('=', at + 1)) {
        const char before = at > 0 ? text[at - 1] : ' ', after = at + 1 < text.size() ? text[at + 1] : ' ';
        if (after == '=') {
            ++at;
            continue;
        }
        if (before != '<' && before != '>' && before != '!')
            throw ExpressionError(fmt::format("\"=\" at character {} would assign; to compare write ==", at + 1));
    }
}

std::string explained(const mu::Parser::exception_type& error) {
    switch (error.GetCode()) {
        case mu::ecUNASSIGNABLE_TOKEN:
            return fmt::format("nothing is called \"{}\"", error.GetToken());
        case mu::ecUNEXPECTED_EOF:
        case mu::ecEMPTY_EXPRESSION:
            return "the formula ends too early";
        default: {
            std::string message = error.GetMsg();
            while (message.ends_with('.')) message.pop_back();
            return message;
        }
    }
}

}  // namespace

struct Expression::Compiled {
    mu::Parser parser;
    std::vector<double> values;  // the parser keeps their addresses
};

Expression::Expression(std::string_view formula, std::vector<std::string> variables, const Constants& constants)
    : text_(formula), compiled_(std::make_unique<Compiled>()) {
    refuse_assignment(text_);
    const std::string written_out = with_series_written_out(text_);
    mu::Parser& parser = compiled_->parser;
    compiled_->values.assign(variables.size(), 1.0);
    try {
        parser.DefineConst("pi", std::numbers::pi);
        for (const auto& [name, value] : constants)
            if (std::find(variables.begin(), variables.end(), name) == variables.end()) parser.DefineConst(name, value);
        for (std::size_t i = 0; i < variables.size(); ++i) parser.DefineVar(variables[i], &compiled_->values[i]);
        parser.SetExpr(written_out);
        int results = 0;
        parser.Eval(results);
        if (results != 1) throw ExpressionError(fmt::format("the formula gives {} values, not one", results));
    } catch (const mu::Parser::exception_type& error) {
        throw ExpressionError(explained(error),
                              error.GetCode() == mu::ecUNASSIGNABLE_TOKEN ? error.GetToken() : std::string());
    }
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

double Expression::operator()(std::span<const double> values) const {
    std::copy_n(values.begin(), compiled_->values.size(), compiled_->values.begin());
    return compiled_->parser.Eval();
}

double constant_value(std::string_view formula, const Constants& constants) {
    return Expression(formula, {}, constants)({});
}

bool usable_as_constant(std::string_view name) {
    if (!is_name(name) || name.front() == '_' || name == "pi" || name == "series") return false;
    static const auto functions = mu::Parser().GetFunDef();
    return !functions.contains(std::string(name));
}

}  // namespace aquagraph::io
