// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/inp/reading.hpp"

#include "rubato/core/naming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace rubato::inp {

namespace {

bool is_group(const Content& content, const std::string& name) {
  const auto called = [&](const auto& labelled) {
    return std::ranges::any_of(labelled, [&](const auto& entry) {
      return mesh::inp::folded(entry.second.group) == mesh::inp::folded(name);
    });
  };
  return called(content.node_sets) || called(content.element_sets) || called(content.surfaces);
}

bool has_pretension(const Reading& reading, const std::vector<std::int32_t>& nodes) {
  return nodes.size() == 1 &&
         std::ranges::any_of(reading.pretensions, [name = node_name(reading, nodes.front())](
                                                      const auto& entry) { return entry.first == name; });
}

} // namespace

std::string chosen_name(Reading& reading, std::string_view kind, std::string_view label) {
  constexpr std::size_t longest = 90;
  std::string name;
  for (const char letter : label.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool fits = (byte < 0x80 && std::isalnum(byte) != 0) || letter == '_' || letter == '-';
    name += fits ? letter : '_';
  }
  if (name.empty())
    name = "unnamed";
  auto unique = name;
  const auto is_taken = [&] {
    return (kind == relation_kind && is_group(reading.content, unique)) ||
           !reading.names.insert(fmt::format("{} {}", kind, mesh::inp::folded(unique))).second;
  };
  auto& next = reading.next_names.try_emplace(fmt::format("{} {}", kind, name), 2).first->second;
  while (is_taken())
    unique = fmt::format("{}_{}", name, next++);
  return unique;
}

void note(Reading& reading, const Word& at, const std::string& text) {
  const auto place = to_string({at.at().file, at.at().line, 0});
  const auto whole = fmt::format("{}: {}", place, text);
  if (std::ranges::find(reading.notes, whole) == reading.notes.end())
    reading.notes.push_back(whole);
}

void leave_out(Reading& reading, const Word& at, const std::string& what) {
  if (what == "*HEADING") // it is the title
    return;
  auto& lines = reading.harmless[what];
  if (lines.empty() || lines.back() != at.line)
    lines.push_back(at.line);
}

void leave_out(Reading& reading, const Block& block) {
  if (block.is("RESTART") && block.find("READ") != nullptr)
    return reading.faults.add(block.find("READ")->name,
                              "found a restart from another analysis, which rubato does not read, "
                              "expected a file that begins anew");
  leave_out(reading, block.at, fmt::format("*{}", block.keyword->name));
}

bool share(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b) {
  std::vector<std::int32_t> both;
  std::ranges::set_intersection(a, b, std::back_inserter(both));
  return !both.empty();
}

void refuse_label(const Word& label, std::string_view what, const std::vector<std::string>& known,
                  Faults& faults) {
  faults.add(label, fmt::format("found {}, expected the name of {} of the file{}",
                                label.empty() ? "nothing" : shown(std::string(label.text)), what,
                                suggestion(std::string(label.text.substr(0, 100)), known)));
}

std::string node_name(const Reading& reading, std::int32_t node) {
  const auto number = reading.content.node_numbers[static_cast<std::size_t>(node)];
  const auto name = fmt::format("N{}", number);
  // A set of that name comes first in a study; the number alone is the node all the same.
  return reading.content.node_sets.contains({0, name}) || reading.content.element_sets.contains({0, name})
             ? fmt::format("{}", number)
             : name;
}

std::optional<Target> find_target(Reading& reading, int scope, const Word& word) {
  const auto found = mesh::inp::find_nodes(reading.content, scope, word, reading.faults);
  if (!found)
    return std::nullopt;
  Target target{found->name, found->items};
  if (target.nodes.empty()) {
    reading.faults.add(word,
                       fmt::format("found the set {} without a node, expected some", shown(found->name)));
    return std::nullopt;
  }
  if (!found->is_set || has_pretension(reading, target.nodes))
    target.name = node_name(reading, target.nodes.front());
  if (const auto rotation = reading.content.rotation_nodes.find(target.nodes.front());
      target.nodes.size() == 1 && rotation != reading.content.rotation_nodes.end() &&
      reading.used_nodes.contains(rotation->second))
    target.rotation = rotation->second;
  const auto is_reference = [&](std::int32_t node) { return reading.references.contains(node); };
  if (target.nodes.size() == 1 && is_reference(target.nodes.front())) {
    target.reference = &reading.references.at(target.nodes.front());
    target.name = target.reference->relation;
  } else if (std::ranges::any_of(target.nodes, is_reference)) {
    reading.faults.add(word, fmt::format("found the set {} with a reference node among others, expected the "
                                         "reference node alone",
                                         shown(found->name)));
    return std::nullopt;
  }
  return target;
}

const Placed* parent_of(Reading& reading, std::size_t index, std::string_view parent,
                        std::initializer_list<std::string_view> between) {
  const auto& blocks = reading.content.layout.blocks;
  for (auto i = index; i-- > 0;) {
    if (blocks[i].block->is(parent))
      return &blocks[i];
    const auto& name = blocks[i].block->keyword->name;
    if (std::ranges::find(between, name) == between.end() &&
        blocks[i].block->keyword->use != mesh::inp::Use::harmless &&
        blocks[i].block->keyword->use != mesh::inp::Use::unavailable)
      break;
  }
  const auto& at = blocks[index].block->at;
  reading.faults.add(at, fmt::format("found {} without *{} above it, which it belongs to", at.text, parent));
  return nullptr;
}

std::vector<std::int32_t> elements_of_group(const Reading& reading, const std::string& group) {
  for (const auto& [label, set] : reading.content.element_sets)
    if (set.group == group)
      return set.items;
  const auto made = reading.content.made_cells.find(group);
  return made == reading.content.made_cells.end() ? std::vector<std::int32_t>{} : made->second;
}

} // namespace rubato::inp
