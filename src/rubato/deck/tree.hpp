// SPDX-License-Identifier: LGPL-3.0-or-later
/// A deck as it is written: maps, lists and words with their places, before any word means something.
#pragma once

#include "rubato/deck/faults.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::deck {

/// A name and the place where it was written.
struct Name {
  std::string text;
  Location at;
};

struct Tree {
  enum class Kind {
    nothing, ///< `~`, `null` or an empty value
    removed, ///< taken away by a run or a setting; stays so that its key is still checked
    word,
    list,
    map
  };
  struct Entry;

  Kind kind = Kind::nothing;
  Location at;
  std::string text;           ///< of a word
  bool in_quotes = false;     ///< a word that YAML says is text, never a number
  bool from_setting = false;  ///< written on the command line, not in the file
  std::vector<Tree> items;    ///< of a list
  std::vector<Entry> entries; ///< of a map, in the order of the file, keys unique

  bool is(Kind wanted) const { return kind == wanted; }
  /// The value of a map's key; none when there is no such key.
  Tree* find(std::string_view key);
  const Tree* find(std::string_view key) const;
};

struct Tree::Entry {
  std::string key;
  Location at;
  Tree value;
};

/// The path of a value inside of another one: "time.step".
std::string joined(const std::string& path, const std::string& step);

/// Nodes of the tree, itself included.
std::size_t count_nodes(const Tree& tree);

/// "a list", "a map", "nothing", or the word in quotes.
std::string described(const Tree& tree);

/// Reads one YAML document. Anchors, aliases and merge keys (`<<`) are expanded. Faults: broken YAML, a
/// second document, a key given twice or not a word, tags, deeper than 64 levels, more than 200,000 nodes.
/// Nothing when the text could not be read to its end; then at least one fault was added.
/// With `setting`, the text came from the command line and every place is just `file`.
std::optional<Tree> parse_tree(std::string_view text, const std::string& file, Faults& faults,
                               bool setting = false);

} // namespace rubato::deck
