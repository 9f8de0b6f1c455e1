// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace rubato::mesh::inp {
namespace {

using Numbers = std::unordered_map<std::int64_t, std::int32_t>;

/// What is looked up: nodes or elements.
struct Kind {
  std::string_view what;   ///< "node"
  std::string_view letter; ///< "N"
  std::vector<Numbers> Content::*numbers;
  std::vector<std::int64_t> Content::*in_mesh;
  Labelled<Set> Content::*sets;
};
constexpr Kind nodes_kind{"node", "N", &Content::node_at, &Content::node_numbers, &Content::node_sets};
constexpr Kind elements_kind{"element", "E", &Content::element_at, &Content::element_numbers,
                             &Content::element_sets};

/// A label or a number with the scope it is looked up in.
struct Reference {
  int scope = 0;
  std::string_view text;
};

/// "INSTANCE.LABEL" is in that instance, where there is one of that name.
Reference referred(const Content& content, int scope, std::string_view text) {
  for (auto dot = text.find('.'); dot != std::string_view::npos; dot = text.find('.', dot + 1))
    if (const auto named = content.layout.scope_named(text.substr(0, dot)); named)
      return {*named, text.substr(dot + 1)};
  return {scope, text};
}

template <class Item>
std::string nearest_label(const Labelled<Item>& items, const Content& content, std::string_view text) {
  std::vector<std::string> labels;
  for (const auto& [key, item] : items) {
    const auto& instance = content.layout.scopes[static_cast<std::size_t>(key.first)].name;
    labels.push_back(instance.empty() ? item.label : instance + "." + item.label);
  }
  const auto nearest = nearest_word(std::string(text.substr(0, 100)), labels);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::optional<Found> find(const Kind& kind, const Content& content, int scope, const Word& word,
                          Faults& faults) {
  const auto at = referred(content, scope, word.text);
  if (const auto number = integer_in(at.text); number) {
    const auto& numbers = (content.*kind.numbers)[static_cast<std::size_t>(at.scope)];
    if (const auto found = numbers.find(*number); found != numbers.end()) {
      const auto in_mesh = (content.*kind.in_mesh)[static_cast<std::size_t>(found->second)];
      return Found{fmt::format("{}{}", kind.letter, in_mesh), {found->second}, false};
    }
  }
  const auto& sets = content.*kind.sets;
  if (const auto set = sets.find({at.scope, folded(at.text)}); set != sets.end())
    return Found{set->second.group, set->second.items, true};
  faults.add(word, fmt::format("found {}, expected the number of a {} or a set of {}s{}",
                               word.empty() ? "nothing" : shown(std::string(word.text)), kind.what, kind.what,
                               word.empty() ? "" : nearest_label(sets, content, word.text)));
  return std::nullopt;
}

// ---- sets

/// The numbers of first, first + step … last that the file has, in the order of the file.
std::vector<std::int32_t> items_in_range(const Numbers& numbers, std::int64_t first, std::int64_t last,
                                         std::int64_t step) {
  std::vector<std::int32_t> items;
  if ((last - first) / step < static_cast<std::int64_t>(numbers.size())) {
    for (auto number = first; number <= last; number += step)
      if (const auto found = numbers.find(number); found != numbers.end())
        items.push_back(found->second);
    return items;
  }
  for (const auto& [number, item] : numbers)
    if (number >= first && number <= last && (number - first) % step == 0)
      items.push_back(item);
  return items;
}

/// The numbers first, first + step … last that the file has; a remark where some are missing.
void generate(const Kind& kind, Content& content, int scope, const std::vector<Word>& fields,
              std::vector<std::int32_t>& items, Faults& faults) {
  constexpr std::size_t most = 3;
  const auto first = require_integer(fields[0], "the first number", faults);
  const auto second = field(fields, 1, fields[0]);
  const auto last = second.empty() ? first : require_integer(second, "the last number", faults);
  const auto third = field(fields, 2, second);
  const auto step = third.empty() ? 1 : require_integer(third, "the step of the numbers", faults);
  if (!first || !last || !step)
    return;
  if (*step < 1 || *last < *first || *first < 1 || fields.size() > most)
    return faults.add(fields[0],
                      fmt::format("found numbers from {} to {} by {}, expected some above 0 that ascend",
                                  *first, *last, *step));
  const auto& numbers = (content.*kind.numbers)[static_cast<std::size_t>(scope)];
  const auto found = items_in_range(numbers, *first, *last, *step);
  const auto wanted = (*last - *first) / *step + 1;
  if (static_cast<std::int64_t>(found.size()) < wanted)
    content.remarks.push_back(
        {fields[0], fmt::format("the numbers from {} to {} by {} are {}, of which the file has {} {}s; these "
                                "are taken",
                                *first, *last, *step, wanted, found.size(), kind.what)});
  items.insert(items.end(), found.begin(), found.end());
}

/// Returns whether the word is a number that no node or element has, and adds a remark if so.
bool is_missing_number(const Kind& kind, Content& content, int scope, const Word& word) {
  const auto number = integer_in(word.text);
  if (!number || (content.*kind.numbers)[static_cast<std::size_t>(scope)].contains(*number))
    return false;
  content.remarks.push_back(
      {word, fmt::format("{} {} is not in the file and is left out of the set", kind.what, *number)});
  return true;
}

void add_nodes_of(const Content& content, std::span<const std::int32_t> elements,
                  std::vector<std::int32_t>& items) {
  for (const auto index : elements) {
    const auto nodes = content.nodes_of(content.elements[static_cast<std::size_t>(index)]);
    items.insert(items.end(), nodes.begin(), nodes.end());
  }
}

std::optional<int> members_scope(const Content& content, const Placed& placed, Faults& faults) {
  const auto* const instance = placed.block->find("INSTANCE");
  if (instance == nullptr)
    return placed.scope;
  const auto named = content.layout.scope_named(instance->value.text);
  if (!named) {
    std::vector<std::string> names;
    for (const auto& scope : content.layout.scopes)
      if (!scope.name.empty())
        names.push_back(scope.name);
    faults.add(instance->value.empty() ? instance->name : instance->value,
               fmt::format("found the instance {}, which the file does not have{}",
                           shown(std::string(instance->value.text)),
                           suggestion(std::string(instance->value.text), names)));
  }
  return named;
}

void read_set(const Kind& kind, Content& content, const Placed& placed, Faults& faults) {
  const auto& block = *placed.block;
  check_parameters(block, faults);
  const auto name =
      require_value(block, &kind == &nodes_kind ? "NSET" : "ELSET", "the name of the set", faults);
  const auto scope = members_scope(content, placed, faults);
  if (name.empty() || !scope)
    return;
  if (integer_in(name.text))
    return faults.add(name, fmt::format("found a set called {}, expected a name that is no number",
                                        shown(std::string(name.text))));
  std::vector<std::int32_t> items;
  if (const auto* const of = block.find("ELSET"); &kind == &nodes_kind && of != nullptr)
    if (const auto found = find_elements(content, *scope, of->value, faults); found)
      add_nodes_of(content, found->items, items);
  for (const auto& line : block.lines) {
    const auto fields = fields_of(line);
    if (block.find("GENERATE") != nullptr && !fields.empty())
      generate(kind, content, *scope, fields, items, faults);
    else
      for (const auto& word : fields)
        if (!word.empty() && !is_missing_number(kind, content, *scope, word))
          if (const auto found = find(kind, content, *scope, word, faults); found)
            items.insert(items.end(), found->items.begin(), found->items.end());
  }
  auto& set = (content.*kind.sets)[{placed.scope, folded(name.text)}];
  if (set.label.empty())
    set.label = name.text;
  set.scope = placed.scope;
  set.items.insert(set.items.end(), items.begin(), items.end());
  sort_without_repeats(set.items);
}

// ---- surfaces

using Corners = std::array<NodeIndex, 4>;

Corners corners_of(const Content& content, const ElementFace& face) {
  const auto& element = content.elements[static_cast<std::size_t>(face.element)];
  const auto nodes = content.nodes_of(element);
  const auto& side = cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)];
  Corners corners{-1, -1, -1, -1};
  const auto count = static_cast<std::size_t>(cell::topology(side.type).corner_count);
  for (std::size_t i = 0; i < count; ++i)
    corners[i] = nodes[side.nodes[i]];
  std::ranges::sort(corners);
  return corners;
}

