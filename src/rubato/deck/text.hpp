// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a text must be before it is worth reading as YAML.
#pragma once

#include "rubato/deck/faults.hpp"

#include <string>
#include <string_view>

namespace rubato::deck {

/// Adds a fault for: text that is not UTF-8, control characters, lines indented with tabs, nothing but blanks
/// and comments, more than 8 MiB. Returns whether the text may be parsed.
bool is_readable(std::string_view text, const std::string& file, Faults& faults);

} // namespace rubato::deck
