// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/report.hpp"

namespace rubato::step {

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
  case Outcome::converged:
    return "converged";
  case Outcome::too_many_iterations:
    return "too many iterations";
  case Outcome::singular_matrix:
    return "singular matrix";
  case Outcome::not_finite:
    return "a value is not finite";
  case Outcome::geometry_unsettled:
    return "too many rounds of the geometry loop";
  case Outcome::friction_unsettled:
    return "too many rounds of the friction loop";
  case Outcome::status_unsettled:
    return "too many rounds of the status loop";
  }
  return "";
}

std::string_view to_string(LoopLevel level) {
  switch (level) {
  case LoopLevel::geometry:
    return "geometry";
  case LoopLevel::friction:
    return "friction";
  case LoopLevel::status:
    return "status";
  }
  return "";
}

} // namespace rubato::step
