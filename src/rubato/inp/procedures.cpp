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

std::optional<int> number_of_modes(Reading& reading, const Word& word) {
  constexpr std::int64_t most_modes = 1'000'000;
  const auto count = mesh::inp::require_integer(word, "the number of modes", reading.faults);
  if (count && (*count < 1 || *count > most_modes))
    reading.faults.add(word, fmt::format("found {} modes, expected 1 or more", *count));
  return count ? std::optional(static_cast<int>(std::clamp<std::int64_t>(*count, 1, most_modes)))
               : std::nullopt;
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
  step.direct = block.find("DIRECT") != nullptr;
  step.largest = largest;
}

} // namespace

void read_static(Reading& reading, const Placed& placed, Step& step) {
  if (!begin_procedure(reading, placed, step, Procedure::steps))
    return;
  step.time.scheme = study::SchemeKind::static_steps;
  if (const auto* stabilize = placed.block->find("STABILIZE"); stabilize != nullptr)
    note(reading, stabilize->name, "STABILIZE is not used: nothing damps a static step in rubato");
  read_increments(reading, placed, step);
}

void read_visco(Reading& reading, const Placed& placed, Step& step) {
  read_static(reading, placed, step);
  step.viscous = true;
  step.ramp = false;
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
    const auto least =
        mesh::inp::require_number(field(fields, 2, Word{}), "the smallest increment", reading.faults, 0);
    if (least.value_or(0) > 0) {
      step.time.mass_scaling = least;
      note(reading, block.at,
           fmt::format(
               "cells whose stable increment is below {}, the third number of the line, get more mass, "
               "as in CalculiX",
               *least));
    }
    constexpr double records = 1000;
    step.time.record = step.time.end / records;
    return;
  }
  read_increments(reading, placed, step);
  if (!step.direct)
    note(reading, block.at,
         fmt::format("increments are {} throughout (shorter where a step does not converge); "
                     "Abaqus and CalculiX choose their own without DIRECT",
                     step.time.step));
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
  const auto is_damped = [](const auto& part) {
    return part.second.material.rayleigh_mass != 0 || part.second.material.rayleigh_stiffness != 0;
  };
  if (step.time.alpha != 0 &&
      (std::ranges::any_of(reading.materials, is_damped) ||
       std::ranges::any_of(reading.study.connectors, [](const auto& c) { return c.damping != 0; })))
    note(reading, block.at,
         "damping forces are those at the end of an increment; Abaqus and CalculiX weigh "
         "them with ALPHA as internal forces, which differs by a part of ALPHA");
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
  const auto& block = *placed.block;
  const auto fields = mesh::inp::fields_at(block, 0);
  const auto word = [&](std::size_t i) { return i < fields.size() ? fields[i] : Word{}; };
  if (!word(0).empty())
    step.modes.number = number_of_modes(reading, word(0));
  const auto* const solver = block.find("EIGENSOLVER");
  const bool by_subspace = solver != nullptr && compact(solver->value.text) == "SUBSPACE";
  const std::size_t highest = by_subspace ? 1 : 2, shift = highest + 1;
  const auto number = [&](std::size_t i, std::string_view what) {
    return word(i).empty() ? std::nullopt : mesh::inp::require_number(word(i), what, reading.faults);
  };
  if (!by_subspace)
    step.modes.lowest = std::max(0.0, number(1, "the lowest frequency").value_or(0));
  if (const auto value = number(highest, "the highest frequency"); value.value_or(0) > 0)
    step.modes.highest = value;
  if (number(shift, "a shift").value_or(0) != 0)
    reading.faults.add(word(shift), fmt::format("found the shift {}, around which modes would be chosen, "
                                                "expected none: rubato chooses by the number and the range",
                                                word(shift).text));
  if (step.modes.highest && *step.modes.highest <= step.modes.lowest)
    reading.faults.add(word(highest), fmt::format("found {} as the highest frequency, expected more than the "
                                                  "lowest, {}",
                                                  *step.modes.highest, step.modes.lowest));
  if (std::any_of(fields.begin() + static_cast<std::ptrdiff_t>(std::min(shift + 1, fields.size())),
                  fields.end(), [](const Word& rest) { return !rest.empty(); }))
    leave_out(reading, fields[0], "numbers of the eigenvalue solver");
}

} // namespace rubato::inp