/// Whether elements deform and have faces.
bool has_faces(const Element& element) {
  return is_continuum(element.type->family);
}

/// The faces that one element of the whole model has alone.
class FreeFaces {
public:
  explicit FreeFaces(const Content& content) : content_(content) {}

  void add(std::span<const std::int32_t> elements, std::vector<ElementFace>& faces) {
    if (counts_.empty())
      count();
    for (const auto index : elements)
      for_each_side(index, [&](const ElementFace& face) {
        if (counts_.at(corners_of(content_, face)) == 1)
          faces.push_back(face);
      });
  }

private:
  template <class Visit> void for_each_side(std::int32_t index, Visit visit) const {
    const auto& element = content_.elements[static_cast<std::size_t>(index)];
    if (!has_faces(element))
      return;
    const auto count = static_cast<int>(cell::topology(*element.type->cell).sides.size());
    for (int side = 0; side < count; ++side)
      visit(ElementFace{index, side});
  }

  void count() {
    for (std::size_t i = 0; i < content_.elements.size(); ++i)
      for_each_side(static_cast<std::int32_t>(i),
                    [&](const ElementFace& face) { ++counts_[corners_of(content_, face)]; });
  }

  const Content& content_;
  std::map<Corners, int> counts_;
};

/// The number in "S3" or "P3"; nothing in other words.
std::optional<int> face_number(std::string_view label, char letter) {
  const auto word = folded(label);
  if (word.size() != 2 || word[0] != letter || word[1] < '1' || word[1] > '6')
    return std::nullopt;
  return word[1] - '0';
}

