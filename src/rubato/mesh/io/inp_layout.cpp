// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/inp_layout.hpp"

#include "rubato/core/naming.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

namespace rubato::mesh::inp {
namespace {

constexpr std::size_t most_instances = 100'000;

struct Part {
  std::string name;
  std::vector<const Block*> blocks;
};

/// What is open while the file is gone through.
class Arrangement {
public:
  explicit Arrangement(Faults& faults) : faults_(faults) {}

  void take(const Block& block) {
    if (block.keyword == nullptr)
      return;
    if (block.is("PART"))
      begin_part(block);
    else if (block.is("INSTANCE"))
      begin_instance(block);
    else if (block.is("ASSEMBLY"))
      begin(block, assembly_);
    else if (block.is("END PART"))
      end(block, open_part_, part_);
    else if (block.is("END INSTANCE"))
      end(block, instance_begin_, scope_);
    else if (block.is("END ASSEMBLY"))
      end(block, assembly_, nothing_);
    else if (part_ != nullptr)
      part_->blocks.push_back(&block);
    else
      layout_.blocks.push_back({&block, scope_});
  }

  Layout finish() {
    for (const auto* open : {open_part_, instance_begin_, assembly_})
      if (open != nullptr)
        faults_.add(open->at, fmt::format("found {} without its end, expected *END {} after it",
                                          open->at.text, open->keyword->name));
    return std::move(layout_);
  }

private:
  bool begin(const Block& block, const Block*& open) {
    check_parameters(block, faults_);
    if (open != nullptr)
      faults_.add(block.at, fmt::format("found {} inside of that of line {}, expected *END {} before it",
                                        block.at.text, open->at.line, block.keyword->name));
    open = &block;
    return true;
  }

  template <class Value> void end(const Block& block, const Block*& open, Value& value) {
    if (open == nullptr)
      faults_.add(block.at, fmt::format("found {} without its begin, expected *{} before it", block.at.text,
                                        block.keyword->name.substr(4)));
    open = nullptr;
    value = {};
  }

  void begin_part(const Block& block) {
    begin(block, open_part_);
    const auto name = require_value(block, "NAME", "the name of the part", faults_);
    auto [found, is_new] = parts_.try_emplace(folded(name.text));
    if (!is_new && !name.empty())
      faults_.add(name, fmt::format("found a second part {}, expected each name once",
                                    shown(std::string(name.text))));
    found->second.name = name.text;
    part_ = &found->second;
  }

  void begin_instance(const Block& block) {
    begin(block, instance_begin_);
    const auto name = require_value(block, "NAME", "the name of the instance", faults_);
    const auto part_name = require_value(block, "PART", "the name of a part", faults_);
    if (layout_.scopes.size() > most_instances)
      return faults_.add(block.at, fmt::format("found more than {} instances", most_instances));
    if (layout_.scope_named(name.text))
      faults_.add(name, fmt::format("found a second instance {}, expected each name once",
                                    shown(std::string(name.text))));
    scope_ = static_cast<int>(layout_.scopes.size());
    layout_.scopes.push_back(placed(block, std::string(name.text)));
    const auto part = parts_.find(folded(part_name.text));
    if (part != parts_.end()) {
      for (const auto* of_part : part->second.blocks)
        layout_.blocks.push_back({of_part, scope_});
    } else if (!part_name.empty()) {
      std::vector<std::string> names;
      for (const auto& [key, known] : parts_)
        names.push_back(known.name);
      faults_.add(part_name, fmt::format("found the part {}, which the file does not have above{}",
                                         shown(std::string(part_name.text)),
                                         suggestion(std::string(part_name.text), names)));
    }
  }

  /// First the translation, then the turn about an axis through two points by an angle in degrees.
  Scope placed(const Block& block, std::string name) {
    Scope scope{std::move(name)};
    std::vector<std::vector<double>> rows;
    for (const auto& line : block.lines) {
      if (is_blank(line))
        continue;
      rows.emplace_back();
      for (const auto& word : fields_of(line))
        rows.back().push_back(
            require_number(word, "a coordinate of the instance's place", faults_, 0).value_or(0));
      const std::size_t most = rows.size() == 1 ? 3 : 7;
      if (rows.back().size() > most || rows.size() > 2)
        faults_.add(word_of(line), "found more than a translation (3 numbers) and a rotation (7 numbers)");
    }
    if (!rows.empty())
      rows[0].resize(3);
    if (!rows.empty())
      scope.shift = Eigen::Vector3d(rows[0][0], rows[0][1], rows[0][2]);
    if (rows.size() < 2)
      return scope;
    rows[1].resize(7);
    const Eigen::Vector3d from(rows[1][0], rows[1][1], rows[1][2]), to(rows[1][3], rows[1][4], rows[1][5]);
    if ((to - from).norm() == 0) {
      faults_.add(block.at, "found a rotation axis between two equal points, expected two different ones");
      return scope;
    }
    const double angle = rows[1][6] * std::numbers::pi / 180;
    scope.turn = Eigen::AngleAxisd(angle, (to - from).normalized()).toRotationMatrix();
    scope.shift = scope.turn * (scope.shift - from) + from;
    return scope;
  }

  Faults& faults_;
  Layout layout_;
  std::map<std::string, Part> parts_;
  Part* part_ = nullptr;
  int scope_ = 0;
  int nothing_ = 0;
  const Block* open_part_ = nullptr;
  const Block* instance_begin_ = nullptr;
  const Block* assembly_ = nullptr;
};

} // namespace

std::optional<int> Layout::scope_named(std::string_view name) const {
  const auto wanted = folded(name);
  for (std::size_t i = 1; i < scopes.size(); ++i)
    if (folded(scopes[i].name) == wanted)
      return static_cast<int>(i);
  return std::nullopt;
}

Layout lay_out(const Source& source, Faults& faults) {
  Arrangement arrangement(faults);
  for (const auto& block : source.blocks)
    arrangement.take(block);
  return arrangement.finish();
}

} // namespace rubato::mesh::inp
