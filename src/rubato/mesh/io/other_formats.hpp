// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: formats that a build with RUBATO_RUNS_ONLY leaves out.
#pragma once

namespace rubato::mesh {

/// True where this build reads .msh, .mail and .inp. With RUBATO_RUNS_ONLY, functions of these formats throw
/// InputError.
bool are_other_formats_built_in();

} // namespace rubato::mesh
