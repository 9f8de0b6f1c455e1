// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/ccx/draft.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::ccx {

void add_note(Draft& draft, const std::string& text) {
  if (std::ranges::find(draft.notes, text) == draft.notes.end())
    draft.notes.push_back(text);
}

Place place_of(const Run& run, int dof) {
  const auto node = static_cast<std::size_t>(run.model.node_of(dof));
  return {run.draft.node_numbers[node], dof - run.model.dofs.first_dof[node] + 1};
}

std::int64_t made_node(Draft& draft, const std::string& purpose, const Eigen::Vector3d& place) {
  const auto [entry, is_new] = draft.made_nodes.try_emplace(purpose, draft.next_node);
  if (!is_new)
    return entry->second;
  ++draft.next_node;
  draft.more_nodes += fmt::format("{}, {}, {}, {}\n", entry->second, shown_number(place[0]),
                                  shown_number(place[1]), shown_number(place[2]));
  return entry->second;
}

} // namespace rubato::ccx
