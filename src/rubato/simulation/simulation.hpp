// SPDX-License-Identifier: LGPL-3.0-or-later
/// Time integration of a study, for the program, other programs, tests and benchmarks.
///
///   simulation::Simulation beams(study);
///   while (!beams.finished())
///     if (!beams.advance().accepted())
///       break;
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/study/study.hpp"
