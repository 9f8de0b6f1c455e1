// SPDX-License-Identifier: LGPL-3.0-or-later
// Which elements are bodies, which are surfaces, and how the elements of a section are integrated.
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace rubato::mesh::inp {
namespace {

/// Keywords that make elements parts of a body.
constexpr std::array<std::string_view, 7> body_keywords{
    "SOLID SECTION",        "SHELL SECTION", "SHELL GENERAL SECTION", "MEMBRANE SECTION", "BEAM SECTION",
    "BEAM GENERAL SECTION", "RIGID BODY"};

/// Elements that a section or a rigid body names.
std::vector<char> named_by_sections(const Content& content) {
  std::vector<char> named(content.elements.size(), 0);
  Faults told_elsewhere;
  for (const auto& placed : content.layout.blocks) {
    const auto* const set = placed.block->find("ELSET");
    if (set == nullptr ||
        std::ranges::find(body_keywords, placed.block->keyword->name) == body_keywords.end())
      continue;
    if (const auto found = find_elements(content, placed.scope, set->value, told_elsewhere); found)
      for (const auto index : found->items)
        named[static_cast<std::size_t>(index)] = 1;
  }
  return named;
}

std::string_view word_of(Integration how) {
  switch (how) {
  case Integration::incompatible:
    return "incompatible";
  case Integration::reduced:
    return "reduced";
  case Integration::full:
    break;
  }
  return "full";
}

} // namespace

void settle_families(Content& content) {
  const auto has = [&](auto is) {
    return std::ranges::any_of(content.elements,
                               [&](const Element& element) { return is(element.type->family); });
  };
  const bool solids = has([](Family family) { return family == Family::solid; });
  if (!solids && !has(is_continuum))
    return;
  const auto named = named_by_sections(content);
  std::map<std::string_view, std::pair<int, Word>> left;
  for (std::size_t i = 0; i < content.elements.size(); ++i) {
    auto& element = content.elements[i];
    const auto family = element.type->family;
    const bool beside =
        family == Family::structural || (solids && is_continuum(family) && family != Family::solid);
    if (!beside || named[i] != 0)
      continue;
    auto& [count, at] = left.try_emplace(element.type->name, 0, element.at).first->second;
    ++count;
    element.type = as_skin(*element.type);
  }
  for (const auto& [type, entry] : left)
    content.remarks.push_back(
        {entry.second, fmt::format("{} elements of type {} have no section: they are surfaces or lines "
                                   "without stiffness",
                                   entry.first, type)});
}

std::string section_group(const Found& elements, Integration how, bool all) {
  return all ? elements.name : fmt::format("{}.{}", elements.name, word_of(how));
}

void split_sections(Content& content) {
  Faults told_elsewhere;
  for (const auto& placed : content.layout.blocks) {
    const auto* const set = placed.block->find("ELSET");
    if (!placed.block->is("SOLID SECTION") || set == nullptr)
      continue;
    const auto found = find_elements(content, placed.scope, set->value, told_elsewhere);
    std::map<Integration, std::vector<std::int32_t>> parts;
    for (const auto index : found ? found->items : std::vector<std::int32_t>{})
      parts[content.elements[static_cast<std::size_t>(index)].type->how].push_back(index);
    if (parts.size() > 1)
      for (auto& [how, items] : parts)
        content.made_cells[section_group(*found, how, false)] = std::move(items);
  }
}

} // namespace rubato::mesh::inp
