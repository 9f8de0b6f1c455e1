// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a run would be, before anything is computed or written.
#pragma once

#include "rubato/study/study.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rubato::run {

struct Plan {
  std::size_t nodes = 0;
  std::size_t cells = 0;
  std::size_t unknowns = 0;
  std::size_t contact_points = 0;
  std::size_t steps = 0;                   ///< before any is cut; 0 of an explicit run
  std::string method;                      ///< of an explicit run its steps, in a sentence
  std::optional<std::size_t> factor_bytes; ///< what factoring the matrix takes, where it is known beforehand
  std::vector<std::string> notes;          ///< sentences that whoever runs it should read
};

/// Builds mesh and model, and analyses the matrix without factoring it. The memory of a run that starts from
/// another one, of an explicit run and of `solver: full` is not known. Throws InputError for all that is
/// refused before the first step, but for the end that a run starts from.
Plan plan_of(const study::Study& study);

} // namespace rubato::run
