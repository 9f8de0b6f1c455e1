// SPDX-License-Identifier: LGPL-3.0-or-later
/// What runs and command-line settings lay over a deck.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/deck/tree.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::deck {

/// A parsed setting.
struct Change {
  std::string run;               ///< empty: every run
  std::vector<std::string> path; ///< at least one step
  Tree value;
};

/// Lays `over` over a whole deck: maps are merged, anything else is replaced, nothing (`~`) removes. Of
/// mesh.file and mesh.generate the one in `over` removes the other.
void lay_over(Tree& deck, const Tree& over);

/// Parses settings; faults for unreadable paths and values and for unknown runs (`runs`: the names there
/// are).
std::vector<Change> parse_changes(std::span<const Setting> settings, const std::vector<std::string>& runs,
                                  Faults& faults);

/// Lays a setting over the deck of one run. Faults: an index beyond its list, a step into a word, and into an
/// entry of materials, functions, contact or probes that the deck doesn't have. Keys that are unknown
/// otherwise are left to the reader, which knows the words of every part.
void apply(Tree& deck, const Change& change, Faults& faults);

} // namespace rubato::deck
