// "did you mean …": the known word nearest to a mistyped one.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace aquagraph::io {

// Insertions, deletions, substitutions and swaps of neighbours that turn one word into the other, letter case aside.
int edit_distance(std::string_view a, std::string_view b);

// Nothing where all are too far off to be a slip (more than a third of the word's letters, at least one).
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> known);

}  // namespace aquagraph::io
