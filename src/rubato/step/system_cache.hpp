// SPDX-License-Identifier: LGPL-3.0-or-later
/// Effective matrices of the step lengths in use: cut steps come back to the lengths they had.
#pragma once

#include "rubato/step/common/effective_system.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>

namespace rubato::step {

/// Holds a few systems. When another one is needed, the one that was not used for longest goes, but never the
/// one that was used most often: the run comes back to its main step length after steps of many other ones.
class SystemCache {
public:
  static constexpr std::size_t kept = 4;

  /// `tell_memory` hears what each factor needs [bytes] before it is computed. Model and scheme must outlive
  /// this.
  SystemCache(const model::Model& model, const time::Scheme& scheme,
              std::function<void(std::size_t)> tell_memory);

  /// The system of a step length, made when it is not there. Valid until the next call.
  EffectiveSystem& of(double length);

private:
  struct Entry {
    EffectiveSystem system;
    std::int64_t uses = 0;
  };
  using Entries = std::list<Entry>;

  Entries::iterator dispensable();

  const model::Model& model_;
  const time::Scheme& scheme_;
  std::function<void(std::size_t)> tell_memory_;
  Entries entries_; ///< the one used last is the first
};

} // namespace rubato::step
