// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/inp_content.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/rounding.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace rubato::mesh::inp {
namespace {

constexpr std::int64_t largest_number = 999'999'999;

std::optional<std::int64_t> number_of(const Word& word, std::string_view what, Faults& faults) {
  const auto number = require_integer(word, what, faults);
  if (!number)
    return std::nullopt;
  if (*number >= 1 && *number <= largest_number)
    return number;
  faults.add(word, fmt::format("found {}, expected {} from 1 to {}", *number, what, largest_number));
  return std::nullopt;
}

// ---- nodes

/// Radius, angle in degrees and height; or radius, angle and elevation.
Eigen::Vector3d cartesian(const Eigen::Vector3d& given, char system) {
  constexpr double degree = std::numbers::pi / 180;
  const double angle = given[1] * degree;
  if (system == 'C')
    return {given[0] * std::cos(angle), given[0] * std::sin(angle), given[2]};
  if (system != 'S')
    return given;
  const double elevation = given[2] * degree;
  return {given[0] * std::cos(elevation) * std::cos(angle), given[0] * std::cos(elevation) * std::sin(angle),
          given[0] * std::sin(elevation)};
}

char coordinate_system(const Block& block, Faults& faults) {
  const auto* const given = block.find("SYSTEM");
  const auto word = given == nullptr ? std::string("R") : compact(given->value.text);
  if (word == "R" || word == "C" || word == "S")
    return word.front();
  faults.add(given->value, fmt::format("found SYSTEM={}, expected R, C or S", word));
  return 'R';
}

/// Numbers of a scope's nodes as its own, and what stands in line: to tell of a number that comes twice.
class NodeReader {
public:
  NodeReader(Content& content, Faults& faults) : content_(content), faults_(faults) {}

  void read(const Placed& placed) {
    const auto& block = *placed.block;
    check_parameters(block, faults_);
    const char system = coordinate_system(block, faults_);
    auto& set = set_of(placed);
    for (const auto& line : block.lines)
      if (!is_blank(line))
        read(line, placed.scope, system, set);
  }

  /// Axes of the nodes that follow: their origin, a place on x' and one in the plane of x' and y'.
  void read_system(const Placed& placed) {
    check_parameters(*placed.block, faults_);
    std::vector<double> n;
    for (const auto& line : placed.block->lines)
      for (const auto& word : fields_of(line))
        n.push_back(require_number(word, "a coordinate of the axes", faults_, 0).value_or(0));
    const bool is_whole = n.size() <= 9;
    n.resize(9);
    turn_ = Eigen::Matrix3d::Identity();
    origin_ = {n[0], n[1], n[2]};
    const Eigen::Vector3d along = Eigen::Vector3d(n[3], n[4], n[5]) - origin_;
    const Eigen::Vector3d inside = Eigen::Vector3d(n[6], n[7], n[8]) - origin_;
    const bool turns = std::any_of(n.begin() + 3, n.end(), [](double value) { return value != 0; });
    const bool flat = std::all_of(n.begin() + 6, n.end(), [](double value) { return value == 0; });
    const Eigen::Vector3d normal =
        flat ? Eigen::Vector3d(along.cross(Eigen::Vector3d(-along.y(), along.x(), 0))) : along.cross(inside);
    if (!is_whole || (turns && !(normal.norm() > 0)))
      return faults_.add(placed.block->at, "found no axes, expected an origin, a place on x' and one in the "
                                           "plane of x' and y'");
    if (!turns)
      return;
    turn_.col(0) = along.normalized();
    turn_.col(2) = normal.normalized();
    turn_.col(1) = turn_.col(2).cross(turn_.col(0));
  }

private:
  std::vector<std::int32_t>& set_of(const Placed& placed) {
    const auto* const name = placed.block->find("NSET");
    if (name == nullptr)
      return unnamed_;
    auto& set = content_.node_sets[{placed.scope, folded(name->value.text)}];
    if (set.label.empty())
      set.label = name->value.text;
    set.scope = placed.scope;
    if (name->value.empty())
      faults_.add(name->name, "found NSET without a name, expected NSET=name");
    return set.items;
  }

