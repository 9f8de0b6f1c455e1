// SPDX-License-Identifier: LGPL-3.0-or-later
/// The page of the comparison sweep, docs/verification/second_way.md.
#pragma once

#include "verification/second_way.hpp"
#include "verification/verify.hpp"
#include <string>
#include <vector>

namespace rubato::verification {

struct WayEntry {
  WayStudy study;
  StudyComparison comparison;
};

void write_way_entries(Page& page, const std::vector<WayEntry>& entries);

/// What was found to cause a difference of the study in that way; empty when it was not investigated.
std::string cause_of(int number, const std::string& way);

} // namespace rubato::verification
