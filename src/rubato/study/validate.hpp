// SPDX-License-Identifier: LGPL-3.0-or-later
/// Every rule that a study must keep before there is a mesh. All front ends end here, and so do studies that
/// a program builds.
#pragma once

#include "rubato/study/study.hpp"

#include <map>
#include <string>
#include <vector>

namespace rubato::study {

/// A rule that is broken. Paths name values as a deck does: "contact.slide.friction", "supports.0.on".
struct BrokenRule {
  std::vector<std::string> paths; ///< the values that the rule is about; it is told at the first
  std::string text;               ///< a sentence: what was found, what is expected
};

/// What the rules say of a study.
struct Judgement {
  std::vector<BrokenRule> broken;            ///< in the order of the study's parts; empty when all are kept
  std::map<std::string, std::string> bounds; ///< of each number that has some, by its path: " > 0"
};

Judgement judge(const Study& study);
/// The rules about groups that are made, alone: of a mesh without a study.
Judgement judge_groups(const Study& study);
std::vector<BrokenRule> broken_rules(const Study& study);

/// Throws InputError with every broken rule, each with its path.
void validate(const Study& study);

} // namespace rubato::study
