// SPDX-License-Identifier: LGPL-3.0-or-later
/// Reading single values of a deck: typed, checked, with every fault kept.
#pragma once

#include "rubato/deck/grammar/form.hpp"
#include "rubato/deck/tree.hpp"
#include "rubato/study/range.hpp"
#include "rubato/study/study.hpp"
#include "rubato/study/words.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::deck {

/// A node of the deck that is being read, its path in words, "time.step", and the forms it may have.
class Value {
public:
  Value(const Tree& tree, std::string path, Faults& faults, const grammar::Forms& forms)
      : tree_(&tree), path_(std::move(path)), faults_(&faults), forms_(&forms) {}

  const Tree& tree() const { return *tree_; }
  const Location& at() const { return tree_->at; }
  const std::string& path() const { return path_; }
  Faults& faults() const { return *faults_; }
  const grammar::Forms& forms() const { return *forms_; }

  /// Adds the fault "path: text" at this value, or at another place.
  void fault(const std::string& text) const { fault(text, at()); }
  void fault(const std::string& text, const Location& where) const;
  /// Adds the fault "path: text" of a number; what it may be is told when the study is judged.
  void number_fault(const std::string& text) const;
  /// Adds the fault that a key is missing in this map.
  void miss(const std::string& key) const;
  /// No rule about this value can be judged.
  void spoil() const;

  /// The forms of a key. Throws std::logic_error when the grammar has no such key here.
  const grammar::Forms& declared(std::string_view key) const;
  /// An item of a list, or an entry of a map whose keys are names. Throws std::logic_error when the grammar
  /// has neither here.
  Value in(const std::string& step, const Tree& tree, grammar::Form::Kind kind) const;

private:
  const Tree* tree_;
  std::string path_;
  Faults* faults_;
  const grammar::Forms* forms_;
};

/// A value that may not have been given.
using Found = std::optional<Value>;

/// A map that is being read. It remembers which keys were asked for: those are the valid ones.
class MapReader {
public:
  /// A fault when the value is not a map; nothing is found in it then and nothing is missing.
  explicit MapReader(Value value);

  const Value& value() const { return value_; }
  bool is_map() const { return value_.tree().is(Tree::Kind::map); }

  /// Throws std::logic_error when the grammar has no such key in this map: the schema would not know it.
  Found find(std::string_view key);
  /// A fault when the key is missing.
  Found require(std::string_view key);
  /// A key that exists but has no meaning here: a fault "key: reason" when it is given.
  void refuse(std::string_view key, const std::string& reason);
  /// No rule about the value of that key can be judged.
  void spoil(std::string_view key) const;
  /// Faults for the keys that were never asked for. To be called last.
  void finish() const;

private:
  Value value_;
  std::vector<std::string> asked_;
};

/// Reads into `target` and returns true; leaves it alone and returns false when the value was not given or is
/// faulty (the fault is added). Numbers are strict: "1e-3s", inf and nan are faults.
bool read(const Found& value, double& target, const study::Range& range = {});
bool read(const Found& value, std::optional<double>& target, const study::Range& range = {});
/// A number, or any other text: an expression, which is judged with the study.
bool read(const Found& value, study::FieldValue& target);
bool read(const Found& value, int& target, const study::Range& range = {});
bool read(const Found& value, bool& target);
bool read(const Found& value, std::optional<bool>& target);
/// Any word, also one that looks like a number.
bool read(const Found& value, std::string& target);
/// A list of numbers or of whole numbers.
bool read(const Found& value, std::vector<double>& target, const study::Range& range = {});
bool read(const Found& value, std::vector<int>& target, const study::Range& range = {});
/// A word that is not empty.
bool read_name(const Found& value, std::string& target);
/// One name or a list of them, none twice.
bool read_names(const Found& value, std::vector<std::string>& target);

/// The place of the value among `words`; nothing and a fault when it is none of them.
std::optional<std::size_t> read_choice(const Found& value, const std::vector<std::string>& words);

/// One of the accepted words of a table.
template <class E, std::size_t N>
bool read(const Found& value, E& target, const std::array<study::Word<E>, N>& table) {
  std::vector<std::string> words;
  std::vector<E> meanings;
  for (const auto& word : table) {
    if (!word.accepted)
      continue;
    words.emplace_back(word.text);
    meanings.push_back(word.value);
  }
  const auto choice = read_choice(value, words);
  if (choice)
    target = meanings[*choice];
  return choice.has_value();
}

/// The items of a list, "path.0" first; a fault when it is none.
std::vector<Value> items(const Found& value);

/// An entry of a map whose keys are names the user chose.
struct NamedValue {
  Name name;
  Value value;
};
/// The entries of such a map. A name may be a column or a folder of the results: letters, digits, "_" and
/// "-".
std::vector<NamedValue> named_entries(const Found& value);

} // namespace rubato::deck
