// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is kept of an attempt that ended a run.
#pragma once

#include "rubato/step/report.hpp"

#include <string>
#include <vector>

namespace rubato::results {

/// The attempt that no step led on from.
struct Failure {
  double begin = 0;
  double end = 0;
  int cut_level = 0;
  step::StepReport report;
  std::string not_finite;          ///< the first thing that was not finite, in words; empty when all was
  std::vector<std::string> advice; ///< what may help, each a few words
};

} // namespace rubato::results
