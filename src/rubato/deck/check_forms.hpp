// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is wrong with a deck whatever its runs make of it.
#pragma once

#include "rubato/deck/faults.hpp"
#include "rubato/deck/tree.hpp"

namespace rubato::deck {

/// Faults of the values of a deck, without its `runs`, that have none of the forms of the grammar: unknown
/// keys and words, other kinds of values, numbers out of bounds; entries of lists that are not complete. The
/// reader tells most of them itself. This is about values that every run replaces, which nothing reads: so
/// whatever the schema refuses is refused here.
Faults faults_of_forms(const Tree& deck);

} // namespace rubato::deck
