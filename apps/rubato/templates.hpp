// SPDX-License-Identifier: LGPL-3.0-or-later
/// The decks of the folder templates, which the build puts into the program.
#pragma once

#include <span>
#include <string_view>

namespace rubato::app {

struct Template {
  std::string_view name;
  std::string_view deck; ///< its first line is a comment that says what it is
};

/// By name.
std::span<const Template> templates();

} // namespace rubato::app
