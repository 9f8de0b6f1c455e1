// SPDX-License-Identifier: LGPL-3.0-or-later
// The procedure of a step.
#include "rubato/ccx/draft.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::ccx {
namespace {

using study::SchemeKind;
using study::TimeStepping;

std::string frequency_lines(const Frequencies& modes) {
  std::string text = fmt::format("*FREQUENCY, STORAGE=NO\n{}", modes.number);
  if (modes.lowest > 0 || modes.highest)
    text += fmt::format(", {}", shown_number(modes.lowest));
  if (modes.highest)
    text += fmt::format(", {}", shown_number(*modes.highest));
  return text + "\n";
}

/// Steps that need no iterations have the instants of the run; others may be cut by CalculiX.
bool is_direct(const Run& run) {
  const auto& study = run.study();
  const bool touches =
      std::ranges::any_of(study.contact, [](const study::ContactZone& zone) { return !zone.tie; });
  return has_equal_steps(study.time) && study::is_linear(study) && !touches;
}

/// First increment and period; least and largest increment of steps that CalculiX may cut.
std::string increments(Run& run) {
  const auto instants = instants_of(run.study().time);
  const double period = instants.back() - instants.front();
  const double first = instants[1] - instants[0];
  if (is_direct(run))
    return fmt::format("{}, {}\n", shown_number(first), shown_number(period));
  double largest = 0;
  for (std::size_t i = 0; i + 1 < instants.size(); ++i)
    largest = std::max(largest, instants[i + 1] - instants[i]);
  if (!has_equal_steps(run.study().time))
    add_note(run.draft, fmt::format("{}: steps of several lengths are left to CalculiX, up to {}",
                                    run.study().name, shown_number(largest)));
  constexpr double least = 1e-9;
  return fmt::format("{}, {}, {}, {}\n", shown_number(first), shown_number(period),
                     shown_number(least * period), shown_number(largest));
}

/// α of the method of Hilber, Hughes and Taylor, which CalculiX has.
double alpha_of(Run& run) {
  const auto& time = run.study().time;
  const auto differs = [&](std::string_view what) {
    add_note(run.draft,
             fmt::format("time.scheme: {} is written as the alpha method of CalculiX{}: small steps give the "
                         "same",
                         study::word_of(study::scheme_words, time.scheme), what));
  };
  switch (time.scheme) {
  case SchemeKind::newmark:
    if (time.beta.value_or(0.25) != 0.25 || time.gamma.value_or(0.5) != 0.5)
      run.refuse("time.beta",
                 fmt::format("found beta {} and gamma {}; CalculiX has the alpha method, expected 1/4 and "
                             "1/2, or hht",
                             time.beta.value_or(0.25), time.gamma.value_or(0.5)));
    return 0;
  case SchemeKind::hht:
    return time.alpha;
  case SchemeKind::generalized_alpha:
    differs(" with the same spectral radius, 0.5 at least");
    return std::max(-1.0 / 3.0, (time.spectral_radius - 1) / (time.spectral_radius + 1));
  case SchemeKind::modified_average_acceleration:
    differs(" with that alpha, -1/3 at least");
    return std::max(-1.0 / 3.0, time.alpha);
  case SchemeKind::moreau_jean:
    if (!run.study().contact.empty())
      differs(" without jumps of velocities");
    else if (time.theta != 0.5)
      differs(", which damps nothing");
    return 0;
  case SchemeKind::wbz_alpha:
    differs(" with a third of its alpha");
    return time.alpha / 3;
  default:
    break;
  }
  run.refuse("time.scheme", fmt::format("found {}; CalculiX has no such scheme, expected another one",
                                        study::word_of(study::scheme_words, time.scheme)));
  return 0;
}

void note_damping(Run& run, double alpha) {
  if (alpha != 0 && run.model.has_damping)
    add_note(run.draft,
             "CalculiX weighs forces of damping with alpha, rubato takes those at the end of a step: 0.4 to "
             "2 % of damped motions");
}

} // namespace

std::string procedure_lines(Run& run, const std::optional<Frequencies>& modes) {
  const auto* nonlinear = run.nonlinear && !run.modes ? ", NLGEOM" : "";
  if (modes)
    return "*STEP\n" + frequency_lines(*modes);
  const auto* direct = is_direct(run) ? ", DIRECT" : "";
  const auto step = fmt::format("*STEP, INC=10000000, AMPLITUDE=STEP{}\n", nonlinear);
  if (run.is_static())
    return fmt::format("{}*STATIC{}\n{}", step, direct, increments(run));
  const double alpha = alpha_of(run);
  note_damping(run, alpha);
  return fmt::format("{}*DYNAMIC{}, ALPHA={}\n{}", step, direct, shown_number(alpha), increments(run));
}

} // namespace rubato::ccx
