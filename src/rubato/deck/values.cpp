// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/values.hpp"

#include "rubato/core/naming.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace rubato::deck {
namespace {

void expected(const Value& value, const std::string& what) {
  value.fault(fmt::format("found {}, expected {}", described(value.tree()), what));
}

bool is_plain_word(const Tree& tree) {
  return tree.is(Tree::Kind::word) && !tree.in_quotes;
}

/// The whole text as a number; YAML allows a leading plus.
template <class T> std::optional<T> number_in(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-')
    text.remove_prefix(1);
  T number{};
  const auto* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end)
    return std::nullopt;
  return number;
}

template <class T>
bool read_number(const Value& value, T& target, const study::Range& range, const std::string& noun) {
  std::optional<T> number;
  if (is_plain_word(value.tree()))
    number = number_in<T>(value.tree().text);
  const bool good = number && std::isfinite(static_cast<double>(*number)) && range.contains(*number);
  if (good)
    target = *number;
  else if (const auto bounds = study::bounds_text(range); !bounds.empty())
    expected(value, noun + bounds);
  else
    value.number_fault(fmt::format("found {}, expected {}", described(value.tree()), noun));
  return good;
}

bool read_number(const Value& value, double& target, const study::Range& range) {
  return read_number(value, target, range, "a number");
}
bool read_number(const Value& value, int& target, const study::Range& range) {
  return read_number(value, target, range, "a whole number");
}

template <class T> bool read_numbers(const Found& value, std::vector<T>& target, const study::Range& range) {
  if (!value)
    return false;
  std::vector<T> numbers;
  bool good = value->tree().is(Tree::Kind::list);
  for (const auto& element : items(value)) {
    T number{};
    good = read_number(element, number, range) && good;
    numbers.push_back(number);
  }
  if (good)
    target = std::move(numbers);
  else
    value->spoil();
  return good;
}

} // namespace

void Value::fault(const std::string& text, const Location& where) const {
  faults_->spoil(path_);
  faults_->add(where, path_.empty() ? text : fmt::format("{}: {}", path_, text));
}

void Value::number_fault(const std::string& text) const {
  faults_->add_number(at(), path_.empty() ? text : fmt::format("{}: {}", path_, text), path_);
}

void Value::miss(const std::string& key) const {
  faults_->add(at(), path_.empty() ? fmt::format("'{}' is missing", key)
                                   : fmt::format("{}: '{}' is missing", path_, key));
  faults_->spoil(joined(path_, key));
}

void Value::spoil() const {
  faults_->spoil(path_);
}

Value Value::in(const std::string& step, const Tree& tree, grammar::Form::Kind kind) const {
  const auto* forms = grammar::forms_of_each(*forms_, kind);
  if (forms == nullptr)
    throw std::logic_error(fmt::format("the grammar has no list or map of names at {}", path_));
  return {tree, joined(path_, step), *faults_, *forms};
}

const grammar::Forms& Value::declared(std::string_view key) const {
  const auto* forms = grammar::forms_of(*forms_, key);
  if (forms == nullptr)
    throw std::logic_error(fmt::format("the grammar has no key {} in {}", key, path_));
  return *forms;
}

MapReader::MapReader(Value value) : value_(std::move(value)) {
  if (!is_map())
    expected(value_, "a map");
}

Found MapReader::find(std::string_view key) {
  if (std::ranges::find(asked_, key) == asked_.end())
    asked_.emplace_back(key);
  const auto& forms = value_.declared(key);
  const auto* tree = value_.tree().find(key);
  if (tree == nullptr || tree->is(Tree::Kind::removed))
    return std::nullopt;
  return Value(*tree, joined(value_.path(), std::string(key)), value_.faults(), forms);
}

Found MapReader::require(std::string_view key) {
  auto found = find(key);
  if (!found && is_map())
    value_.miss(std::string(key));
  return found;
}

void MapReader::refuse(std::string_view key, const std::string& reason) {
  if (const auto found = find(key))
    found->fault(reason);
}

void MapReader::spoil(std::string_view key) const {
  value_.faults().spoil(joined(value_.path(), std::string(key)));
}

void MapReader::finish() const {
  for (const auto& entry : value_.tree().entries) {
    if (std::ranges::find(asked_, entry.key) != asked_.end())
      continue;
    const auto path = joined(value_.path(), entry.key);
    value_.faults().add(entry.at,
                        fmt::format("unknown key {}{}", shown(path), suggestion(entry.key, asked_)));
  }
}

