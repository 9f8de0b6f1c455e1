// SPDX-License-Identifier: LGPL-3.0-or-later
#include "require_run.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

namespace rubato::app {

void require_run(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  if (fs::exists(folder / results::summary_file))
    return;
  const bool is_folder = fs::is_directory(folder);
  std::vector<std::string> runs;
  std::error_code error;
  const auto around =
      is_folder || folder.parent_path().empty() ? fs::path(is_folder ? folder : ".") : folder.parent_path();
  for (const auto& entry : fs::directory_iterator(around, error))
    if (fs::exists(entry.path() / results::summary_file))
      runs.push_back(entry.path().lexically_normal().string());
  std::ranges::sort(runs);
  auto hint = runs.empty() ? "" : fmt::format("; there are {}", fmt::join(runs, ", "));
  if (const auto nearest = nearest_word(folder.string(), runs); !is_folder && !nearest.empty())
    hint = fmt::format("; did you mean '{}'?", nearest);
  throw InputError(fmt::format("{}: found no {}, expected the folder of a run{}", folder.string(),
                               results::summary_file, hint));
}

} // namespace rubato::app
