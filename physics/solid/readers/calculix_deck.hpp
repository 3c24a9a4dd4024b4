// Cards of an input deck: a keyword line with its parameters, and the data lines that follow.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "physics/solid/readers/file_lines.hpp"

namespace aquagraph::solid {

std::string upper_case(std::string text);

class Deck {
  public:
    explicit Deck(FileLines lines) : lines_(std::move(lines)) {}

    // Goes on to the next keyword, past what is left of the data of the last one; false at the end. `keyword` is in
    // upper case without its star, "ELEMENT".
    bool next_card();
    const std::string& keyword() const { return keyword_; }
    long line_of_card() const { return line_of_card_; }
    // The value of a parameter as written, "" for one without value; nothing where it is not there.
    std::optional<std::string> parameter(const std::string& name) const;

    // The fields of the next data line of this card, without blanks around them; false where there is no further one.
    bool next_data(std::vector<std::string>& fields);
    int whole(const std::string& field) const;
    double number(const std::string& field) const;

    [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }
    [[noreturn]] void fail(const std::string& message, long line) const { lines_.fail(message, line); }
    const std::string& source() const { return lines_.source(); }
    long line() const { return lines_.number(); }

  private:
    bool next_line();  // that is no comment, into line_

    FileLines lines_;
    std::string line_, keyword_;
    bool held_ = false;  // line_ has not been used yet
    long line_of_card_ = 0;
    std::map<std::string, std::string> parameters_;
};

}  // namespace aquagraph::solid
