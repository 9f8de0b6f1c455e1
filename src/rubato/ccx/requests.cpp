// SPDX-License-Identifier: LGPL-3.0-or-later
// Requests of results.
#include "rubato/ccx/draft.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rubato::ccx {
namespace {

using study::PrintedTable;
using study::ProbeField;
using study::TableOf;

constexpr std::array node_words{std::string_view("U"), std::string_view("V"), std::string_view("RF"),
                                std::string_view("NT")};
constexpr std::array cell_words{
    std::string_view("S"),    std::string_view("E"),    std::string_view("ME"),
    std::string_view("PEEQ"), std::string_view("ENER"), std::string_view("ELSE"),
    std::string_view("ELKE"), std::string_view("EVOL"), std::string_view("COORD")};

std::string_view word_of(ProbeField field) {
  switch (field) {
  case ProbeField::displacement:
    return "U";
  case ProbeField::velocity:
    return "V";
  case ProbeField::reaction:
    return "RF";
  case ProbeField::temperature:
    return "NT";
  default:
    return {};
  }
}

template <class Words>
std::vector<std::string> known(Run& run, const PrintedTable& table, const Words& words) {
  std::vector<std::string> kept;
  for (const auto& quantity : table.quantities)
    if (std::ranges::find(words, std::string_view(quantity)) != words.end())
      kept.push_back(quantity);
    else
      add_note(run.draft,
               fmt::format("fields.tables: {} is left out, which CalculiX does not print there", quantity));
  return kept;
}

std::string frequency(int every) {
  return every > 1 ? fmt::format(", FREQUENCY={}", every) : std::string();
}

std::string totals_of(study::TableTotals totals) {
  return totals == study::TableTotals::none   ? ""
         : totals == study::TableTotals::also ? ", TOTALS=YES"
                                              : ", TOTALS=ONLY";
}

/// A set also of a single node, as *NODE PRINT takes no numbers.
std::string set_of(Run& run, std::span<const mesh::NodeIndex> nodes, const std::string& name) {
  const auto label = label_of_nodes(run, nodes, name);
  if (nodes.size() > 1)
    return label;
  const std::vector<std::int64_t> content{run.draft.node_numbers[static_cast<std::size_t>(nodes.front())]};
  auto& known = run.draft.node_sets_by_content;
  if (!known.contains(content)) {
    known[content] = run.draft.labels.chosen("NSET", name);
    run.draft.more_sets += fmt::format("*NSET, NSET={}\n{}\n", known[content], label);
  }
  return known[content];
}

/// Nodes with the quantities that are printed for them.
using Printed = std::set<std::pair<mesh::NodeIndex, std::string>>;

std::string node_table(Run& run, const PrintedTable& table, Printed& printed) {
  const auto words = known(run, table, node_words);
  const bool all = table.on.empty() || table.on == study::everywhere;
  const auto nodes = all ? run.model.dofs.nodes : mesh::find_nodes(run.model.mesh, table.on).nodes;
  if (words.empty() || nodes.empty())
    return {};
  if (table.totals != study::TableTotals::only && table.every <= 1)
    for (const auto node : nodes)
      for (const auto& word : words)
        printed.emplace(node, word);
  return fmt::format("*NODE PRINT, NSET={}{}{}\n{}\n",
                     set_of(run, nodes, table.on.empty() ? "all" : table.on), totals_of(table.totals),
                     frequency(table.every), fmt::join(words, "\n"));
}

std::string probe_lines(Run& run, const Printed& printed) {
  std::map<std::string, std::set<std::string>> words;
  const auto& study = run.study();
  for (std::size_t i = 0; i < study.probes.size(); ++i) {
    const auto& probe = study.probes[i];
    if (!probe.minus.empty())
      continue;
    const std::string word(word_of(probe.field));
    const auto& nodes = run.model.probe_nodes[i];
    if (word.empty() || nodes.empty() || probe.place != study::ProbePlace::nodes) {
      add_note(run.draft,
               fmt::format("probes.{} is left out: CalculiX prints displacements, velocities, reactions "
                           "and temperatures of nodes",
                           probe.name));
      continue;
    }
    const bool is_known = nodes.size() == 1 && printed.contains({nodes.front(), word});
    if (is_known || (word == "V" && run.is_static()))
      continue;
    const bool is_sum = probe.take == study::ProbeTake::sum && word == "RF";
    const auto set = set_of(run, nodes, probe.node.empty() || nodes.size() == 1 ? probe.name : probe.node);
    words[fmt::format("*NODE PRINT, NSET={}{}", set, is_sum ? ", TOTALS=YES" : "")].insert(word);
  }
  std::string text;
  for (const auto& [keyword, quantities] : words)
    text += fmt::format("{}\n{}\n", keyword, fmt::join(quantities, "\n"));
  return text;
}

std::string cell_table(Run& run, const PrintedTable& table) {
  const auto words = known(run, table, cell_words);
  if (words.empty())
    return {};
  std::vector<std::string> sets;
  if (table.on.empty() || table.on == study::everywhere)
    for (const auto& of_law : run.draft.element_sets_of_law)
      sets.insert(sets.end(), of_law.begin(), of_law.end());
  else if (run.draft.element_sets.contains(table.on))
    sets.push_back(run.draft.element_sets.at(table.on));
  std::string text;
  for (const auto& set : sets)
    text += fmt::format("*EL PRINT, ELSET={}{}{}\n{}\n", set, totals_of(table.totals), frequency(table.every),
                        fmt::join(words, "\n"));
  return text;
}

std::string file_lines(const Run& run) {
  const auto& fields = run.study().fields;
  const auto every = frequency(fields.every == 0 ? 1'000'000 : fields.every);
  const bool dynamic = !run.is_static() && !run.modes;
  const bool plastic = std::ranges::any_of(
      run.study().materials, [](const auto& material) { return material.law == study::LawKind::plastic; });
  std::string of_cells = "S\nE\n";
  if (plastic && !run.modes)
    of_cells += "PEEQ\n";
  if (run.draft.steps.empty() && !run.modes)
    of_cells += "ENER\n"; // later motions and tables of energies need that of the first step
  return fmt::format("*NODE FILE{}\nU\n{}{}*EL FILE{}\n{}", every, dynamic ? "V\n" : "",
                     run.modes ? "" : "RF\n", every, of_cells);
}

} // namespace

std::string request_lines(Run& run) {
  auto text = file_lines(run);
  if (run.modes)
    return text;
  Printed printed;
  for (const auto& table : run.study().fields.tables)
    if (table.of == TableOf::nodes)
      text += node_table(run, table, printed);
    else if (table.of == TableOf::cells)
      text += cell_table(run, table);
    else
      add_note(run.draft, "fields.tables: those of faces and zones are left out");
  return text + probe_lines(run, printed);
}

} // namespace rubato::ccx
