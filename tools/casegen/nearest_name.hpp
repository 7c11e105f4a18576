// The nearest of a list of names to a misspelt one, for suggestions.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fixdem::casegen {

/// Least number of insertions, deletions, substitutions and swaps of neighbouring letters that turn a into b.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate at the least distance, or "" when even that one differs in more than a third of its letters.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace fixdem::casegen
