// SPDX-License-Identifier: LGPL-3.0-or-later
// What a step computes: its scheme and its instants.
#include "rubato/core/naming.hpp"
#include "rubato/inp/steps.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using mesh::inp::field;

bool begin_procedure(Reading& reading, const Placed& placed, Step& step, Procedure procedure) {
  if (step.procedure != Procedure::none) {
    reading.faults.add(placed.block->at,
                       fmt::format("found {} beside {} in line {}, expected one analysis in a step",
                                   placed.block->at.text, step.procedure_at.text, step.procedure_at.line));
    return false;
  }
  step.procedure = procedure;
  step.procedure_at = placed.block->at;
  step.time.contact_mass = study::ContactMass::consistent;
  return true;
}

/// First increment, period, and the largest increment.
void read_increments(Reading& reading, const Placed& placed, Step& step) {
  const auto& block = *placed.block;
  const auto fields = mesh::inp::fields_at(block, 0);
  const auto number = [&](std::size_t i, std::string_view what) {
    const auto word = field(fields, i, block.at);
    return word.empty() ? 0 : mesh::inp::require_number(word, what, reading.faults).value_or(0);
  };
  const double first = number(0, "the first increment");
  const double period = number(1, "the period of the step");
  const double largest = number(3, "the largest increment");
  if (first < 0 || period < 0 || largest < 0)
    reading.faults.add(field(fields, 0, block.at), "found a negative time of a step, expected times above 0");
  step.time.end = period > 0 ? period : std::max(first, fields.empty() || first == 0 ? 1.0 : first);
  step.time.step = first > 0 ? std::min(first, step.time.end) : step.time.end;
  if (largest > 0)
    step.time.step = std::min(step.time.step, largest);
  if (block.find("DIRECT") == nullptr && step.time.step < step.time.end)
    note(reading, block.at,
         fmt::format("increments are {} throughout (shorter where a step does not converge); Abaqus "
                     "and CalculiX choose their own without DIRECT",
                     step.time.step));
}

} // namespace

void read_static(Reading& reading, const Placed& placed, Step& step) {
  if (!begin_procedure(reading, placed, step, Procedure::steps))
    return;
  step.time.scheme = study::SchemeKind::static_steps;
  read_increments(reading, placed, step);
}

void read_dynamic(Reading& reading, const Placed& placed, Step& step) {
  const auto& block = *placed.block;
  const bool is_explicit = block.find("EXPLICIT") != nullptr;
  if (!begin_procedure(reading, placed, step, is_explicit ? Procedure::explicit_steps : Procedure::dynamic))
    return;
  step.ramp = false;
  if (is_explicit) {
    const auto fields = mesh::inp::fields_at(block, 0);
    step.time.scheme = study::SchemeKind::central_difference;
    const auto first =
        mesh::inp::require_number(field(fields, 0, block.at), "the first increment", reading.faults, 0);
    const auto period =
        mesh::inp::require_number(field(fields, 1, block.at), "the period of the step", reading.faults);
    step.time.end = period.value_or(1);
    step.time.step = block.find("DIRECT") != nullptr ? first.value_or(0) : 0;
    constexpr double records = 1000;
    step.time.record = step.time.end / records;
    return;
  }
  read_increments(reading, placed, step);
  step.time.scheme = study::SchemeKind::hht;
  const auto* const application = block.find("APPLICATION");
  const auto* const alpha = block.find("ALPHA");
  const auto word = application == nullptr ? std::string() : compact(application->value.text);
  if (!word.empty() && word != "TRANSIENTFIDELITY")
    reading.faults.add(
        application->value,
        fmt::format("found APPLICATION={}, whose scheme rubato does not have, expected TRANSIENT FIDELITY, "
                    "or ALPHA= from -1/3 to 0 alone",
                    application->value.text));
  constexpr double usual = -0.05;
  step.time.alpha = alpha == nullptr
                        ? usual
                        : mesh::inp::require_number(alpha->value, "ALPHA", reading.faults).value_or(usual);
  if (alpha == nullptr)
    note(reading, block.at,
         fmt::format("ALPHA is -0.05, as of CalculiX and of APPLICATION=TRANSIENT FIDELITY{}",
                     reading.study.contact.empty() || !word.empty()
                         ? ""
                         : "; Abaqus damps more where there is contact (MODERATE DISSIPATION)"));
}

void read_frequency(Reading& reading, const Placed& placed, Step& step) {
  if (!begin_procedure(reading, placed, step, Procedure::modes))
    return;
  step.time.scheme = study::SchemeKind::newmark;
  step.time.step = step.time.end = 1;
  const auto fields = mesh::inp::fields_at(*placed.block, 0);
  if (fields.empty() || fields[0].empty())
    return;
  constexpr std::int64_t most_modes = 1'000'000;
  const auto count = mesh::inp::require_integer(fields[0], "the number of modes", reading.faults);
  if (count && (*count < 1 || *count > most_modes))
    reading.faults.add(fields[0], fmt::format("found {} modes, expected 1 or more", *count));
  else if (count)
    step.mode_count = static_cast<int>(*count);
  if (std::any_of(fields.begin() + 1, fields.end(), [](const Word& word) { return !word.empty(); }))
    leave_out(reading, fields[0], "limits of frequencies");
}

} // namespace rubato::inp
