#include "physics/solid/readers/calculix_deck.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace aquagraph::solid {

namespace {

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\""), last = text.find_last_not_of(" \t\"");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    for (std::size_t begin = 0;;) {
        const std::size_t end = line.find(',', begin);
        fields.push_back(trimmed(line.substr(begin, end - begin)));
        if (end == std::string::npos) break;
        begin = end + 1;
    }
    while (!fields.empty() && fields.back().empty()) fields.pop_back();
    return fields;
}

}  // namespace

std::string upper_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

bool Deck::next_line() {
    if (held_) return held_ = false, true;
    while (lines_.next(line_))
        if (!line_.starts_with("**")) return true;
    return false;
}

bool Deck::next_card() {
    do
        if (!next_line()) return false;
    while (line_.front() != '*');
    line_of_card_ = lines_.number();
    std::vector<std::string> fields = split(line_.substr(1));
    keyword_ = fields.empty() ? "" : upper_case(fields[0]);
    parameters_.clear();
    for (std::size_t k = 1; k < fields.size(); ++k) {
        const std::size_t equals = fields[k].find('=');
        parameters_[upper_case(trimmed(fields[k].substr(0, equals)))] =
            equals == std::string::npos ? "" : trimmed(fields[k].substr(equals + 1));
    }
    return true;
}

std::optional<std::string> Deck::parameter(const std::string& name) const {
    const auto found = parameters_.find(name);
    if (found == parameters_.end()) return std::nullopt;
    return found->second;
}

bool Deck::next_data(std::vector<std::string>& fields) {
    if (!next_line()) return false;
    if (line_.front() == '*') {
        held_ = true;
        return false;
    }
    fields = split(line_);
    return true;
}

int Deck::whole(const std::string& field) const {
    int value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size())
        fail("a whole number is needed in *" + keyword_ + ", found \"" + field + "\"");
    return value;
}

double Deck::number(const std::string& field) const {
    char* end = nullptr;
    const double value = std::strtod(field.c_str(), &end);
    if (field.empty() || *end != '\0' || !std::isfinite(value))
        fail("a number is needed in *" + keyword_ + ", found \"" + field + "\"");
    return value;
}

}  // namespace aquagraph::solid
