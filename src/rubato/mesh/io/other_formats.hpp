// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: formats that a build with RUBATO_RUNS_ONLY leaves out.
#pragma once

namespace rubato::mesh {

/// Whether .msh, .mail and .inp are read. In a build with RUBATO_RUNS_ONLY their functions throw InputError.
bool are_other_formats_built_in();

} // namespace rubato::mesh
