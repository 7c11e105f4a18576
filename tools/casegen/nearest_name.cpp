// Optimal string alignment distance by dynamic programming, in the last three rows of the table. Names are short: what
// is longer than all candidates by more than is tolerated is like none of them, and is not compared.
#include "nearest_name.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace fixdem::casegen {
namespace {

int tolerated(std::string_view candidate) { return std::max(1, static_cast<int>(candidate.size()) / 3); }

bool comparable(std::string_view name, std::string_view candidate) {
  const std::size_t a = name.size(), b = candidate.size();
  return (a > b ? a - b : b - a) <= static_cast<std::size_t>(tolerated(candidate));
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::array<std::vector<int>, 3> rows;
  for (auto& row : rows) row.resize(b.size() + 1);
  for (std::size_t i = 0; i <= a.size(); ++i) {
    auto &row = rows[i % 3], &above = rows[(i + 2) % 3], &second = rows[(i + 1) % 3];
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        row[j] = static_cast<int>(i + j);
        continue;
      }
      const int substituted = above[j - 1] + (a[i - 1] != b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, substituted});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], second[j - 2] + 1);
    }
  }
  return rows[a.size() % 3][b.size()];
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  std::string nearest;
  int least = 0;
  for (const auto& candidate : candidates) {
    if (!comparable(name, candidate)) continue;
    const int distance = edit_distance(name, candidate);
    if (nearest.empty() || distance < least) {
      nearest = candidate;
      least = distance;
    }
  }
  return least <= tolerated(nearest) ? nearest : "";
}

}  // namespace fixdem::casegen
