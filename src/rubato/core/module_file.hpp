// SPDX-License-Identifier: LGPL-3.0-or-later
/// Modules of rubato: libraries that belong to it and are loaded when they are first used.
#pragma once

#include <filesystem>
#include <string>

namespace rubato {

/// The path of a module, which is in lib/rubato of a build or an installation: below a folder above the
/// program or library that this code is linked into. Empty if there is no such file.
std::filesystem::path module_path(const std::string& file);

} // namespace rubato
