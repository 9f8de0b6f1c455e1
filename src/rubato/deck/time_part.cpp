// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/parts.hpp"
#include "rubato/deck/rows.hpp"
#include "rubato/study/bounds.hpp"

#include <fmt/format.h>

namespace rubato::deck {
namespace {

/// Results an explicit run keeps when the deck doesn't say how many: its steps are too many to keep each.
constexpr double usual_records = 1000;

void read_scheme(MapReader& map, Context& context, study::TimeStepping& time) {
  const auto named = map.find("scheme");
  if (named && !read(named, time.scheme, study::scheme_words)) {
    pass_numbers(map, study::schemes);
    map.find("record");
    return;
  }
  context.scheme = time.scheme;
  const bool jumps = study::has_jumps(time.scheme);
  time.contact_mass = jumps ? study::ContactMass::redistributed : study::ContactMass::consistent;
  const auto& scheme = study::entry_of(time.scheme);
  read_numbers_of(map, study::schemes, scheme, "the scheme", time);
  if (!study::is_explicit(time.scheme))
    refuse_of_others(map, "record", "the scheme", scheme.name, "central_difference takes it");
}

/// `step: auto` or a number, `end` and `record` of an explicit run.
void read_explicit_steps(MapReader& map, study::TimeStepping& time) {
  if (const auto step = map.find("step"); step && step->tree().text != study::automatic_step)
    read(step, time.step, study::bounds::step); // 0 stands for auto
  read(map.require("end"), time.end);
  if (const auto record = map.find("record"))
    read(record, time.record);
  else if (time.end > time.begin)
    time.record = (time.end - time.begin) / usual_records;
  else
    map.spoil("record");
}

void read_mass_scaling(MapReader& map, study::TimeStepping& time) {
  if (!study::is_explicit(time.scheme)) {
    map.refuse("mass_scaling", fmt::format("the scheme {} has no step that is too long for a cell; "
                                           "central_difference takes it",
                                           word_of(study::scheme_words, time.scheme)));
    return;
  }
  const auto value = map.find("mass_scaling");
  if (!value)
    return;
  MapReader scaling(*value);
  read(scaling.require("step"), time.mass_scaling, study::bounds::scaled_step);
  scaling.finish();
}

void read_instants(const Found& instants, study::TimeStepping& time) {
  if (!read(instants, time.instants))
    return;
  if (time.instants.empty())
    instants->fault("found an empty list, expected at least one instant");
  else
    time.end = time.instants.back();
}

void read_course(MapReader& map, study::TimeStepping& time) {
  read(map.find("begin"), time.begin);
  if (study::is_explicit(time.scheme)) {
    map.refuse("instants",
               "the scheme central_difference chooses its steps; results are kept every 'record'");
    read_explicit_steps(map, time);
    return;
  }
  if (const auto instants = map.find("instants")) {
    for (const auto* key : {"step", "end"})
      map.refuse(key, "the steps are listed by 'instants' already");
    read_instants(instants, time);
  } else {
    read(map.require("step"), time.step);
    read(map.require("end"), time.end);
  }
}

/// A word, or `{from: run}`.
void read_start(const Found& value, study::TimeStepping& time) {
  if (!value)
    return;
  if (!value->tree().is(Tree::Kind::map)) {
    read(value, time.start, study::start_words);
    return;
  }
  MapReader map(*value);
  time.start = study::StartKind::from_run;
  read_name(map.require("from"), time.start_run);
  map.finish();
}

void read_failure(const Found& value, study::TimeStepping& time) {
  if (!value)
    return;
  MapReader map(*value);
  read(map.find("cut"), time.cut_parts);
  read(map.find("levels"), time.cut_levels);
  map.finish();
}

void read_arc_length(const Found& value, study::TimeStepping& time) {
  if (!value)
    return;
  MapReader map(*value);
  time.arc_length.emplace();
  read(map.require("length"), time.arc_length->length, study::bounds::arc_length);
  read_name(map.find("on"), time.arc_length->on);
  map.finish();
}

/// What only nonlinear bodies have.
void read_step_control(MapReader& map, study::TimeStepping& time) {
  if (study::is_explicit(time.scheme)) {
    for (const auto* key : {"max_step", "max_plastic_step"})
      map.refuse(key, "the scheme central_difference chooses its steps by what is stable");
    return;
  }
  read(map.find("max_step"), time.max_step);
  read(map.find("max_plastic_step"), time.max_plastic_step);
}

} // namespace

void read_time(const Found& value, Context& context, study::TimeStepping& time) {
  if (!value)
    return;
  MapReader map(*value);
  read_scheme(map, context, time);
  read(map.find("contact_mass"), time.contact_mass, study::contact_mass_words);
  read_course(map, time);
  read_step_control(map, time);
  read_mass_scaling(map, time);
  read_arc_length(map.find("arc_length"), time);
  read_start(map.find("start"), time);
  if (study::is_explicit(time.scheme))
    map.refuse("on_failure", "the scheme central_difference has no steps that fail");
  else
    read_failure(map.find("on_failure"), time);
  map.finish();
}

void read_newton(const Found& value, study::NewtonSettings& newton) {
  if (!value)
    return;
  MapReader map(*value);
  read(map.find("max_iterations"), newton.max_iterations);
  read(map.find("residual"), newton.residual);
  read(map.find("tangent"), newton.tangent, study::tangent_words);
  map.finish();
}

} // namespace rubato::deck