bool read(const Found& value, double& target, const study::Range& range) {
  return value && read_number(*value, target, range);
}

bool read(const Found& value, int& target, const study::Range& range) {
  return value && read_number(*value, target, range);
}

bool read(const Found& value, std::optional<double>& target, const study::Range& range) {
  double number = 0;
  const bool good = read(value, number, range);
  if (good)
    target = number;
  return good;
}

bool read(const Found& value, study::FieldValue& target) {
  if (!value)
    return false;
  const auto& tree = value->tree();
  if (!tree.is(Tree::Kind::word)) {
    value->number_fault(fmt::format("found {}, expected a number or an expression", described(tree)));
    return false;
  }
  const auto number = is_plain_word(tree) ? number_in<double>(tree.text) : std::nullopt;
  if (number && std::isfinite(*number))
    target = *number;
  else
    target = study::Formula{tree.text};
  return true;
}

bool read(const Found& value, bool& target) {
  constexpr std::array<study::Word<bool>, 2> table{{{"true", true}, {"false", false}}};
  return read(value, target, table);
}

bool read(const Found& value, std::optional<bool>& target) {
  bool flag = false;
  const bool good = read(value, flag);
  if (good)
    target = flag;
  return good;
}

bool read(const Found& value, std::string& target) {
  if (!value)
    return false;
  const bool good = value->tree().is(Tree::Kind::word);
  if (good)
    target = value->tree().text;
  else
    expected(*value, "text");
  return good;
}

bool read(const Found& value, std::vector<double>& target, const study::Range& range) {
  return read_numbers(value, target, range);
}

bool read(const Found& value, std::vector<int>& target, const study::Range& range) {
  return read_numbers(value, target, range);
}

bool read_name(const Found& value, std::string& target) {
  if (!value)
    return false;
  const bool good = value->tree().is(Tree::Kind::word) && !value->tree().text.empty();
  if (good)
    target = value->tree().text;
  else
    expected(*value, "a name");
  return good;
}

bool read_names(const Found& value, std::vector<std::string>& target) {
  if (!value)
    return false;
  std::vector<std::string> names;
  bool good = true;
  const auto read_one = [&](const Found& element) {
    std::string name;
    good = read_name(element, name) && good;
    names.push_back(std::move(name));
  };
  if (value->tree().is(Tree::Kind::list))
    for (const auto& element : items(value))
      read_one(element);
  else
    read_one(value);
  if (good)
    target = std::move(names);
  else
    value->spoil();
  return good;
}

std::optional<std::size_t> read_choice(const Found& value, const std::vector<std::string>& words) {
  if (!value)
    return std::nullopt;
  const auto& tree = value->tree();
  const auto found = tree.is(Tree::Kind::word) ? std::ranges::find(words, tree.text) : words.end();
  if (found != words.end())
    return static_cast<std::size_t>(found - words.begin());
  const auto nearest = tree.is(Tree::Kind::word) ? nearest_word(tree.text, words) : "";
  expected(*value, fmt::format("{}{}{}", words.size() > 1 ? "one of " : "", fmt::join(words, ", "),
                               nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  return std::nullopt;
}

std::vector<Value> items(const Found& value) {
  std::vector<Value> found;
  if (!value)
    return found;
  if (!value->tree().is(Tree::Kind::list))
    expected(*value, "a list");
  for (std::size_t i = 0; i < value->tree().items.size(); ++i)
    found.push_back(value->in(std::to_string(i), value->tree().items[i], grammar::Form::Kind::list));
  return found;
}

std::vector<NamedValue> named_entries(const Found& value) {
  std::vector<NamedValue> found;
  if (!value)
    return found;
  if (!value->tree().is(Tree::Kind::map))
    expected(*value, "a map from names to entries");
  for (const auto& [key, at, tree] : value->tree().entries) {
    if (tree.is(Tree::Kind::removed))
      continue;
    if (is_name(key))
      found.push_back({{key, at}, value->in(key, tree, grammar::Form::Kind::named)});
    else
      value->fault(
          fmt::format("found the name {}, expected up to 100 letters, digits, '_' or '-'", shown(key)), at);
  }
  return found;
}

} // namespace rubato::deck