  void read(const Line& line, int scope, char system, std::vector<std::int32_t>& set) {
    const auto fields = fields_of(line);
    const auto number = number_of(field(fields, 0, word_of(line)), "the number of a node", faults_);
    constexpr std::size_t most = 4;
    if (fields.size() > most && !only_numbers_after(fields))
      faults_.add(fields[most],
                  fmt::format("found {} after the coordinates of a node, expected the next line",
                              shown(std::string(fields[most].text))));
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[static_cast<int>(axis)] =
          require_number(field(fields, axis + 1, word_of(line)), "a coordinate", faults_, 0).value_or(0);
    if (!number)
      return;
    const auto& place = content_.layout.scopes[static_cast<std::size_t>(scope)];
    point = place.turn * (turn_ * cartesian(point, system) + origin_) + place.shift;
    auto& numbers = content_.node_at[static_cast<std::size_t>(scope)];
    const auto [known, is_new] =
        numbers.try_emplace(*number, static_cast<std::int32_t>(content_.points.size()));
    if (is_new) {
      content_.points.push_back(point);
      content_.node_numbers.push_back(*number);
    } else if (content_.points[static_cast<std::size_t>(known->second)] != point) {
      faults_.add(
          word_of(line),
          fmt::format("found node {} a second time at another place, expected each number once", *number));
    }
    set.push_back(known->second);
  }

  /// Direction cosines of a normal may follow.
  static bool only_numbers_after(const std::vector<Word>& fields) {
    constexpr std::size_t with_normal = 7;
    return fields.size() <= with_normal &&
           std::all_of(fields.begin() + 4, fields.end(),
                       [](const Word& word) { return word.empty() || number_in(word.text); });
  }

  Content& content_;
  Faults& faults_;
  std::vector<std::int32_t> unnamed_;
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity(); ///< of *SYSTEM
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

// ---- elements

/// Nodes between the middles of edges (of HEXA27) are found by their places: the body's and those of faces.
void place_inner_nodes(const Content& content, CellType type, std::span<NodeIndex> nodes) {
  if (type != CellType::hexa27)
    return;
  const auto& shape = cell::topology(type);
  const auto first = static_cast<std::size_t>(cell::topology(CellType::hexa20).node_count);
  std::vector<NodeIndex> left(nodes.begin() + static_cast<std::ptrdiff_t>(first), nodes.end());
  const auto point = [&](std::size_t i) -> const Eigen::Vector3d& {
    return content.points[static_cast<std::size_t>(nodes[i])];
  };
  const auto take_nearest = [&](const Eigen::Vector3d& place) {
    const auto nearest = std::ranges::min_element(left, {}, [&](NodeIndex node) {
      return (content.points[static_cast<std::size_t>(node)] - place).squaredNorm();
    });
    const auto node = *nearest;
    left.erase(nearest);
    return node;
  };
  const auto mean = [&](std::span<const std::uint8_t> corners) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto corner : corners)
      sum += point(corner);
    return Eigen::Vector3d(sum / static_cast<double>(corners.size()));
  };
  std::vector<NodeIndex> inner;
  for (const auto& side : shape.sides)
    inner.push_back(take_nearest(mean(side.nodes.first(8))));
  inner.push_back(left.front());
  std::ranges::copy(inner, nodes.begin() + static_cast<std::ptrdiff_t>(first));
}

/// Reads elements; their nodes may go on in the next lines.
class ElementReader {
public:
  ElementReader(Content& content, Faults& faults) : content_(content), faults_(faults) {}

  void read(const Placed& placed) {
    const auto& block = *placed.block;
    check_parameters(block, faults_);
    const auto name = require_value(block, "TYPE", "a type of element", faults_);
    const auto* const type = name.empty() ? nullptr : element_type_named(name.text);
    if (type == nullptr) {
      const auto nearest = name.empty() ? "" : nearest_element_type(name.text);
      if (!name.empty())
        faults_.add(name,
                    fmt::format("found elements of type {}, which rubato does not have{}",
                                shown(std::string(name.text)),
                                nearest.empty() ? "" : fmt::format("; the nearest it has is {}", nearest)));
      return;
    }
    auto& set = set_of(placed);
    for (std::size_t line = 0; line < block.lines.size();)
      read(placed, *type, line, set);
  }

private:
  std::vector<std::int32_t>& set_of(const Placed& placed) {
    const auto* const name = placed.block->find("ELSET");
    if (name == nullptr)
      return unnamed_;
    auto& set = content_.element_sets[{placed.scope, folded(name->value.text)}];
    if (set.label.empty())
      set.label = name->value.text;
    set.scope = placed.scope;
    if (name->value.empty())
      faults_.add(name->name, "found ELSET without a name, expected ELSET=name");
    return set.items;
  }

