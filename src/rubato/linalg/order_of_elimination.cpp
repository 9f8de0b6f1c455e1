// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/order_of_elimination.hpp"

#include "rubato/core/index.hpp"
#include "rubato/linalg/ranked_matrix.hpp"

#include <algorithm>
#include <metis.h>
#include <stdexcept>

namespace rubato::linalg {
namespace {

/// Unknowns that are eliminated, by numbers of their own.
struct Inner {
  std::vector<int> unknowns;
  std::vector<int> number_of; ///< −1 of the surface
};

Inner inner_of(std::size_t size, std::span<const int> surface) {
  Inner inner{{}, std::vector<int>(size, 0)};
  for (const int unknown : surface)
    inner.number_of[at(unknown)] = -1;
  for (std::size_t unknown = 0; unknown < size; ++unknown)
    if (auto& number = inner.number_of[unknown]; number == 0) {
      number = static_cast<int>(inner.unknowns.size());
      inner.unknowns.push_back(static_cast<int>(unknown));
    }
  return inner;
}

struct Graph {
  std::vector<idx_t> starts{0};
  std::vector<idx_t> neighbours;
};

Graph graph_of(const PatternOfParts& pattern, const Inner& inner) {
  Graph graph;
  std::vector<idx_t> neighbours;
  for (const int unknown : inner.unknowns) {
    neighbours.clear();
    for (std::size_t rank = 0; rank < pattern.ranks(); ++rank)
      for (const int row : pattern.rows(rank, at(unknown)))
        if (row != unknown && inner.number_of[at(row)] >= 0)
          neighbours.push_back(inner.number_of[at(row)]);
    std::ranges::sort(neighbours);
    const auto repeated = std::unique(neighbours.begin(), neighbours.end());
    graph.neighbours.insert(graph.neighbours.end(), neighbours.begin(), repeated);
    graph.starts.push_back(static_cast<idx_t>(graph.neighbours.size()));
  }
  return graph;
}

/// The place of each.
std::vector<idx_t> dissected(Graph graph) {
  auto size = static_cast<idx_t>(graph.starts.size() - 1);
  std::vector<idx_t> unknown_at(at(size)), place(at(size));
  if (size == 0)
    return place;
  std::vector<idx_t> options(METIS_NOPTIONS);
  METIS_SetDefaultOptions(options.data());
  if (METIS_NodeND(&size, graph.starts.data(), graph.neighbours.data(), nullptr, options.data(),
                   unknown_at.data(), place.data()) != METIS_OK)
    throw std::runtime_error("METIS cannot order the unknowns");
  return place;
}

} // namespace

std::vector<int> order_of_elimination(const SparseMatrix& part, std::span<const int> surface,
                                      const Ranks& ranks) {
  const PatternOfParts pattern(part, ranks);
  if (!ranks.is_first())
    return {};
  const auto inner = inner_of(at(part.cols()), surface);
  const auto places = dissected(graph_of(pattern, inner));
  std::vector<int> order(at(part.cols()));
  for (std::size_t i = 0; i < places.size(); ++i)
    order[at(inner.unknowns[i])] = static_cast<int>(places[i]);
  for (std::size_t i = 0; i < surface.size(); ++i)
    order[at(surface[i])] = static_cast<int>(places.size() + i);
  return order;
}

} // namespace rubato::linalg
