// SPDX-License-Identifier: LGPL-3.0-or-later
/// Notices iterations that come back to where they were: they would do so for ever.
#pragma once

#include "rubato/step/contact_side.hpp"

#include <vector>

namespace rubato::step {

class CycleWatch {
public:
  /// Whether an earlier iterate had the same statuses and, but for rounding, forces of the same size. The
  /// same statuses alone are no cycle: on the way to the answer they often come twice.
  bool has_met(const ContactIterate& iterate, double size_of_forces);

private:
  struct Met {
    std::vector<std::vector<contact::Status>> status;
    double size = 0;
  };
  std::vector<Met> met_;
};

} // namespace rubato::step