  /// One element; moves `line` to the next.
  void read(const Placed& placed, const ElementType& type, std::size_t& line,
            std::vector<std::int32_t>& set) {
    const auto& lines = placed.block->lines;
    const auto& begin = lines[line];
    std::vector<Word> words = fields_of(lines[line++]);
    if (words.empty())
      return;
    const auto wanted = static_cast<std::size_t>(type.node_count) + 1;
    while (words.size() < wanted && line < lines.size()) {
      const auto more = fields_of(lines[line++]);
      words.insert(words.end(), more.begin(), more.end());
    }
    if (words.size() != wanted)
      return faults_.add(word_of(begin), fmt::format("found {} nodes of a {} element, expected {}",
                                                     words.size() - 1, type.name, type.node_count));
    const auto number = number_of(words[0], "the number of an element", faults_);
    auto nodes = nodes_in(words, placed.scope);
    if (!number || nodes.size() + 1 != wanted)
      return;
    add(type, *number, placed.scope, std::move(nodes), words[0], set);
  }

  std::vector<NodeIndex> nodes_in(const std::vector<Word>& words, int scope) {
    std::vector<NodeIndex> nodes;
    const auto& numbers = content_.node_at[static_cast<std::size_t>(scope)];
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (const auto number = number_of(words[i], "the number of a node", faults_); number) {
        const auto found = numbers.find(*number);
        if (found != numbers.end())
          nodes.push_back(found->second);
        else
          faults_.add(words[i], fmt::format("found node {} of element {}, which the file does not have",
                                            *number, words[0].text));
      }
    }
    return nodes;
  }

  void add(const ElementType& type, std::int64_t number, int scope, std::vector<NodeIndex> nodes,
           const Word& at, std::vector<std::int32_t>& set) {
    auto sorted = nodes;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end())
      return faults_.add(at, fmt::format("found element {} with a node twice, expected {} different nodes",
                                         number, type.node_count));
    if (type.cell == CellType::seg3)
      std::swap(nodes[1], nodes[2]); // the middle one comes second there
    if (type.cell)
      place_inner_nodes(content_, *type.cell, nodes);
    auto& numbers = content_.element_at[static_cast<std::size_t>(scope)];
    const auto index = static_cast<std::int32_t>(content_.elements.size());
    if (!numbers.try_emplace(number, index).second)
      return faults_.add(at,
                         fmt::format("found element {} a second time, expected each number once", number));
    content_.elements.push_back({&type, number, scope, content_.connectivity.size(), at});
    content_.element_numbers.push_back(number);
    content_.connectivity.insert(content_.connectivity.end(), nodes.begin(), nodes.end());
    set.push_back(index);
  }

  Content& content_;
  Faults& faults_;
  std::vector<std::int32_t> unnamed_;
};

// ---- the whole

/// Of a plane model in the plane, of others in space.
void find_dimension(Content& content, Faults& faults) {
  const Element* first = nullptr;
  for (const auto& element : content.elements) {
    if (!is_continuum(element.type->family))
      continue;
    if (first != nullptr && first->type->family != element.type->family)
      return faults.add(element.at,
                        fmt::format("found a {} element beside {} in line {}, expected one physics in a "
                                    "file: solids, plane stress, plane strain or axisymmetry",
                                    element.type->name, first->type->name, first->at.line));
    first = first == nullptr ? &element : first;
  }
  content.dimension = first == nullptr || first->type->family == Family::solid ? 3 : 2;
  if (content.dimension == 3 || content.points.empty())
    return;
  double largest = 0;
  for (const auto& point : content.points)
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  for (auto& point : content.points) {
    if (std::abs(point.z() - content.points.front().z()) > coordinate_rounding * largest)
      return faults.add(
          first->at,
          fmt::format("found {} elements, but nodes with different z, expected one z", first->type->name));
    point.z() = 0;
  }
}

bool repeats(std::span<const std::int64_t> numbers) {
  std::vector<std::int64_t> sorted(numbers.begin(), numbers.end());
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) != sorted.end();
}

