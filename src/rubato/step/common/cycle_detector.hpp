// SPDX-License-Identifier: LGPL-3.0-or-later
/// Detects limit cycles of the active set: iterations that come back to where they were.
#pragma once

#include "rubato/step/common/contact_evaluator.hpp"

#include <optional>
#include <vector>

namespace rubato::step {

class CycleDetector {
public:
  /// Whether an earlier iterate had the same statuses and, but for rounding, forces of the same size. The
  /// same statuses alone are no cycle: on the way to the answer they often come twice.
  bool has_met(const ContactIterate& iterate, double size_of_forces);
  /// Part of the next correction to take from an iterate: the whole; half of it where iterates come back, as
  /// another way may lead on from there; nothing when they came back too often.
  std::optional<double> part_of_next(const ContactIterate& iterate, double size_of_forces);

private:
  struct Met {
    std::vector<std::vector<contact::Status>> status;
    double size = 0;
  };
  std::vector<Met> met_;
  int cycles_ = 0;
};

} // namespace rubato::step
