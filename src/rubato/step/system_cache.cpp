// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/system_cache.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rubato::step {

SystemCache::SystemCache(const model::Model& model, const time::Scheme& scheme,
                         std::function<void(std::size_t)> tell_memory)
    : model_(model), scheme_(scheme), tell_memory_(std::move(tell_memory)) {}

EffectiveSystem& SystemCache::of(double length) {
  const auto known =
      std::ranges::find(entries_, length, [](const Entry& entry) { return entry.system.step; });
  if (known != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, known);
  } else {
    if (entries_.size() == kept) // before the new one is made: both may not fit into the memory
      entries_.erase(dispensable());
    entries_.push_front({make_effective_system(model_, scheme_, length, tell_memory_), 0});
  }
  ++entries_.front().uses;
  return entries_.front().system;
}

SystemCache::Entries::iterator SystemCache::dispensable() {
  const auto main = std::ranges::max_element(entries_, {}, &Entry::uses);
  const auto oldest = std::prev(entries_.end());
  return oldest == main ? std::prev(oldest) : oldest;
}

} // namespace rubato::step
