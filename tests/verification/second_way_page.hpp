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

/// The kind of cause that a difference is put down to; empty when it belongs to none that was looked into.
std::string cause_of(const WayStudy& study, const Comparison& comparison);

} // namespace rubato::verification
