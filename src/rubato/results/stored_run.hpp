// SPDX-License-Identifier: LGPL-3.0-or-later
/// A run's folder, read back.
#pragma once

#include "rubato/results/csv.hpp"
#include "rubato/results/run_status.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rubato::results {

struct StoredRun {
  std::string name;
  std::string study; ///< as study::to_json wrote it
  RunStatus status = RunStatus::running;
  std::string reason; ///< why it is not complete
  Table probes;
};

/// Throws InputError when the folder is no run's.
StoredRun read_stored_run(const std::filesystem::path& folder);

/// The warnings in the summary of a run; none where there is no such file or it has none.
std::vector<std::string> stored_warnings(const std::filesystem::path& folder);

/// The folder itself when it holds a run, else its subfolders that do, by name. Throws InputError when there
/// is none.
std::vector<std::filesystem::path> run_folders(const std::filesystem::path& folder);

} // namespace rubato::results
