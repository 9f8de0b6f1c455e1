// SPDX-License-Identifier: LGPL-3.0-or-later
/// Detects limit cycles of the active set: iterations that come back to where they were.
#pragma once

#include "rubato/step/common/contact_evaluator.hpp"

#include <optional>
#include <vector>

namespace rubato::step {

class CycleDetector {
public:
  /// How many iterates ago one had the same statuses and, but for rounding, forces of the same size; nothing
  /// where none had. The same statuses alone are no cycle: on the way to the answer they often come twice.
  std::optional<int> length_of_cycle(const ContactIterate& iterate, double size_of_forces);
  /// Part of the next correction to take from an iterate: the whole; where iterates come back 0.4 for as many
  /// corrections as the cycle has, the second time 0.16, as another way may lead on from between them;
  /// nothing when they came back too often.
  std::optional<double> part_of_next(const ContactIterate& iterate, double size_of_forces);

private:
  struct Met {
    std::vector<std::vector<contact::Status>> status;
    double size = 0;
  };
  std::vector<Met> met_;
  int cycles_ = 0;
  int damped_left_ = 0; ///< corrections
};

} // namespace rubato::step
