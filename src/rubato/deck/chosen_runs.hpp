// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which runs of a deck are read, and what is laid over each.
#pragma once

#include "rubato/deck/overlay.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::deck {

/// A run as the deck has it.
struct WrittenRun {
  Name name;
  Tree over; ///< its own entries
};

/// A run that is wanted.
struct ChosenRun {
  const WrittenRun* run = nullptr;
  bool asked = true; ///< for itself, not only because another one starts from it
  bool left = false; ///< settings would have changed it, had it been asked for
};

/// The runs named by `only`, all when it is empty, and those they start from, in the order of the deck.
/// Faults: names that no run has.
std::vector<ChosenRun> choose_runs(const Tree& deck, const std::vector<WrittenRun>& runs,
                                   std::span<const Change> changes, std::span<const std::string> only,
                                   Faults& faults);

/// The deck of one run: with its own entries laid over it, then the changes that name it and, when it is
/// asked for, those that name none. Faults: where changes cannot be applied.
Tree tree_of(const Tree& deck, const ChosenRun& chosen, std::span<const Change> changes, Faults& faults);

} // namespace rubato::deck
