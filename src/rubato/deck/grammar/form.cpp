// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/grammar/form.hpp"

#include "rubato/study/words.hpp"

#include <algorithm>
#include <iterator>

namespace rubato::deck::grammar {
namespace {

using Kind = Form::Kind;

study::Range hull(const study::Range& one, const study::Range& other) {
  auto range = one;
  if (other.low < one.low || (other.low == one.low && other.low_allowed)) {
    range.low = other.low;
    range.low_allowed = other.low_allowed;
  }
  if (other.high > one.high || (other.high == one.high && other.high_allowed)) {
    range.high = other.high;
    range.high_allowed = other.high_allowed;
  }
  return range;
}

Form of(Kind kind) {
  return {.kind = kind, .words = {}, .title = {}, .keys = {}};
}

Forms of_numbers(Kind kind, const study::Range& range) {
  auto form = of(kind);
  form.range = range;
  return {std::move(form)};
}

} // namespace

Forms number(const study::Range& range) {
  return of_numbers(Kind::number, range);
}

Forms whole_number(const study::Range& range) {
  return of_numbers(Kind::whole_number, range);
}

Forms truth() {
  return {of(Kind::truth)};
}

Forms word(std::vector<std::string> words) {
  auto form = of(Kind::word);
  form.words = std::move(words);
  return {std::move(form)};
}

Forms name() {
  return {of(Kind::name)};
}

Forms names() {
  return either(name(), list(name()));
}

Forms text() {
  return {of(Kind::text)};
}

Forms expression() {
  return {of(Kind::expression)};
}

Forms list(Forms items, std::size_t least, std::size_t most) {
  auto form = of(Kind::list);
  form.of = std::move(items);
  form.least = least;
  form.most = most;
  return {std::move(form)};
}

Forms map(std::string title, std::vector<Key> keys) {
  auto form = of(Kind::map);
  form.title = std::move(title);
  form.keys = std::move(keys);
  return {std::move(form)};
}

Forms named(Forms entries) {
  auto form = of(Kind::named);
  form.of = std::move(entries);
  return {std::move(form)};
}

Forms either(Forms one, Forms other) {
  std::ranges::move(other, std::back_inserter(one));
  return one;
}

Forms varying(Forms value) {
  auto alone = value;
  return either(std::move(alone),
                map("a value times a function of time",
                    {{"value", "what the function multiplies", std::move(value), true},
                     {"function", "name of a function of time, an entry of 'functions'", name()}}));
}

Forms motion(Forms value) {
  auto alone = value;
  return either(
      std::move(alone),
      map("a motion times a function of time",
          {{"value", "displacement, what the function multiplies", value},
           {"velocity", "instead: velocity, the displacement follows by integration over time", value},
           {"acceleration", "instead: acceleration, from rest", std::move(value)},
           {"function", "name of a function of time, an entry of 'functions'", name()}}));
}

std::vector<Key> components(const std::string& meaning, const Forms& forms) {
  std::vector<Key> keys;
  keys.reserve(study::axis_words.size());
  for (const auto axis : study::axis_words)
    keys.push_back({std::string(axis), meaning + " along " + std::string(axis), forms});
  return keys;
}

Forms coordinates() {
  return list(number(), 2, study::axis_words.size());
}

void add_number(std::vector<Key>& keys, std::string_view name, std::string_view meaning,
                const study::Range& range, FormsOfRange forms_of_range) {
  const auto known = std::ranges::find(keys, name, &Key::name);
  if (known == keys.end()) {
    keys.push_back({std::string(name), std::string(meaning), forms_of_range(range)});
    return;
  }
  auto& known_range = known->forms.front().range;
  known_range = hull(known_range, range);
  if (known->meaning.find(meaning) == std::string::npos)
    known->meaning += "; or " + std::string(meaning);
}

std::vector<Key> joined(std::vector<Key> one, std::vector<Key> other) {
  std::ranges::move(other, std::back_inserter(one));
  return one;
}

const Forms* forms_of(const Forms& forms, std::string_view key) {
  for (const auto& form : forms)
    for (const auto& entry : form.keys)
      if (entry.name == key)
        return &entry.forms;
  return nullptr;
}

const Forms* forms_of_each(const Forms& forms, Kind kind) {
  const auto found = std::ranges::find(forms, kind, &Form::kind);
  return found == forms.end() ? nullptr : &found->of;
}

} // namespace rubato::deck::grammar
