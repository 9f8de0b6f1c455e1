// SPDX-License-Identifier: LGPL-3.0-or-later
// Requests of results by *PRINT and *OUTPUT: tables and histories.
#include "rubato/core/naming.hpp"
#include "rubato/inp/steps.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/table_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using study::TableOf;

/// Words of requests, the place they are of, and what tables call them.
struct TableWord {
  std::string_view word;
  TableOf of;
  std::string_view quantity;
};
constexpr std::array other_words{
    TableWord{"UT", TableOf::nodes, "U"},       TableWord{"RT", TableOf::nodes, "RF"},
    TableWord{"VT", TableOf::nodes, "V"},       TableWord{"AT", TableOf::nodes, "A"},
    TableWord{"CDISP", TableOf::zones, "CDIS"}, TableWord{"CSTRESS", TableOf::zones, "CSTR"},
    TableWord{"CFORCE", TableOf::zones, "CF"}};

/// U for U1, S for S11: components are those of a quantity.
std::string without_component(std::string word) {
  while (word.size() > 1 && word.back() >= '1' && word.back() <= '6')
    word.pop_back();
  return word;
}

std::string_view quantity_named(TableOf of, std::string_view word) {
  const auto known = study::table_words(of);
  for (const auto& name : {std::string(word), without_component(std::string(word))}) {
    if (const auto found = std::ranges::find(known, name); found != known.end())
      return *found;
    for (const auto& other : other_words)
      if (other.of == of && other.word == name)
        return other.quantity;
  }
  return {};
}

TableOf place_of_block(const Block& block) {
  if (block.is("NODE PRINT") || block.is("NODE OUTPUT"))
    return TableOf::nodes;
  if (block.is("EL PRINT") || block.is("ELEMENT OUTPUT"))
    return TableOf::cells;
  return block.is("SECTION PRINT") ? TableOf::faces : TableOf::zones;
}

/// Returns whether all nodes of the block are references.
bool are_references(const Reading& reading, const Placed& placed, bool of_rotations) {
  const auto* const set = placed.block->find("NSET");
  Faults ignored;
  const auto found = set == nullptr
                         ? std::nullopt
                         : mesh::inp::find_nodes(reading.content, placed.scope, set->value, ignored);
  return found && std::ranges::all_of(found->items, [&](std::int32_t node) {
           const auto reference = reading.references.find(node);
           return reference != reading.references.end() && (!of_rotations || reference->second.rotations);
         });
}

/// Displacements and forces at a node for rotations are rotations and moments. Only references have UR and
/// RM.
std::string_view of_references(const Reading& reading, const Placed& placed, std::string_view quantity) {
  const bool turns = quantity == "UR" || quantity == "RM";
  if (turns)
    return are_references(reading, placed, false) ? quantity : std::string_view{};
  if ((quantity != "U" && quantity != "RF") || !are_references(reading, placed, true))
    return quantity;
  return quantity == "U" ? "UR" : "RM";
}

/// In a set with other nodes, a table lists the reference's displacement at a node for rotations.
void note_rotations(Reading& reading, const Placed& placed, const std::vector<std::int32_t>& nodes) {
  if (are_references(reading, placed, true))
    return;
  for (const auto node : nodes)
    if (const auto found = reading.references.find(node);
        found != reading.references.end() && found->second.rotations)
      leave_out(reading, placed.block->at,
                fmt::format("rotations of node {} among other nodes in tables, which probes have",
                            reading.content.node_numbers[static_cast<std::size_t>(node)]));
}

