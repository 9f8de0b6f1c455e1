// SPDX-License-Identifier: LGPL-3.0-or-later
/// How a long step tells that it is still going on, and hears that it is to end.
#pragma once

#include <functional>
#include <limits>
#include <utility>

namespace rubato::step {

/// Where a step stands, in whatever loop it is.
struct Beat {
  int iterations = 0;     ///< linear solves so far, of all attempts of the step
  int contact_points = 0; ///< in contact
  double residual = std::numeric_limits<double>::quiet_NaN(); ///< relative; NaN: not known yet
};

/// Is told where a step stands, at least once an iteration; whether the step is to go on.
using GoesOn = std::function<bool(const Beat&)>;

/// The pulse of one step. Each loop of a step beats at least once a round; once a beat has said no, all do,
/// and every loop leaves as fast as it can. What it leaves behind is no result then. Between two beats lies
/// at most one factorisation, or one block of the compliance of a surface.
class Pulse {
public:
  /// Without a function the step goes on to its end.
  explicit Pulse(GoesOn goes_on = {}) : goes_on_(std::move(goes_on)) {}

  /// Of a loop inside an iteration. Whether to go on.
  bool beat() {
    if (!stopped_ && goes_on_)
      stopped_ = !goes_on_(now_);
    return !stopped_;
  }
  /// Before a linear solve. Whether to go on.
  bool beat(int contact_points, double residual) {
    now_.contact_points = contact_points;
    now_.residual = residual;
    const bool goes_on = beat();
    ++now_.iterations;
    return goes_on;
  }
  bool stopped() const { return stopped_; }

private:
  GoesOn goes_on_;
  Beat now_;
  bool stopped_ = false;
};

} // namespace rubato::step