/// Numbers that instances share get a power of ten for each instance after the first one: node 12 of the
/// second is 1012. Where that gets too large they count from 1.
void tell_apart(std::vector<std::int64_t>& numbers, std::span<const int> scopes) {
  if (numbers.empty() || !repeats(numbers))
    return;
  std::int64_t unit = 10;
  while (unit <= *std::ranges::max_element(numbers))
    unit *= 10;
  std::vector<int> used(scopes.begin(), scopes.end());
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (used.front() == 0)
    std::rotate(used.begin(), used.begin() + 1, used.end());
  const bool fits = unit * static_cast<std::int64_t>(used.size()) <= std::numeric_limits<std::int32_t>::max();
  std::vector<std::int64_t> rank(static_cast<std::size_t>(*std::ranges::max_element(used)) + 1);
  for (std::size_t i = 0; i < used.size(); ++i)
    rank[static_cast<std::size_t>(used[i])] = static_cast<std::int64_t>(i);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = fits ? numbers[i] + unit * rank[static_cast<std::size_t>(scopes[i])]
                      : static_cast<std::int64_t>(i) + 1;
}

void number_all(Content& content) {
  std::vector<int> scopes(content.points.size());
  for (std::size_t scope = 0; scope < content.node_at.size(); ++scope)
    for (const auto& [number, node] : content.node_at[scope])
      scopes[static_cast<std::size_t>(node)] = static_cast<int>(scope);
  tell_apart(content.node_numbers, scopes);
  scopes.clear();
  for (const auto& element : content.elements)
    scopes.push_back(element.scope);
  tell_apart(content.element_numbers, scopes);
}

/// Nodes in the order of the file: some are made of those above and of their sets.
void read_nodes(Content& content, Faults& faults) {
  NodeReader nodes(content, faults);
  const auto& blocks = content.layout.blocks;
  const bool of_sets = std::ranges::any_of(
      blocks, [](const Placed& placed) { return placed.block->is("NFILL") || placed.block->is("NCOPY"); });
  Faults told_with_sets;
  for (const auto& placed : blocks) {
    const auto& block = *placed.block;
    if (block.is("NODE"))
      nodes.read(placed);
    else if (block.is("SYSTEM"))
      nodes.read_system(placed);
    else if (block.is("NGEN") || block.is("NFILL") || block.is("NCOPY"))
      generate_nodes(content, placed, faults);
    else if (of_sets && block.is("NSET") && block.find("ELSET") == nullptr)
      read_node_set(content, placed, told_with_sets);
  }
  content.remarks.clear(); // sets are read again, with all nodes
}

void fill(Content& content, Faults& faults) {
  content.layout = lay_out(content.source, faults);
  content.node_at.resize(content.layout.scopes.size());
  content.element_at.resize(content.layout.scopes.size());
  read_nodes(content, faults);
  ElementReader elements(content, faults);
  for (const auto& placed : content.layout.blocks)
    if (placed.block->is("ELEMENT"))
      elements.read(placed);
    else if (placed.block->is("ELGEN") || placed.block->is("ELCOPY"))
      generate_elements(content, placed, faults);
  number_all(content);
  read_sets(content, faults);
  settle_families(content);
  find_dimension(content, faults);
  name_groups(content);
  read_surfaces(content, faults);
  name_groups(content);
  read_loaded_faces(content, faults);
  split_sections(content);
  find_slave_faces(content, faults);
  adjust_slaves(content, faults);
  find_cuts(content);
  add_rotation_nodes(content);
  const bool has_cells = std::ranges::any_of(
      content.elements, [](const Element& element) { return element.type->cell.has_value(); });
  if (faults.empty() && (content.points.empty() || !has_cells)) {
    Location whole;
    whole.file = content.source.names.front();
    faults.add(whole, fmt::format("found no {} in the file, expected some",
                                  content.points.empty() ? "nodes (*NODE)" : "cells (*ELEMENT)"));
  }
  faults.throw_if_any();
}

} // namespace

Content read_content(const std::filesystem::path& path) {
  Content content;
  Faults faults;
  content.source = read_source(path, faults);
  fill(content, faults);
  return content;
}

Content parse_content(std::string text, const std::string& name) {
  Content content;
  Faults faults;
  content.source = parse_source(std::move(text), name, faults);
  fill(content, faults);
  return content;
}

} // namespace rubato::mesh::inp
