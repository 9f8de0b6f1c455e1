// SPDX-License-Identifier: LGPL-3.0-or-later
/// Natural modes as files.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/modes/modes.hpp"

#include <filesystem>
#include <string_view>

namespace rubato::results {

constexpr std::string_view modes_file = "modes.csv";
constexpr std::string_view mode_shapes_file = "modes.vtu";

/// Writes both into a folder that is there. `modes.csv`: a row for each mode with mode (from 1), frequency
/// [1/time], generalised_mass [mass], effective_mass_x and so on for the directions there are (parts of the
/// whole mass), residual. `modes.vtu`: the undeformed mesh with a vector field mode_1, mode_2, … of each
/// shape, whose longest displacement is 1. Throws InputError when a file cannot be written, WriteError when
/// writing fails.
void write_modes(const std::filesystem::path& folder, const model::Model& model, const modes::Modes& modes);

} // namespace rubato::results
