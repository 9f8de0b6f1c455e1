// SPDX-License-Identifier: LGPL-3.0-or-later
// Requests of nodes as probes.
#include "rubato/core/naming.hpp"
#include "rubato/inp/steps.hpp"
#include "rubato/study/stored_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace rubato::inp {
namespace {

using mesh::inp::Family;

struct ProbeWord {
  std::string_view word;
  study::ProbeField field;
};
constexpr std::array probe_words{
    ProbeWord{"U", study::ProbeField::displacement}, ProbeWord{"UT", study::ProbeField::displacement},
    ProbeWord{"V", study::ProbeField::velocity},     ProbeWord{"VT", study::ProbeField::velocity},
    ProbeWord{"A", study::ProbeField::acceleration}, ProbeWord{"AT", study::ProbeField::acceleration},
    ProbeWord{"RF", study::ProbeField::reaction},    ProbeWord{"RT", study::ProbeField::reaction},
    ProbeWord{"NT", study::ProbeField::temperature}, ProbeWord{"UR", study::ProbeField::rotation}};

/// The row of a word, U1 and RF2 being of U and RF.
const ProbeWord* probe_word(std::string_view word) {
  auto found = std::ranges::find(probe_words, word, &ProbeWord::word);
  if (found == probe_words.end() && word.size() > 1 && word.back() >= '1' && word.back() <= '6')
    found = std::ranges::find(probe_words, word.substr(0, word.size() - 1), &ProbeWord::word);
  return found == probe_words.end() ? nullptr : found;
}

void add_probe(Step& step, std::string name, const ProbeWord& word, std::string on, study::ProbeTake take) {
  std::ranges::replace_if(
      name,
      [](char letter) {
        return !(std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '-');
      },
      '_');
  study::Probe probe;
  probe.name = fmt::format("{}_{}", name, word.word);
  probe.node = std::move(on);
  probe.field = word.field;
  probe.take = take;
  auto& probes = step.requests.probes;
  if (std::ranges::find(probes, probe.name, &study::Probe::name) == probes.end())
    probes.push_back(std::move(probe));
}

/// Nodes of elements that become cells of the study.
std::vector<std::int32_t> with_cells(const Reading& reading, std::vector<std::int32_t> nodes) {
  std::vector<bool> used(reading.content.points.size(), false);
  for (const auto& element : reading.content.elements)
    if (element.type->family <= Family::axisymmetric)
      for (const auto node : reading.content.nodes_of(element))
        used[static_cast<std::size_t>(node)] = true;
  std::erase_if(nodes, [&](std::int32_t node) { return !used[static_cast<std::size_t>(node)]; });
  return nodes;
}

} // namespace

/// Forces of a set are summed; all else is of each node, of few nodes.
bool add_probes(Reading& reading, const Placed& placed, const Word& set, std::string_view word, Step& step) {
  constexpr std::size_t most_nodes = 50;
  const auto* const row = probe_word(word);
  const auto found = mesh::inp::find_nodes(reading.content, placed.scope, set, reading.faults);
  if (row == nullptr || !found)
    return false;
  const std::string label(set.text);
  std::size_t references = 0;
  for (const auto node : found->items) {
    const auto reference = reading.references.find(node);
    if (reference == reading.references.end())
      continue;
    ++references;
    const auto name =
        found->items.size() == 1 ? label : fmt::format("{}_{}", label, node_name(reading, node));
    if (reference->second.rotations)
      add_probe(step, name, *probe_word("UR"), reference->second.relation, study::ProbeTake::node);
    else if (study::is_of_reference(row->field))
      add_probe(step, name, *row, reference->second.relation, study::ProbeTake::node);
  }
  const auto nodes = with_cells(reading, found->items);
  if (nodes.empty() || row->field == study::ProbeField::rotation)
    return references > 0;
  if (nodes.size() == 1 && found->items.size() == 1)
    add_probe(step, label, *row, found->is_set ? found->name : node_name(reading, nodes.front()),
              study::ProbeTake::node);
  else if (study::is_force(row->field))
    add_probe(step, label, *row, found->name, study::ProbeTake::sum);
  else if (nodes.size() <= most_nodes)
    for (const auto node : nodes)
      add_probe(step, fmt::format("{}_{}", label, node_name(reading, node)), *row, node_name(reading, node),
                study::ProbeTake::node);
  return true;
}

} // namespace rubato::inp
