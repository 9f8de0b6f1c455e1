// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace rubato::study {
namespace {

class Ordering {
public:
  explicit Ordering(std::span<const MadeGroup> groups) : groups_(groups), states_(groups.size()) {
    for (std::size_t i = 0; i < groups.size(); ++i)
      places_.emplace(groups[i].name, i);
  }

  GroupOrder run() {
    for (std::size_t i = 0; i < groups_.size(); ++i)
      visit(i);
    return std::move(found_);
  }

private:
  enum class State { unseen, open, ready, waiting };

  /// Depth first: those it is made of come before it.
  void visit(std::size_t i) {
    if (states_[i] != State::unseen)
      return;
    states_[i] = State::open;
    path_.push_back(i);
    bool ready = true;
    for (const auto& name : groups_[i].of)
      if (const auto other = places_.find(name); other != places_.end())
        ready = is_ready(other->second) && ready;
    path_.pop_back();
    states_[i] = ready ? State::ready : State::waiting;
    if (ready)
      found_.order.push_back(i);
  }

  bool is_ready(std::size_t i) {
    visit(i);
    if (states_[i] == State::open)
      note_cycle(i);
    return states_[i] == State::ready;
  }

  void note_cycle(std::size_t first) {
    if (!found_.cycle.empty())
      return;
    for (auto at = std::ranges::find(path_, first); at != path_.end(); ++at)
      found_.cycle.push_back(groups_[*at].name);
    found_.cycle.push_back(groups_[first].name);
  }

  std::span<const MadeGroup> groups_;
  std::map<std::string, std::size_t> places_;
  std::vector<State> states_;
  std::vector<std::size_t> path_;
  GroupOrder found_;
};

} // namespace

std::string path_of(const MadeGroup& group) {
  return "mesh.groups." + group.name;
}

std::string path_of_source(const MadeGroup& group, std::size_t i) {
  const auto& entry = entry_of(group.kind);
  switch (entry.sources) {
  case GroupSources::list:
    return fmt::format("{}.{}.{}", path_of(group), entry.name, i);
  case GroupSources::name:
    return fmt::format("{}.{}", path_of(group), entry.name);
  default:
    return path_of(group) + ".of";
  }
}

GroupOrder order_of(std::span<const MadeGroup> groups) {
  return Ordering(groups).run();
}

} // namespace rubato::study
