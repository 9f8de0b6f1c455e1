// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a running computation reports, and how it is stopped.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

namespace rubato::step {
struct StepReport;
} // namespace rubato::step

namespace rubato::run {

/// What a running computation tells whoever watches it.
struct Progress {
  std::string_view run;
  double t = 0;
  double begin = 0;
  double end = 0;
  double step = 0;
  int iterations = 0;
  int contact_points = 0; ///< in contact
  int cut_level = 0;
  bool accepted = true;
  const step::StepReport* report = nullptr;
  bool within = false; ///< inside the step to t, which is not known yet to be accepted
  double residual = std::numeric_limits<double>::quiet_NaN(); ///< inside a step, where it is known
};

struct Watch {
  /// After each attempt at a step.
  std::function<void(const Progress&)> progress = [](const Progress&) {};
  /// Inside an attempt, at least once an iteration.
  std::function<void(const Progress&)> within = [](const Progress&) {};
  std::function<void(const std::string&)> say = [](const std::string&) {};
  std::function<void(const std::string&)> warn = [](const std::string&) {};
  std::function<bool()> stop = [] { return false; };
  /// Before memory is taken for a factor [bytes]: may wait until there is some. With 0 once steps begin, when
  /// all that is known of has been taken. Throws StoppedWhileWaiting.
  std::function<void(std::size_t)> room = [](std::size_t) {};
};

/// A run is to stop, and waited for memory.
class StoppedWhileWaiting : public std::exception {
public:
  const char* what() const noexcept override { return "the run was stopped while it waited for memory"; }
};

} // namespace rubato::run