/// The table of a block, still without quantities. Nothing, with a fault or a note, if its set has no cells.
std::optional<study::PrintedTable> table_of(Reading& reading, const Placed& placed) {
  const auto& block = *placed.block;
  study::PrintedTable table;
  table.of = place_of_block(block);
  const auto* const set = block.find(table.of == TableOf::nodes   ? "NSET"
                                     : table.of == TableOf::cells ? "ELSET"
                                                                  : "SURFACE");
  if (table.of == TableOf::faces && set == nullptr) {
    leave_out(reading, block.at, fmt::format("{} without SURFACE=", block.at.text));
    return std::nullopt;
  }
  if (table.of == TableOf::zones || set == nullptr)
    return table;
  table.label = mesh::inp::folded(set->value.text);
  if (table.of == TableOf::faces) {
    const auto* const surface =
        mesh::inp::find_surface(reading.content, placed.scope, set->value, reading.faults);
    if (surface == nullptr || surface->of_nodes || surface->faces.empty()) {
      leave_out(reading, block.at, fmt::format("{} of a surface without faces", block.at.text));
      return std::nullopt;
    }
    table.on = surface->group;
    return table;
  }
  const auto found =
      table.of == TableOf::nodes
          ? mesh::inp::find_nodes(reading.content, placed.scope, set->value, reading.faults)
          : mesh::inp::find_elements(reading.content, placed.scope, set->value, reading.faults);
  if (!found)
    return std::nullopt;
  table.on = found->name;
  if (table.of == TableOf::nodes && !found->is_set && !found->items.empty())
    table.on = node_name(reading, found->items.front());
  if (table.of == TableOf::nodes)
    note_rotations(reading, placed, found->items);
  if (!table.on.empty() && !found->items.empty())
    return table;
  leave_out(reading, block.at, fmt::format("{} of {}, which has no cells", block.at.text, table.label));
  return std::nullopt;
}

/// The zone of a slave and a master, where the block names them.
void find_zone(Reading& reading, const Placed& placed, study::PrintedTable& table) {
  const auto* const slave = placed.block->find("SLAVE");
  const auto* const master = placed.block->find("MASTER");
  if (slave == nullptr && master == nullptr)
    return;
  const auto is_of = [&](const mesh::inp::Parameter* given, const std::string& group) {
    return given == nullptr || mesh::inp::folded(given->value.text) == mesh::inp::folded(group) ||
           mesh::inp::folded(given->value.text) + "_SURFACE" == mesh::inp::folded(group);
  };
  for (const auto& zone : reading.study.contact)
    if (is_of(slave, zone.slave) && is_of(master, zone.master)) {
      table.on = zone.name;
      return;
    }
  table.quantities.clear();
  leave_out(reading, placed.block->at,
            fmt::format("{} of a slave and a master without a contact pair", placed.block->at.text));
}

study::TableTotals totals_of(Reading& reading, const Block& block) {
  const auto* const given = block.find("TOTALS");
  const auto word = given == nullptr ? std::string("NO") : compact(given->value.text);
  if (word == "YES")
    return study::TableTotals::also;
  if (word == "ONLY")
    return study::TableTotals::only;
  if (word != "NO" && !word.empty())
    reading.faults.add(given->value,
                       fmt::format("found TOTALS={}, expected YES, ONLY or NO", given->value.text));
  return study::TableTotals::none;
}

int every_of(Reading& reading, const Block& block, int usual) {
  const auto* const given = block.find("FREQUENCY");
  if (given == nullptr)
    return usual;
  constexpr std::int64_t most = 1'000'000'000;
  const auto number = mesh::inp::require_integer(given->value, "the number of increments", reading.faults);
  return static_cast<int>(std::clamp<std::int64_t>(number.value_or(usual), 0, most));
}

/// CalculiX prints forces on whole rings by a wedge of two degrees.
void note_rings(Reading& reading, const Word& at, const study::PrintedTable& table) {
  const auto has = [&](std::string_view quantity) {
    return std::ranges::find(table.quantities, quantity) != table.quantities.end();
  };
  if (reading.study.physics == study::Physics::axisymmetric &&
      (has("RF") || has("EVOL") || has("ELSE") || has("ELKE") || has("SOF")))
    note(reading, at,
         "forces, volumes and energies of axisymmetric bodies are those of the whole ring; CalculiX prints "
         "those of a wedge of 2 degrees, 1/180 of them");
}

