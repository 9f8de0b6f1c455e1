// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far a run has come, in one word that run.json keeps.
#pragma once

#include <array>
#include <string_view>

namespace rubato::results {

enum class RunStatus {
  running,       ///< not at its end; in a folder nobody writes any more: killed
  complete,      ///< reached its last instant
  not_converged, ///< no step led on; what was reached is kept
  interrupted    ///< asked to stop; what was reached is kept
};

struct RunStatusWord {
  RunStatus status;
  std::string_view word;
};
constexpr std::array<RunStatusWord, 4> run_status_words{{{RunStatus::running, "running"},
                                                         {RunStatus::complete, "complete"},
                                                         {RunStatus::not_converged, "not_converged"},
                                                         {RunStatus::interrupted, "interrupted"}}};

constexpr std::string_view to_string(RunStatus status) {
  for (const auto& entry : run_status_words)
    if (entry.status == status)
      return entry.word;
  return "";
}

} // namespace rubato::results
