// SPDX-License-Identifier: LGPL-3.0-or-later
/// The forms of each part of a deck.
#pragma once

#include "rubato/deck/grammar/form.hpp"

namespace rubato::deck::grammar {

Forms mesh();
Forms groups();
Forms materials();
/// Keys of a material beside the numbers of its law: how it yields, its terms, its strain and cells.
std::vector<Key> material_words();
Forms functions();
Forms supports();
/// A line and an angle about it.
Forms rotation();
Forms base_motion();
Forms preload();
/// Keys of a plane that cuts bodies.
std::vector<Key> cut();
Forms relations();
Forms loads();
Forms temperatures();
Forms modal_damping();
Forms springs();
Forms connectors();
Forms masses();
Forms initial();
Forms contact();
Forms obstacle();
Forms time();
Forms newton();
Forms probes();
Forms fields();
Forms checkpoint();
Forms checks();

/// The whole, but for `runs`, which lie over it.
const Forms& deck();
/// Changes of the deck by names of runs.
const Forms& runs();

} // namespace rubato::deck::grammar