/// Notes what differs from CalculiX and from the loads.
void note_definitions(Reading& reading, const Word& at, const study::PrintedTable& table) {
  note_rings(reading, at, table);
  const bool meets_itself =
      std::ranges::any_of(reading.study.contact, [](const auto& zone) { return !zone.self.empty(); });
  if (meets_itself && std::ranges::find(table.quantities, "CDIS") != table.quantities.end())
    note(reading, at, "slips of CDIS are 0 in contact of a surface with itself");
  if (table.of == TableOf::faces)
    note(reading, at,
         "forces of *SECTION PRINT are those of stresses averaged at nodes, as in CalculiX; on coarse meshes "
         "they differ from the loads");
}

void read_table(Reading& reading, const Placed& placed, int every, Step& step) {
  const auto& block = *placed.block;
  step.requests.tables.insert(place_of_block(block));
  auto table = table_of(reading, placed);
  if (!table || every == 0)
    return;
  table->totals = totals_of(reading, block);
  table->every = every;
  const auto* const set = block.find("NSET");
  for (const auto& line : block.lines)
    for (const auto& word : mesh::inp::fields_of(line)) {
      if (word.empty())
        continue;
      const auto name = compact(word.text);
      const auto named = quantity_named(table->of, name);
      const std::string quantity(table->of == TableOf::nodes ? of_references(reading, placed, named) : named);
      const bool has_probe = table->of == TableOf::nodes && set != nullptr &&
                             add_probes(reading, placed, set->value, name, step);
      if (!quantity.empty() && std::ranges::find(table->quantities, quantity) == table->quantities.end())
        table->quantities.push_back(quantity);
      else if (quantity.empty() && !has_probe)
        leave_out(reading, word, fmt::format("{} in {}", shown(std::string(word.text)), block.at.text));
    }
  if (table->of == TableOf::zones)
    find_zone(reading, placed, *table);
  if (table->quantities.empty())
    return;
  note_definitions(reading, block.at, *table);
  step.requests.fields.tables.push_back(*std::move(table));
}

bool has_own_axes(const Reading& reading) {
  return std::ranges::any_of(reading.content.layout.blocks,
                             [](const auto& placed) { return placed.block->is("TRANSFORM"); });
}

} // namespace

void read_print(Reading& reading, const Placed& placed, Step& step) {
  const auto* const global = placed.block->find("GLOBAL");
  if (global != nullptr && compact(global->value.text) == "NO")
    note(reading, placed.block->at,
         "tables have components along the global axes, GLOBAL=NO is not available");
  else if (global == nullptr && placed.block->is("NODE PRINT") && has_own_axes(reading))
    note(reading, placed.block->at,
         "tables have components along the global axes; Abaqus and CalculiX print those of nodes with "
         "*TRANSFORM along their own ones, as GLOBAL=NO does");
  const auto points = time_points(reading, *placed.block, step);
  step.time.stops.insert(step.time.stops.end(), points.begin(), points.end());
  read_table(reading, placed, every_of(reading, *placed.block, 1), step);
}

void read_output(Reading& reading, const Placed& placed, Step& step) {
  if (step.of_fields.has_value() && !*step.of_fields)
    return read_table(reading, placed, every_of(reading, *placed.block, step.output_every), step);
  if (step.of_fields)
    return add_field_words(reading, *placed.block, step);
  // Without *OUTPUT above them these are CalculiX's requests of binary files.
  step.requests.fields.frd_binary = true;
  read_field_request(reading, placed, step);
}

void renew_requests(Reading& reading, const Step& step, Requests& requests) {
  const auto& asked = step.requests;
  auto tables = std::move(requests.fields.tables);
  std::erase_if(tables, [&](const study::PrintedTable& table) { return asked.tables.contains(table.of); });
  tables.insert(tables.end(), asked.fields.tables.begin(), asked.fields.tables.end());
  if (asked.of_fields != nullptr) {
    requests.fields = asked.fields;
    requests.of_fields = asked.of_fields;
  } else if (requests.fields.vtu) {
    read_instants(reading, *requests.of_fields, step, requests.fields);
  }
  requests.fields.tables = std::move(tables);
  if (asked.tables.contains(TableOf::nodes))
    requests.probes = asked.probes;
}

} // namespace rubato::inp