void add_faces(const Content& content, const Found& elements, int number, const Word& label,
               std::vector<ElementFace>& faces, Faults& faults) {
  for (const auto index : elements.items) {
    const auto& element = content.elements[static_cast<std::size_t>(index)];
    const auto side = has_faces(element) ? side_of_face(*element.type->cell, number) : std::nullopt;
    if (!side)
      return faults.add(label, fmt::format("found face {} of element {}, which a {} does not have", number,
                                           element.number, element.type->name));
    faces.push_back({index, *side});
  }
}

class SurfaceReader {
public:
  SurfaceReader(Content& content, Faults& faults) : content_(content), faults_(faults), free_(content) {}

  void read(const Placed& placed) {
    const auto& block = *placed.block;
    check_parameters(block, faults_);
    const auto name = require_value(block, "NAME", "the name of the surface", faults_);
    const auto scope = members_scope(content_, placed, faults_);
    const auto* const type = block.find("TYPE");
    const auto kind = type == nullptr ? std::string("ELEMENT") : compact(type->value.text);
    if (kind != "ELEMENT" && kind != "NODE")
      return faults_.add(type->value,
                         fmt::format("found a surface of type {}, expected ELEMENT or NODE; an analytical "
                                     "surface is an obstacle of a deck",
                                     shown(std::string(type->value.text))));
    if (name.empty() || !scope)
      return;
    auto& surface = content_.surfaces[{placed.scope, folded(name.text)}];
    if (!surface.label.empty())
      return faults_.add(name, fmt::format("found a second surface {}, expected each name once",
                                           shown(std::string(name.text))));
    surface.label = name.text;
    surface.scope = placed.scope;
    surface.at = name;
    surface.of_nodes = kind == "NODE";
    for (const auto& line : block.lines)
      if (!is_blank(line))
        read(fields_of(line), *scope, surface);
    sort_without_repeats(surface.nodes);
    if (surface.faces.empty() && surface.nodes.empty() && faults_.empty())
      faults_.add(name, fmt::format("found the surface {} without a {}, expected some", shown(surface.label),
                                    surface.of_nodes ? "node" : "face"));
  }

private:
  void read(const std::vector<Word>& fields, int scope, Surface& surface) {
    if (surface.of_nodes) {
      if (const auto found = find_nodes(content_, scope, fields[0], faults_); found)
        surface.nodes.insert(surface.nodes.end(), found->items.begin(), found->items.end());
      return;
    }
    const auto found = find_elements(content_, scope, fields[0], faults_);
    if (!found)
      return;
    const auto label = field(fields, 1, fields[0]);
    if (label.empty())
      free_.add(found->items, surface.faces);
    else if (const auto number = face_number(label.text, 'S'); number)
      add_faces(content_, *found, *number, label, surface.faces, faults_);
    else
      faults_.add(label, fmt::format("found the face {}, expected S1 to S6", shown(std::string(label.text))));
  }

  Content& content_;
  Faults& faults_;
  FreeFaces free_;
};

// ---- names

/// Labels of several scopes that are equal get the instance before them.
class GroupNames {
public:
  explicit GroupNames(const Content& content) : content_(content) {}

  void note(const std::string& label) { ++counts_[folded(label)]; }

