// SPDX-License-Identifier: LGPL-3.0-or-later
/// Folders of runs that the command line names.
#pragma once

#include <filesystem>

namespace rubato::app {

/// Throws InputError when the folder is no run's, with the runs that are near.
void require_run(const std::filesystem::path& folder);

} // namespace rubato::app
