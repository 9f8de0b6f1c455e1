// SPDX-License-Identifier: LGPL-3.0-or-later
// Nodes and elements that keywords make of others: *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY.
#include "rubato/core/naming.hpp"
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::mesh::inp {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t most_made = 10'000'000;

/// The numbers of a line; absent ones have a default.
class DataLine {
public:
  DataLine(const Line& line, Faults& faults)
      : fields_(fields_of(line)), at_(word_of(line)), faults_(faults) {}

  std::optional<std::int64_t> integer(std::size_t place, std::string_view what,
                                      std::optional<std::int64_t> absent = std::nullopt) const {
    const auto word = field(fields_, place, at_);
    return word.empty() && absent ? absent : require_integer(word, what, faults_);
  }
  std::optional<double> number(std::size_t place, double absent = 0) const {
    return require_number(field(fields_, place, at_), "a coordinate", faults_, absent);
  }
  std::optional<Vector3d> point(std::size_t first) const {
    const auto x = number(first), y = number(first + 1), z = number(first + 2);
    return x && y && z ? std::optional(Vector3d(*x, *y, *z)) : std::nullopt;
  }
  bool has(std::size_t place) const { return place < fields_.size() && !fields_[place].empty(); }
  const Word& at() const { return at_; }
  Word word(std::size_t place) const { return field(fields_, place, at_); }

private:
  std::vector<Word> fields_;
  Word at_;
  Faults& faults_;
};

std::vector<std::int32_t>* set_named(Labelled<Set>& sets, const Placed& placed, std::string_view key) {
  const auto* const name = placed.block->find(key);
  if (name == nullptr || name->value.empty())
    return nullptr;
  auto& set = sets[{placed.scope, folded(name->value.text)}];
  if (set.label.empty())
    set.label = name->value.text;
  set.scope = placed.scope;
  return &set.items;
}

/// Makes nodes of one keyword.
class NodeMaker {
public:
  NodeMaker(Content& content, const Placed& placed, Faults& faults)
      : content_(content), placed_(placed), faults_(faults),
        set_(set_named(content.node_sets, placed, placed.block->is("NCOPY") ? "NEWSET" : "NSET")) {}

  void make() {
    check_parameters(*placed_.block, faults_);
    if (placed_.block->is("NCOPY"))
      return copy();
    for (const auto& line : placed_.block->lines)
      if (!is_blank(line))
        placed_.block->is("NGEN") ? generate({line, faults_}) : fill({line, faults_});
  }

private:
  std::optional<std::int32_t> node(std::int64_t number, const Word& at) {
    const auto& numbers = content_.node_at[static_cast<std::size_t>(placed_.scope)];
    if (const auto found = numbers.find(number); found != numbers.end())
      return found->second;
    faults_.add(at, fmt::format("found node {}, which the file does not have above", number));
    return std::nullopt;
  }
  const Vector3d& place(std::int32_t node) const { return content_.points[static_cast<std::size_t>(node)]; }

  void take(std::int32_t node) {
    if (set_ != nullptr)
      set_->push_back(node);
  }

  /// A node that is there keeps its place.
  void add(std::int64_t number, const Vector3d& point) {
    auto& numbers = content_.node_at[static_cast<std::size_t>(placed_.scope)];
    const auto [known, is_new] =
        numbers.try_emplace(number, static_cast<std::int32_t>(content_.points.size()));
    if (is_new) {
      content_.points.push_back(point);
      content_.node_numbers.push_back(number);
    }
    take(known->second);
  }

  void generate(const DataLine& line) {
    const auto first = line.integer(0, "the first node"), last = line.integer(1, "the last node");
    const auto step = line.integer(2, "the step of the numbers", 1);
    if (!first || !last || !step)
      return;
    const auto a = node(*first, line.at()), b = node(*last, line.at());
    const auto span = *last - *first;
    if (!a || !b)
      return;
    if (*step == 0 || span % *step != 0 || span / *step < 1 || span / *step > most_made)
      return faults_.add(line.at(), fmt::format("found nodes from {} to {} by {}, expected a step that leads "
                                                "from one to the other",
                                                *first, *last, *step));
    const auto count = span / *step;
    take(*a);
    for (std::int64_t i = 1; i < count; ++i)
      if (const auto point =
              between(place(*a), place(*b), static_cast<double>(i) / static_cast<double>(count), line);
          point)
        add(*first + i * *step, *point);
    take(*b);
  }

  /// On the line between two places, or on a circle about a third one.
  std::optional<Vector3d> between(const Vector3d& a, const Vector3d& b, double part, const DataLine& line) {
    const auto* const shape = placed_.block->find("LINE");
    const auto word = shape == nullptr ? std::string() : compact(shape->value.text);
    if (word.empty())
      return Vector3d(a + part * (b - a));
    if (word != "C") {
      faults_.add(shape->value, fmt::format("found LINE={}, expected C, a circle, or no LINE", word));
      return std::nullopt;
    }
    auto centre = line.point(4);
    if (line.has(3)) {
      const auto number = line.integer(3, "the node of the centre");
      const auto at = number ? node(*number, line.at()) : std::nullopt;
      centre = at ? std::optional(place(*at)) : std::nullopt;
    }
    const auto given = line.point(7);
    if (!centre || !given)
      return std::nullopt;
    const Vector3d from = a - *centre, to = b - *centre;
    const Vector3d normal = given->norm() > 0 ? given->normalized() : Vector3d(from.cross(to).normalized());
    if (!(normal.norm() > 0.5)) {
      faults_.add(line.at(),
                  "found an arc of 180 or 360 degrees without a normal, expected the normal of the "
                  "circle");
      return std::nullopt;
    }
    double angle = std::atan2(from.cross(to).dot(normal), from.dot(to));
    if (angle <= 0)
      angle += 2 * std::numbers::pi;
    const Vector3d turned = Eigen::AngleAxisd(part * angle, normal) * from;
    return Vector3d(*centre + turned * (1 + part * (to.norm() / from.norm() - 1)));
  }

  /// Lines of nodes between two sets.
  void fill(const DataLine& line) {
    auto from = find_nodes(content_, placed_.scope, line.word(0), faults_);
    auto to = find_nodes(content_, placed_.scope, line.word(1), faults_);
    const auto count = line.integer(2, "the number of intervals");
    const auto step = line.integer(3, "the step of the numbers", 1);
    if (!from || !to || !count || !step)
      return;
    sort_without_repeats(from->items);
    sort_without_repeats(to->items);
    if (from->items.size() != to->items.size() || *count < 1 || *count > most_made)
      return faults_.add(line.at(),
                         fmt::format("found {} and {} nodes with {} intervals between them, expected "
                                     "sets of as many nodes and 1 interval or more",
                                     from->items.size(), to->items.size(), *count));
    double bias = 1;
    if (const auto* const given = placed_.block->find("BIAS"); given != nullptr)
      bias = require_number(given->value, "BIAS", faults_).value_or(1);
    if (!(bias > 0))
      return faults_.add(placed_.block->find("BIAS")->value, "found a BIAS that is not above 0");
    double whole = 0;
    for (std::int64_t i = 0; i < *count; ++i)
      whole += std::pow(bias, -static_cast<double>(i));
    for (std::size_t k = 0; k < from->items.size(); ++k) {
      const auto number = content_.node_numbers[static_cast<std::size_t>(from->items[k])];
      const Vector3d a = place(from->items[k]), b = place(to->items[k]);
      take(from->items[k]);
      double part = 0;
      for (std::int64_t i = 1; i < *count; ++i) {
        part += std::pow(bias, -static_cast<double>(i - 1)) / whole;
        add(number + i * *step, a + part * (b - a));
      }
      take(to->items[k]);
    }
  }

  void copy() {
    const auto& block = *placed_.block;
    const auto old = require_value(block, "OLDSET", "a set of nodes", faults_);
    const auto change = require_value(block, "CHANGENUMBER", "what is added to numbers", faults_);
    const auto added = change.empty() ? std::nullopt : require_integer(change, "a number", faults_);
    if (block.find("SHIFT") == nullptr)
      faults_.add(block.at, "found *NCOPY without SHIFT, expected a shift and a turn");
    const auto* const times = block.find("MULTIPLE");
    const auto count = times == nullptr ? 1 : require_integer(times->value, "MULTIPLE", faults_);
    auto found = old.empty() ? std::nullopt : find_nodes(content_, placed_.scope, old, faults_);
    if (found)
      sort_without_repeats(found->items);
    if (!found || !added || !count || *count < 1 || *count > most_made || block.lines.empty())
      return;
    const auto shift = DataLine(block.lines[0], faults_).point(0);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Vector3d about = Vector3d::Zero();
    if (block.lines.size() > 1) {
      const DataLine line(block.lines[1], faults_);
      const auto a = line.point(0), b = line.point(3);
      const auto angle = line.number(6);
      if (!a || !b || !angle)
        return;
      if (*angle != 0 && (*b - *a).norm() == 0)
        return faults_.add(line.at(), "found an axis between two equal points, expected two different ones");
      about = *a;
      if (*angle != 0)
        turn = Eigen::AngleAxisd(*angle * std::numbers::pi / 180, (*b - *a).normalized()).toRotationMatrix();
    }
    if (!shift)
      return;
    std::vector<Vector3d> points;
    for (const auto item : found->items)
      points.push_back(place(item));
    for (std::int64_t i = 1; i <= *count; ++i)
      for (std::size_t k = 0; k < points.size(); ++k) {
        points[k] = turn * (points[k] + *shift - about) + about;
        add(content_.node_numbers[static_cast<std::size_t>(found->items[k])] + i * *added, points[k]);
      }
  }

  Content& content_;
  const Placed& placed_;
  Faults& faults_;
  std::vector<std::int32_t>* set_;
};

/// Makes elements of one keyword.
class ElementMaker {
public:
  ElementMaker(Content& content, const Placed& placed, Faults& faults)
      : content_(content), placed_(placed), faults_(faults),
        set_(set_named(content.element_sets, placed, placed.block->is("ELCOPY") ? "NEWSET" : "ELSET")) {}

  void make() {
    check_parameters(*placed_.block, faults_);
    if (placed_.block->is("ELCOPY"))
      return copy();
    for (const auto& line : placed_.block->lines)
      if (!is_blank(line))
        generate({line, faults_});
  }

private:
  void take(std::int32_t element) {
    if (set_ != nullptr)
      set_->push_back(element);
  }

  /// The element with its numbers and those of its nodes moved on.
  bool add(std::int32_t model, std::int64_t by, std::int64_t of_nodes, const Word& at) {
    const auto element = content_.elements[static_cast<std::size_t>(model)];
    const auto scope = static_cast<std::size_t>(placed_.scope);
    std::vector<NodeIndex> nodes;
    for (const auto node : content_.nodes_of(element)) {
      const auto number = content_.node_numbers[static_cast<std::size_t>(node)] + of_nodes;
      const auto found = content_.node_at[scope].find(number);
      if (found == content_.node_at[scope].end()) {
        faults_.add(at, fmt::format("found node {} of element {}, which the file does not have", number,
                                    element.number + by));
        return false;
      }
      nodes.push_back(found->second);
    }
    const auto index = static_cast<std::int32_t>(content_.elements.size());
    if (!content_.element_at[scope].try_emplace(element.number + by, index).second) {
      faults_.add(
          at, fmt::format("found element {} a second time, expected each number once", element.number + by));
      return false;
    }
    content_.elements.push_back(
        {element.type, element.number + by, placed_.scope, content_.connectivity.size(), at});
    content_.element_numbers.push_back(element.number + by);
    content_.connectivity.insert(content_.connectivity.end(), nodes.begin(), nodes.end());
    take(index);
    return true;
  }

  /// Rows, layers and blocks: each triple multiplies what there is by then.
  void generate(const DataLine& line) {
    const auto number = line.integer(0, "the number of an element");
    const auto& numbers = content_.element_at[static_cast<std::size_t>(placed_.scope)];
    const auto model = number ? numbers.find(*number) : numbers.end();
    if (model == numbers.end())
      return faults_.add(line.at(), "found no element of that number above, expected one to repeat");
    std::vector<std::pair<std::int64_t, std::int64_t>> offsets{{0, 0}}; // of elements, of nodes
    for (std::size_t first = 1; first <= 7 && line.has(first); first += 3) {
      const auto count = line.integer(first, "the number of elements");
      const auto of_nodes = line.integer(first + 1, "the step of nodes", 1);
      const auto of_elements = line.integer(first + 2, "the step of elements", 1);
      if (!count || !of_nodes || !of_elements)
        return;
      if (*count < 1 || *count * static_cast<std::int64_t>(offsets.size()) > most_made)
        return faults_.add(line.at(), fmt::format("found {} elements, expected 1 or more", *count));
      const auto known = offsets;
      for (std::int64_t i = 1; i < *count; ++i)
        for (const auto& [by, nodes] : known)
          offsets.emplace_back(by + i * *of_elements, nodes + i * *of_nodes);
    }
    const auto index = model->second;
    take(index);
    for (const auto& [by, nodes] : offsets)
      if (by != 0 && !add(index, by, nodes, line.at()))
        return;
  }

  void copy() {
    const auto& block = *placed_.block;
    const auto old = require_value(block, "OLDSET", "a set of elements", faults_);
    const auto by = require_value(block, "ELEMENTSHIFT", "what is added to numbers of elements", faults_);
    const auto nodes = require_value(block, "SHIFTNODES", "what is added to numbers of nodes", faults_);
    if (old.empty() || by.empty() || nodes.empty())
      return;
    const auto found = find_elements(content_, placed_.scope, old, faults_);
    const auto shift = require_integer(by, "a number", faults_);
    const auto of_nodes = require_integer(nodes, "a number", faults_);
    if (!found || !shift || !of_nodes)
      return;
    for (const auto item : found->items)
      if (!add(item, *shift, *of_nodes, old))
        return;
  }

  Content& content_;
  const Placed& placed_;
  Faults& faults_;
  std::vector<std::int32_t>* set_;
};

} // namespace

void generate_nodes(Content& content, const Placed& placed, Faults& faults) {
  NodeMaker(content, placed, faults).make();
}

void generate_elements(Content& content, const Placed& placed, Faults& faults) {
  ElementMaker(content, placed, faults).make();
}

} // namespace rubato::mesh::inp
