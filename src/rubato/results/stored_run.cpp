// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/stored_run.hpp"

#include "rubato/core/error.hpp"
#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace rubato::results {
namespace {

nlohmann::json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file)
    throw InputError(fmt::format("{}: cannot be read", path.string()));
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: found no valid JSON ({})", path.string(), error.what()));
  }
}

RunStatus status_named(const std::string& word, const std::filesystem::path& path) {
  const auto* const found = std::ranges::find(run_status_words, word, &RunStatusWord::word);
  if (found == run_status_words.end())
    throw InputError(fmt::format("{}: found the status '{}', which no run has", path.string(), word));
  return found->status;
}

} // namespace

StoredRun read_stored_run(const std::filesystem::path& folder) {
  const auto path = folder / summary_file;
  const auto json = read_json(path);
  try {
    StoredRun run;
    run.status = status_named(json.at("status").get<std::string>(), path);
    run.reason = json.at("reason").get<std::string>();
    run.name = json.at("run").get<std::string>();
    run.study = json.at("study").dump();
    run.probes = read_csv(folder / probes_file);
    return run;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: not the summary of a run ({})", path.string(), error.what()));
  }
}

std::vector<std::string> stored_warnings(const std::filesystem::path& folder) {
  std::ifstream file(folder / summary_file);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  std::vector<std::string> warnings;
  if (json.is_object() && json.contains("warnings"))
    for (const auto& text : json.at("warnings"))
      if (text.is_string())
        warnings.push_back(text.get<std::string>());
  return warnings;
}

std::vector<std::filesystem::path> run_folders(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  if (fs::exists(folder / summary_file))
    return {folder};
  std::vector<fs::path> folders;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory() && fs::exists(entry.path() / summary_file))
      folders.push_back(entry.path());
  if (folders.empty())
    throw InputError(
        fmt::format("{}: found no {}, expected the folder of a run", folder.string(), summary_file));
  std::ranges::sort(folders);
  return folders;
}

} // namespace rubato::results
