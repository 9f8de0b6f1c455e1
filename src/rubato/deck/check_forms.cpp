// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/check_forms.hpp"

#include "rubato/deck/grammar/parts.hpp"
#include "rubato/deck/values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rubato::deck {
namespace {

using grammar::Form;
using Kind = Form::Kind;

/// Nothing is laid over maps inside of lists, which are replaced whole: they must be complete.
enum class Inside { maps, list };

Tree::Kind kind_of(const Form& form) {
  switch (form.kind) {
  case Kind::list:
    return Tree::Kind::list;
  case Kind::map:
  case Kind::named:
    return Tree::Kind::map;
  default:
    return Tree::Kind::word;
  }
}

std::string described(const Form& form) {
  switch (form.kind) {
  case Kind::number:
    return "a number" + study::bounds_text(form.range);
  case Kind::whole_number:
    return "a whole number" + study::bounds_text(form.range);
  case Kind::word:
    return fmt::format("{}", fmt::join(form.words, ", "));
  case Kind::list:
    return "a list";
  case Kind::map:
  case Kind::named:
    return "a map";
  default:
    return "a word";
  }
}

void check(const Value& value, Inside inside);

void check_list(const Value& value, const Form& form) {
  const auto found = items(value);
  if (found.size() < form.least || found.size() > form.most)
    value.fault(fmt::format("found {} entries, expected {}", found.size(),
                            form.most == Form::any_count ? fmt::format("at least {}", form.least)
                                                         : fmt::format("{} to {}", form.least, form.most)));
  for (const auto& item : found)
    check(item, Inside::list);
}

void check_map(const Value& value, const Form& form, Inside inside) {
  MapReader map(value);
  std::size_t given = 0;
  for (const auto& key : form.keys) {
    const auto found = key.required && inside == Inside::list ? map.require(key.name) : map.find(key.name);
    if (!found)
      continue;
    if (!key.forms.empty())
      check(*found, inside);
    ++given;
  }
  map.finish();
  if (inside == Inside::list && (given < form.least || given > form.most))
    value.fault(fmt::format("found {} keys, expected {}", given, form.least));
}

void check_form(const Value& value, const Form& form, Inside inside) {
  double number = 0;
  int whole_number = 0;
  bool truth = false;
  std::string text;
  study::FieldValue expression;
  switch (form.kind) {
  case Kind::number:
    read(value, number, form.range);
    break;
  case Kind::whole_number:
    read(value, whole_number, form.range);
    break;
  case Kind::truth:
    read(value, truth);
    break;
  case Kind::word:
    read_choice(value, form.words);
    break;
  case Kind::name:
    read_name(value, text);
    break;
  case Kind::text:
    read(value, text);
    break;
  case Kind::expression:
    if (read(value, expression) && expression.number() != nullptr)
      read(value, number, form.range);
    break;
  case Kind::list:
    check_list(value, form);
    break;
  case Kind::map:
    check_map(value, form, inside);
    break;
  case Kind::named:
    for (const auto& entry : named_entries(value))
      check(entry.value, inside);
    break;
  }
}

/// Whether the value has the form, by itself.
bool has(const Value& value, const Form& form, Inside inside) {
  Faults faults;
  check_form(Value(value.tree(), value.path(), faults, value.forms()), form, inside);
  faults.add_bounds({});
  return faults.empty();
}

bool is_map(const Form* form) {
  return form->kind == Kind::map;
}

/// Of several maps the one that has most of the value's keys.
const Form& nearest_map(const Value& value, const std::vector<const Form*>& maps) {
  const auto known_keys = [&](const Form* form) {
    return std::ranges::count_if(
        form->keys, [&](const grammar::Key& key) { return value.tree().find(key.name) != nullptr; });
  };
  return **std::ranges::max_element(maps, {}, known_keys);
}

/// Maps may have a key of the same name with different forms: the others must not be seen.
void check_nearest_map(const Value& value, const std::vector<const Form*>& maps, Inside inside) {
  const grammar::Forms one{nearest_map(value, maps)};
  check_form(Value(value.tree(), value.path(), value.faults(), one), one.front(), inside);
}

void check(const Value& value, Inside inside) {
  std::vector<const Form*> alike;
  std::vector<std::string> all;
  for (const auto& form : value.forms()) {
    all.push_back(described(form));
    if (value.tree().is(kind_of(form)))
      alike.push_back(&form);
  }
  if (alike.size() == 1)
    check_form(value, *alike.front(), inside);
  else if (!alike.empty() && std::ranges::all_of(alike, is_map))
    check_nearest_map(value, alike, inside);
  else if (std::ranges::none_of(alike, [&](const Form* form) { return has(value, *form, inside); }))
    value.fault(fmt::format("found {}, expected {}", described(value.tree()), fmt::join(all, " or ")));
}

} // namespace

Faults faults_of_forms(const Tree& deck) {
  Faults faults;
  check(Value(deck, "", faults, grammar::deck()), Inside::maps);
  faults.add_bounds({});
  return faults;
}

} // namespace rubato::deck
