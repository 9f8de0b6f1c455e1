// SPDX-License-Identifier: LGPL-3.0-or-later
/// Natural modes in the layout of CalculiX's .dat and .frd files.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/modes/modes.hpp"

#include <filesystem>

namespace rubato::results {

/// Writes tables.dat and fields.frd into an existing folder where the study asks for tables or .frd files.
/// tables.dat has eigenvalues, participation factors φ·M r with φ·M φ = 1, their squares (effective modal
/// masses) and r·M r. r is a unit translation or rotation about an axis through the origin, 0 at nodes that
/// supports hold. Then follow the study's tables of each shape. RF is K φ, as in
/// CalculiX. Throws InputError when a file cannot be written, WriteError when writing fails.
void write_mode_tables(const std::filesystem::path& folder, const model::Model& model,
                       const modes::Modes& modes);

} // namespace rubato::results