  std::string of(const std::string& label, int scope) const {
    const auto& instance = content_.layout.scopes[static_cast<std::size_t>(scope)].name;
    const bool alone = counts_.at(folded(label)) == 1 || instance.empty();
    const auto name = alone ? label : instance + "." + label;
    return name == "all" ? "ALL" : name; // which stands for everything in a deck
  }

private:
  const Content& content_;
  std::map<std::string, int> counts_;
};

bool has_cells(const Content& content, const Set& set) {
  return std::ranges::any_of(set.items, [&](std::int32_t index) {
    return content.elements[static_cast<std::size_t>(index)].type->cell.has_value();
  });
}

} // namespace

std::vector<ElementFace> free_faces(const Content& content) {
  std::vector<std::int32_t> all(content.elements.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<ElementFace> faces;
  FreeFaces(content).add(all, faces);
  return faces;
}

void read_node_set(Content& content, const Placed& placed, Faults& faults) {
  read_set(nodes_kind, content, placed, faults);
}

void read_sets(Content& content, Faults& faults) {
  for (auto* sets : {&content.node_sets, &content.element_sets})
    for (auto& [key, set] : *sets)
      sort_without_repeats(set.items);
  for (const auto& placed : content.layout.blocks)
    if (placed.block->is("ELSET"))
      read_set(elements_kind, content, placed, faults);
  for (const auto& placed : content.layout.blocks)
    if (placed.block->is("NSET"))
      read_set(nodes_kind, content, placed, faults);
}

void read_surfaces(Content& content, Faults& faults) {
  SurfaceReader reader(content, faults);
  for (const auto& placed : content.layout.blocks)
    if (placed.block->is("SURFACE"))
      reader.read(placed);
}

void read_loaded_faces(Content& content, Faults& faults) {
  for (const auto& placed : content.layout.blocks) {
    if (!placed.block->is("DLOAD"))
      continue;
    for (const auto& line : placed.block->lines) {
      const auto fields = fields_of(line);
      const auto number = fields.size() < 2 ? std::nullopt : face_number(fields[1].text, 'P');
      if (!number)
        continue;
      if (const auto found = find_elements(content, placed.scope, fields[0], faults); found)
        add_faces(content, *found, *number, fields[1], content.loaded_faces[loaded_group(*found, *number)],
                  faults);
    }
  }
}

void name_groups(Content& content) {
  GroupNames of_nodes(content);
  GroupNames of_cells(content);
  for (const auto& [key, set] : content.node_sets)
    of_nodes.note(set.label);
  for (const auto& [key, set] : content.element_sets)
    of_cells.note(set.label);
  const auto name = [&](const Surface& surface) {
    const auto& sets = surface.of_nodes ? content.node_sets : content.element_sets;
    return sets.contains({surface.scope, folded(surface.label)}) ? surface.label + "_surface" : surface.label;
  };
  for (const auto& [key, surface] : content.surfaces)
    (surface.of_nodes ? of_nodes : of_cells).note(name(surface));
  for (auto& [key, set] : content.node_sets)
    set.group = of_nodes.of(set.label, set.scope);
  for (auto& [key, set] : content.element_sets)
    set.group = has_cells(content, set) ? of_cells.of(set.label, set.scope) : "";
  for (auto& [key, surface] : content.surfaces)
    surface.group = (surface.of_nodes ? of_nodes : of_cells).of(name(surface), surface.scope);
}

std::optional<Found> find_nodes(const Content& content, int scope, const Word& word, Faults& faults) {
  return find(nodes_kind, content, scope, word, faults);
}

std::optional<Found> find_elements(const Content& content, int scope, const Word& word, Faults& faults) {
  return find(elements_kind, content, scope, word, faults);
}

const Surface* find_surface(const Content& content, int scope, const Word& word, Faults& faults) {
  const auto at = referred(content, scope, word.text);
  const auto found = content.surfaces.find({at.scope, folded(at.text)});
  if (found != content.surfaces.end())
    return &found->second;
  faults.add(word, fmt::format("found {}, expected a surface{}",
                               word.empty() ? "nothing" : shown(std::string(word.text)),
                               word.empty() ? "" : nearest_label(content.surfaces, content, word.text)));
  return nullptr;
}

std::string loaded_group(const Found& elements, int face) {
  return fmt::format("{}.P{}", elements.name, face);
}

} // namespace rubato::mesh::inp
