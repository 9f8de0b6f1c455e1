// SPDX-License-Identifier: LGPL-3.0-or-later
// Schemes, instants, cutting, and how steps are solved.
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::study {
namespace {

/// More would neither end nor be counted in an int.
constexpr double most_steps = 1e9;
/// An end that is not a whole number of steps away by rounding only.
constexpr double rounding = 1e-9;

void check_mass_scaling(Rules& rules) {
  const auto& time = rules.study.time;
  if (!time.mass_scaling)
    return;
  rules.number("time.mass_scaling.step", *time.mass_scaling, bounds::scaled_step);
  if (!is_explicit(time.scheme))
    rules.broken(
        {"time.mass_scaling", "time.scheme"},
        fmt::format("the scheme {} has no step that is too long for a cell; central_difference takes "
                    "it",
                    word_of(scheme_words, time.scheme)));
}

/// A length of time that must fit into the run, and not too often.
void check_fits(Rules& rules, const std::string& path, double part) {
  const double length = rules.study.time.end - rules.study.time.begin;
  if (!rules.has_time() || !(part > 0))
    return;
  if (part > length * (1 + rounding))
    rules.broken({path, "time.begin", "time.end"},
                 fmt::format("found {}, expected at most the length of the run, {}", part, length));
  else if (length / part > most_steps)
    rules.broken({path, "time.begin", "time.end"},
                 fmt::format("found {}, which makes more than {:g} steps", part, most_steps));
}

void check_length(Rules& rules) {
  const auto& time = rules.study.time;
  rules.number("time.begin", time.begin);
  rules.number("time.end", time.end);
  if (!rules.has_time() || !std::isfinite(time.end - time.begin))
    rules.broken({"time.end", "time.begin"},
                 fmt::format("found {}, expected more than the begin, {}", time.end, time.begin));
}

void check_instants(Rules& rules) {
  const auto& time = rules.study.time;
  rules.ascending("time.instants", time.instants);
  if (time.instants.front() <= time.begin)
    rules.broken(
        {"time.instants.0", "time.begin"},
        fmt::format("found {}, expected instants after the begin, {}", time.instants.front(), time.begin));
}

void check_course(Rules& rules) {
  const auto& time = rules.study.time;
  if (!time.instants.empty() && !is_explicit(time.scheme)) {
    check_instants(rules);
    return;
  }
  check_length(rules);
  rules.number("time.step", time.step, is_explicit(time.scheme) ? at_least(0) : bounds::step);
  check_fits(rules, "time.step", time.step);
  if (!is_explicit(time.scheme))
    return;
  if (!time.instants.empty())
    rules.broken({"time.instants", "time.scheme"},
                 "the scheme central_difference chooses its steps; results are kept every 'record'");
  rules.number("time.record", time.record, bounds::record);
  check_fits(rules, "time.record", time.record);
}

void check_start(Rules& rules) {
  const auto& time = rules.study.time;
  if (time.start == StartKind::from_run)
    rules.name("time.start.from", time.start_run);
  if (time.start == StartKind::at_rest_unloaded && time.scheme == SchemeKind::static_steps)
    rules.broken({"time.start", "time.scheme"},
                 "the scheme static has no first acceleration, expected consistent or {from: run}");
  if (is_explicit(time.scheme) && time.start == StartKind::at_rest_unloaded)
    rules.broken(
        {"time.start", "time.scheme"},
        "the scheme central_difference starts from the true equilibrium, expected consistent or {from: "
        "run}");
}

void check_contact_mass(Rules& rules) {
  const auto& time = rules.study.time;
  if (time.contact_mass == ContactMass::consistent)
    return;
  if (time.scheme == SchemeKind::static_steps)
    rules.broken({"time.contact_mass", "time.scheme"},
                 "the scheme static has no masses, expected consistent");
  if (is_explicit(time.scheme))
    rules.broken({"time.contact_mass", "time.scheme"},
                 "the scheme central_difference divides by the mass of every node, expected consistent");
}
} // namespace

void check_time(Rules& rules) {
  rules.numbers_of(entry_of(rules.study.time.scheme), "time", rules.study.time);
  check_contact_mass(rules);
  check_course(rules);
  check_start(rules);
  check_mass_scaling(rules);
  if (is_explicit(rules.study.time.scheme))
    return;
  rules.whole_number("time.on_failure.cut", rules.study.time.cut_parts, bounds::cut_parts);
  rules.whole_number("time.on_failure.levels", rules.study.time.cut_levels, bounds::cut_levels);
}

void check_solution(Rules& rules) {
  const auto& study = rules.study;
  check_nonlinear_solution(rules);
  rules.whole_number("newton.max_iterations", study.newton.max_iterations, bounds::max_iterations);
  rules.number("newton.residual", study.newton.residual, bounds::residual);
  if (is_explicit(study.time.scheme) && study.solver != Solver::automatic)
    rules.broken({"solver", "time.scheme"}, fmt::format("the scheme {} solves no system, expected auto",
                                                        word_of(scheme_words, study.time.scheme)));
  if (study.solver == Solver::full && std::ranges::any_of(study.contact, predicts_exactly))
    rules.broken(
        {"solver"},
        "found full, but nodal_pcg works on the factored bulk, expected auto, condensed or iterative");
}

} // namespace rubato::study
