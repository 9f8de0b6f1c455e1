// SPDX-License-Identifier: LGPL-3.0-or-later
/// Progress reports of a step, and the request to stop it.
#pragma once

#include <functional>
#include <limits>
#include <utility>

namespace rubato::step {

/// Where a step stands, in whatever loop it is.
struct ProgressState {
  int iterations = 0;     ///< linear solves so far, of all attempts of the step
  int contact_points = 0; ///< in contact
  double residual = std::numeric_limits<double>::quiet_NaN(); ///< relative; NaN: not known yet
};

/// Is told where a step stands, at least once an iteration; whether the step is to go on.
using GoesOn = std::function<bool(const ProgressState&)>;

/// The progress of one step. Each loop of a step reports at least once a round. Once a report has returned
/// false, all do, and every loop returns as soon as it can; what it has computed is no result then. Between
/// two reports lies at most one factorisation, or one block of the compliance of a surface.
class Progress {
public:
  /// Without a function the step goes on to its end.
  explicit Progress(GoesOn goes_on = {}) : goes_on_(std::move(goes_on)) {}

  /// Of a loop inside an iteration. Whether to go on.
  bool report() {
    if (!stopped_ && goes_on_)
      stopped_ = !goes_on_(now_);
    return !stopped_;
  }
  /// Before a linear solve. Whether to go on.
  bool report(int contact_points, double residual) {
    now_.contact_points = contact_points;
    now_.residual = residual;
    const bool goes_on = report();
    ++now_.iterations;
    return goes_on;
  }
  bool stopped() const { return stopped_; }

private:
  GoesOn goes_on_;
  ProgressState now_;
  bool stopped_ = false;
};

} // namespace rubato::step
