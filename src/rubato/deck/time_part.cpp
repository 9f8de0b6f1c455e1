// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rubato::deck {
namespace {

/// More would neither end nor be counted in an int.
constexpr double most_steps = 1e9;
/// An end that is not a whole number of steps away by rounding only.
constexpr double rounding = 1e-9;

/// A number that only some schemes take.
struct SchemeKey {
  std::string_view key;
  std::string_view takers;
};
constexpr std::array<SchemeKey, 7> scheme_keys{{{"alpha", "hht and modified_average_acceleration take it"},
                                                {"beta", "newmark takes it"},
                                                {"gamma", "newmark takes it"},
                                                {"spectral_radius", "generalized_alpha takes it"},
                                                {"theta", "moreau_jean takes it"},
                                                {"safety", "central_difference takes it"},
                                                {"record", "central_difference takes it"}}};
/// Results an explicit run keeps when the deck doesn't say how many: its steps are too many to keep each.
constexpr double usual_records = 1000;

bool takes(study::SchemeKind scheme, std::string_view key) {
  switch (scheme) {
  case study::SchemeKind::newmark:
    return key == "beta" || key == "gamma";
  case study::SchemeKind::hht:
  case study::SchemeKind::modified_average_acceleration:
    return key == "alpha";
  case study::SchemeKind::generalized_alpha:
    return key == "spectral_radius";
  case study::SchemeKind::moreau_jean:
    return key == "theta";
  case study::SchemeKind::central_difference:
    return key == "safety" || key == "record";
  case study::SchemeKind::static_steps:
    return false;
  }
  return false;
}

void read_scheme(MapReader& map, Context& context, study::TimeStepping& time) {
  const auto named = map.find("scheme");
  if (named && !read(named, time.scheme, study::scheme_words)) {
    for (const auto& known : scheme_keys)
      map.find(known.key);
    return;
  }
  context.scheme = time.scheme;
  const bool jumps = time.scheme == study::SchemeKind::moreau_jean;
  time.contact_mass = jumps ? study::ContactMass::redistributed : study::ContactMass::consistent;
  const auto scheme = study::word_of(study::scheme_words, time.scheme);
  for (const auto& [key, takers] : scheme_keys)
    if (!takes(time.scheme, key))
      map.refuse(key, fmt::format("the scheme {} takes no {}, {}; a run removes it by '{}: ~'", scheme, key,
                                  takers, key));
  switch (time.scheme) {
  case study::SchemeKind::newmark:
    read(map.find("beta"), time.beta, between(0, 1));
    read(map.find("gamma"), time.gamma, from_to(0.5, 2)); // below 1/2 it feeds energy in
    break;
  case study::SchemeKind::hht:
    read(map.require("alpha"), time.alpha, from_to(-1.0 / 3.0, 0));
    break;
  case study::SchemeKind::modified_average_acceleration:
    read(map.require("alpha"), time.alpha, at_most(0));
    break;
  case study::SchemeKind::generalized_alpha:
    read(map.find("spectral_radius"), time.spectral_radius, from_to(0, 1));
    break;
  case study::SchemeKind::moreau_jean:
    read(map.find("theta"), time.theta, from_to(0.5, 1));
    break;
  case study::SchemeKind::central_difference:
    read(map.find("safety"), time.safety, Range{.low = 0, .high = 1, .low_allowed = false});
    break; // `record` is judged by the length of the run
  case study::SchemeKind::static_steps:
    break;
  }
}

/// A length of time that must fit into the run, and not too often.
void check_fits(const Found& value, double part, double length) {
  if (part > length * (1 + rounding))
    value->fault(fmt::format("found {}, expected at most the length of the run, {}", part, length));
  else if (length / part > most_steps)
    value->fault(fmt::format("found {}, which makes more than {:g} steps", part, most_steps));
}

/// The length of the run from `begin` and `end`, unless one of them is bad.
std::optional<double> read_end(const Found& end, bool begin_read, study::TimeStepping& time) {
  if (!read(end, time.end) || !begin_read)
    return std::nullopt;
  const double length = time.end - time.begin;
  if (length > 0 && std::isfinite(length))
    return length;
  end->fault(fmt::format("found {}, expected more than the begin, {}", time.end, time.begin));
  return std::nullopt;
}

/// `step` and `end`.
void read_even_steps(const Found& step, const Found& end, bool begin_read, study::TimeStepping& time) {
  const bool step_read = read(step, time.step, above(0));
  const auto length = read_end(end, begin_read, time);
  if (step_read && length)
    check_fits(step, time.step, *length);
}

/// `step: auto` or a number, `end` and `record` of an explicit run.
void read_explicit_steps(MapReader& map, bool begin_read, study::TimeStepping& time) {
  const auto step = map.find("step");
  const bool given = step && step->tree().text != study::automatic_step && read(step, time.step, above(0));
  const auto length = read_end(map.require("end"), begin_read, time);
  const auto record = map.find("record");
  const bool recorded = record && read(record, time.record, above(0));
  if (!length)
    return;
  if (given)
    check_fits(step, time.step, *length);
  if (recorded)
    check_fits(record, time.record, *length);
  else if (!record)
    time.record = *length / usual_records;
}

void read_instants(const Found& instants, bool begin_read, study::TimeStepping& time) {
  if (!read(instants, time.instants) || !ascends(instants, time.instants))
    return;
  if (time.instants.empty()) {
    instants->fault("found an empty list, expected at least one instant");
    return;
  }
  time.end = time.instants.back();
  if (begin_read && time.instants.front() <= time.begin)
    instants->fault(
        fmt::format("found {}, expected instants after the begin, {}", time.instants.front(), time.begin),
        instants->tree().items.front().at);
}

void read_course(MapReader& map, study::TimeStepping& time) {
  const auto begin = map.find("begin");
  const bool begin_read = !begin || read(begin, time.begin);
  if (study::is_explicit(time.scheme)) {
    map.refuse("instants",
               "the scheme central_difference chooses its steps; results are kept every 'record'");
    read_explicit_steps(map, begin_read, time);
    return;
  }
  if (const auto instants = map.find("instants")) {
    for (const auto* key : {"step", "end"})
      map.refuse(key, "the steps are listed by 'instants' already");
    read_instants(instants, begin_read, time);
  } else {
    const auto step = map.require("step");
    read_even_steps(step, map.require("end"), begin_read, time);
  }
}

/// A word, or `{from: run}`.
void read_start(const Found& value, study::TimeStepping& time) {
  if (!value)
    return;
  if (value->tree().is(Tree::Kind::map)) {
    MapReader map(*value);
    time.start = study::StartKind::from_run;
    read(map.require("from"), time.start_run);
    map.finish();
  } else if (read(value, time.start, study::start_words) &&
             time.start == study::StartKind::at_rest_unloaded &&
             time.scheme == study::SchemeKind::static_steps) {
    value->fault("the scheme static has no first acceleration, expected consistent or {from: run}");
  }
  if (study::is_explicit(time.scheme) && time.start != study::StartKind::consistent)
    value->fault("the scheme central_difference starts from the true equilibrium, expected consistent");
}

void read_contact_mass(const Found& value, study::TimeStepping& time) {
  if (!read(value, time.contact_mass, study::contact_mass_words) ||
      time.contact_mass == study::ContactMass::consistent)
    return;
  if (time.scheme == study::SchemeKind::static_steps)
    value->fault("the scheme static has no masses, expected consistent");
  if (study::is_explicit(time.scheme))
    value->fault("the scheme central_difference divides by the mass of every node, expected consistent");
}

void read_failure(const Found& value, study::TimeStepping& time) {
  if (!value)
    return;
  MapReader map(*value);
  read(map.find("cut"), time.cut_parts, from_to(2, 1000));
  read(map.find("levels"), time.cut_levels, from_to(0, 50));
  map.finish();
}

} // namespace

void read_time(const Found& value, Context& context, study::TimeStepping& time) {
  if (!value)
    return;
  time.at = value->at();
  MapReader map(*value);
  read_scheme(map, context, time);
  read_contact_mass(map.find("contact_mass"), time);
  read_course(map, time);
  read_start(map.find("start"), time);
  if (study::is_explicit(time.scheme))
    map.refuse("on_failure", "the scheme central_difference has no steps that fail");
  else
    read_failure(map.find("on_failure"), time);
  map.finish();
  if (time.end > time.begin)
    context.time = from_to(time.begin, time.end);
}

void read_newton(const Found& value, study::NewtonSettings& newton) {
  if (!value)
    return;
  MapReader map(*value);
  read(map.find("max_iterations"), newton.max_iterations, from_to(1, 1'000'000));
  read(map.find("residual"), newton.residual, between(0, 1));
  map.finish();
}

} // namespace rubato::deck
