// SPDX-License-Identifier: LGPL-3.0-or-later
// Requests of results: histories as probes, fields as files.
#include "rubato/core/naming.hpp"
#include "rubato/inp/steps.hpp"
#include "rubato/study/stored_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace rubato::inp {
namespace {

using mesh::inp::compact;

struct Variable {
  std::string_view word;
  study::ProbeField field;
};
constexpr std::array variables{
    Variable{"U", study::ProbeField::displacement}, Variable{"UT", study::ProbeField::displacement},
    Variable{"V", study::ProbeField::velocity},     Variable{"A", study::ProbeField::acceleration},
    Variable{"RF", study::ProbeField::reaction},    Variable{"RT", study::ProbeField::reaction},
    Variable{"NT", study::ProbeField::temperature}, Variable{"UR", study::ProbeField::rotation}};

/// The variable of a word, U1 and RF2 being of U and RF.
const Variable* variable_named(std::string_view text) {
  auto word = compact(text);
  const auto* found = std::ranges::find(variables, std::string_view(word), &Variable::word);
  if (found == variables.end() && word.size() > 1 && word.back() >= '1' && word.back() <= '6') {
    word.pop_back();
    found = std::ranges::find(variables, std::string_view(word), &Variable::word);
  }
  return found == variables.end() ? nullptr : found;
}

void add_probe(Step& step, std::string name, const Variable& variable, std::string on,
               study::ProbeTake take) {
  study::Probe probe;
  std::ranges::replace_if(
      name,
      [](char letter) {
        return !(std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '-');
      },
      '_');
  probe.name = fmt::format("{}_{}", name, variable.word);
  probe.node = std::move(on);
  probe.field = variable.field;
  probe.take = take;
  const bool known =
      std::ranges::find(step.requests.probes, probe.name, &study::Probe::name) != step.requests.probes.end();
  if (known)
    return;
  step.requests.probes.push_back(std::move(probe));
}

/// Forces of a set are summed, all else is of each node, of few nodes.
void add_probes(Reading& reading, const Target& target, std::string_view label, const Variable& variable,
                const Word& at, Step& step) {
  constexpr std::size_t most_nodes = 50;
  if (target.reference != nullptr) {
    if (study::is_of_reference(variable.field) && !target.reference->rotations)
      add_probe(step, target.name, variable, target.name, study::ProbeTake::node);
    else
      leave_out(reading, at, fmt::format("{} of a reference node", variable.word));
  } else if (variable.field == study::ProbeField::rotation) {
    leave_out(reading, at, "UR of nodes without rotations");
  } else if (target.nodes.size() == 1) {
    add_probe(step, std::string(label), variable, target.name, study::ProbeTake::node);
  } else if (study::is_force(variable.field)) {
    add_probe(step, std::string(label), variable, target.name, study::ProbeTake::sum);
  } else if (target.nodes.size() <= most_nodes) {
    for (const auto node : target.nodes)
      add_probe(step, fmt::format("{}_{}", label, node_name(reading, node)), variable,
                node_name(reading, node), study::ProbeTake::node);
  } else {
    leave_out(
        reading, at,
        fmt::format("histories of {} of {} nodes, which fields have", variable.word, target.nodes.size()));
  }
}

} // namespace

void read_node_history(Reading& reading, const Placed& placed, Step& step) {
  const auto& block = *placed.block;
  if (block.is("NODE OUTPUT") && step.of_fields)
    return; // the files have every node
  const auto* const set = block.find("NSET");
  if (set == nullptr)
    return leave_out(reading, block.at, fmt::format("{} without NSET", block.at.text));
  step.requests.some = true;
  const auto target = find_target(reading, placed.scope, set->value);
  for (const auto& line : block.lines)
    for (const auto& word : mesh::inp::fields_of(line)) {
      const auto* const variable = variable_named(word.text);
      if (variable == nullptr)
        leave_out(reading, word, fmt::format("{} in {}", shown(std::string(word.text)), block.at.text));
      else if (target)
        add_probes(reading, *target, set->value.text, *variable, block.at, step);
    }
}

void read_field_request(Reading& reading, const Placed& placed, Step& step) {
  const auto& block = *placed.block;
  if (block.is("OUTPUT")) {
    step.of_fields = block.find("FIELD") != nullptr;
    if (!step.of_fields)
      return;
  }
  auto& fields = step.requests.fields;
  step.requests.some = true;
  fields.vtu = true;
  const auto number = [&](std::string_view key) -> std::optional<double> {
    const auto* const given = block.find(key);
    return given == nullptr
               ? std::nullopt
               : mesh::inp::require_number(given->value, "the value of the parameter", reading.faults);
  };
  const double begin = step.time.begin;
  const double length = step.time.end - begin;
  double interval = number("TIMEINTERVAL").value_or(0);
  if (const auto count = number("NUMBERINTERVAL"); count && *count >= 1)
    interval = length / *count;
  constexpr double most_instants = 10'000;
  if (interval > 0 && length / interval <= most_instants) {
    fields.at.clear();
    for (int i = 1; begin + i * interval < begin + length * (1 - 1e-9); ++i)
      fields.at.push_back(begin + i * interval);
  } else {
    const double every = std::clamp(number("FREQUENCY").value_or(1), 0.0, 1e9);
    fields.every = static_cast<int>(every);
  }
}

} // namespace rubato::inp
