// SPDX-License-Identifier: LGPL-3.0-or-later
/// Changes of a deck.
#pragma once

#include <string>

namespace rubato::deck {

/// One change from the command line, `--set time.step=1e-4`.
struct Setting {
  std::string path;  ///< keys and list indexes (from 0) joined by dots: "loads.0.nodal_force.y"
  std::string value; ///< YAML; empty or `~` removes the key
};

} // namespace rubato::deck
