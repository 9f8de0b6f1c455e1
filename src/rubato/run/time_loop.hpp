// SPDX-License-Identifier: LGPL-3.0-or-later
/// The whole story of a run, for other programs: run_study with all that its arguments and results consist
/// of.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/model/model.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/step/report.hpp"
#include "rubato/study/study.hpp"
