// SPDX-License-Identifier: LGPL-3.0-or-later
/// A study as text: what results keep of it.
#pragma once

#include "rubato/study/study.hpp"

#include <string>

namespace rubato::study {

/// The study as a deck of one run, in JSON (which is YAML) with every default written out and two blanks of
/// indentation. It is a deck itself, unless it names other runs.
std::string to_json(const Study& study);

} // namespace rubato::study
