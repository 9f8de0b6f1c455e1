// SPDX-License-Identifier: LGPL-3.0-or-later
/// What one implicit step of SDNL140 costs in the midst of contact, at 6 ms, cells cut 1, 2, 4 times.
///   CondensedStep   the step, its compliance known from the steps before
///   ContactIterate  kinematics and equations of all contact points, as each iteration evaluates them
/// Arguments: 0 F, 1 C; how often cells are cut. Counters: iterations and points in contact of the step; solve,
/// the seconds of processor time of a forward and backward solve with its factor.
#include "rubato/model/model.hpp"
#include "rubato/run/loop_parts.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/contact_side.hpp"
#include "rubato/step/start.hpp"
#include "rubato/time/step_control.hpp"

#include <benchmark/benchmark.h>

#include "sdnl140.hpp"
#include <array>
#include <stdexcept>

namespace {

using namespace rubato;
using Eigen::VectorXd;

constexpr std::array decks{"f.yaml", "c.yaml"};
constexpr double instant = 6e-3; ///< [s]
