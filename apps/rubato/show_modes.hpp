// SPDX-License-Identifier: LGPL-3.0-or-later
/// Natural modes of one study, computed, written and printed.
#pragma once

#include "rubato/inp/read.hpp"
#include "rubato/modes/modes.hpp"

#include <filesystem>

namespace rubato::app {

/// Returns the exit code. Throws InputError when the study has no such modes.
int show_modes(const study::Study& study, const inp::ModesAsked& asked, modes::Contact contact,
               const std::filesystem::path& folder);

} // namespace rubato::app
