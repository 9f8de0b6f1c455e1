// SPDX-License-Identifier: LGPL-3.0-or-later
// yaml-cpp's events are used, not its nodes: nodes forget the place of keys, keep keys given twice silently,
// and expand aliases without a limit.
#include "rubato/deck/tree.hpp"

#include "rubato/deck/text.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <sstream>
#include <utility>

namespace rubato::deck {
namespace {

constexpr std::size_t deepest = 64;
constexpr std::size_t most_nodes = 200'000;

/// Ends the parsing; its fault has been added.
struct Unreadable {};

class Builder final : public YAML::EventHandler {
public:
  Builder(std::string file, Faults& faults, bool setting)
      : file_(std::move(file)), faults_(faults), setting_(setting) {}

  std::optional<Tree> take_root() { return std::move(root_); }

  Location place(const YAML::Mark& mark) const {
    return setting_ ? Location{file_} : Location{file_, mark.line + 1, mark.column + 1};
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1)
      stop(place(mark), "found a second YAML document, expected one deck a file");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    put(new_node(Tree::Kind::nothing, mark), anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    constexpr auto in_quotes_tag = "!";
    auto node = new_node(Tree::Kind::word, mark);
    node.text = value;
    node.in_quotes = tag == in_quotes_tag;
    if (!node.in_quotes)
      refuse_tag(node.at, tag);
    put(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchored_.find(anchor);
    if (found == anchored_.end())
      stop(place(mark), "found an alias inside of its own anchor");
    count(count_nodes(found->second), place(mark));
    put(found->second, YAML::NullAnchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(new_node(Tree::Kind::list, mark), tag, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(new_node(Tree::Kind::map, mark), tag, anchor);
  }
  void OnMapEnd() override {
    take_in_merged_maps(open_.back());
    close();
  }

private:
  struct Open {
    Tree node;
    YAML::anchor_t anchor;
    std::optional<Tree> key;          ///< of a map, read and waiting for its value
    std::map<std::string, int> lines; ///< of a map: where each key stands
  };

  [[noreturn]] void stop(const Location& at, const std::string& text) {
    faults_.add(at, text);
    throw Unreadable{};
  }

  void count(std::size_t nodes, const Location& at) {
    nodes_ += nodes;
    if (nodes_ > most_nodes)
      stop(at, fmt::format("found more than {} values (aliases expanded), which is no deck", most_nodes));
  }

  Tree new_node(Tree::Kind kind, const YAML::Mark& mark) {
    count(1, place(mark));
    Tree node;
    node.kind = kind;
    node.at = place(mark);
    node.from_setting = setting_;
    return node;
  }

  void refuse_tag(const Location& at, const std::string& tag) {
    constexpr auto no_tag = "?";
    if (!tag.empty() && tag != no_tag)
      faults_.add(at, fmt::format("found the YAML tag {}, expected a value without a tag", shown(tag)));
  }

  void open(Tree node, const std::string& tag, YAML::anchor_t anchor) {
    if (open_.size() >= deepest)
      stop(node.at, fmt::format("found maps and lists nested more than {} deep", deepest));
    refuse_tag(node.at, tag);
    open_.push_back({std::move(node), anchor, std::nullopt, {}});
  }

  void close() {
    auto [node, anchor, key, lines] = std::move(open_.back());
    open_.pop_back();
    put(std::move(node), anchor);
  }

  void put(Tree node, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      count(count_nodes(node), node.at);
      anchored_[anchor] = node;
    }
    if (open_.empty())
      root_ = std::move(node);
    else if (auto& parent = open_.back(); parent.node.is(Tree::Kind::list))
      parent.node.items.push_back(std::move(node));
    else if (!parent.key)
      parent.key = std::move(node);
    else
      put_entry(parent, std::move(node));
  }

  void put_entry(Open& map, Tree value) {
    const auto key = *std::exchange(map.key, std::nullopt);
    if (!key.is(Tree::Kind::word)) {
      faults_.add(key.at, fmt::format("found {} as a key, expected a word", described(key)));
      return;
    }
    if (value.is(Tree::Kind::nothing)) // an empty value has no place of its own
      value.at = key.at;
    const auto [first, is_new] = map.lines.try_emplace(key.text, key.at.line);
    if (is_new)
      map.node.entries.push_back({key.text, key.at, std::move(value)});
    else
      faults_.add(key.at,
                  fmt::format("found the key {} a second time{}", shown(key.text),
                              setting_ ? "" : fmt::format(", first given on line {}", first->second)));
  }

  /// `<<: *base` or `<<: [*a, *b]`: entries of the other maps, unless the map has the key itself.
  void take_in_merged_maps(Open& map) {
    auto& entries = map.node.entries;
    const auto found = std::ranges::find(entries, "<<", &Tree::Entry::key);
    if (found == entries.end())
      return;
    auto source = std::move(found->value);
    entries.erase(found);
    auto maps = source.is(Tree::Kind::list) ? std::move(source.items) : std::vector<Tree>{source};
    for (auto& other : maps) {
      if (!other.is(Tree::Kind::map)) {
        faults_.add(other.at, fmt::format("found {} after '<<', expected a map to merge", described(other)));
        continue;
      }
      for (auto& entry : other.entries)
        if (map.lines.try_emplace(entry.key, entry.at.line).second)
          entries.push_back(std::move(entry));
    }
  }

  std::string file_;
  Faults& faults_;
  bool setting_;
  int documents_ = 0;
  std::size_t nodes_ = 0;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Tree> anchored_;
  std::optional<Tree> root_;
};

} // namespace

const Tree* Tree::find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &Entry::key);
  return found == entries.end() ? nullptr : &found->value;
}

Tree* Tree::find(std::string_view key) {
  return const_cast<Tree*>(std::as_const(*this).find(key));
}

std::string joined(const std::string& path, const std::string& step) {
  return path.empty() ? step : path + "." + step;
}

std::size_t count_nodes(const Tree& tree) {
  std::size_t nodes = 1;
  for (const auto& item : tree.items)
    nodes += count_nodes(item);
  for (const auto& entry : tree.entries)
    nodes += count_nodes(entry.value);
  return nodes;
}

std::string described(const Tree& tree) {
  switch (tree.kind) {
  case Tree::Kind::word:
    return tree.in_quotes ? fmt::format("the text {}", shown(tree.text)) : shown(tree.text);
  case Tree::Kind::list:
    return "a list";
  case Tree::Kind::map:
    return "a map";
  default:
    return "nothing";
  }
}

std::optional<Tree> parse_tree(std::string_view text, const std::string& file, Faults& faults, bool setting) {
  if (!is_readable(text, file, faults))
    return std::nullopt;
  std::istringstream stream{std::string(text)};
  Builder builder(file, faults, setting);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
    auto root = builder.take_root();
    if (!root)
      faults.add({file}, "found no YAML document");
    return root;
  } catch (const Unreadable&) {
  } catch (const YAML::Exception& broken) {
    faults.add(builder.place(broken.mark), "the text is not YAML: " + broken.msg);
  }
  return std::nullopt;
}

} // namespace rubato::deck
