// SPDX-License-Identifier: LGPL-3.0-or-later
// Functions of time, and tables along an axis.
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/words.hpp"

namespace rubato::deck::grammar {
namespace {

Key outside(const std::string& meaning) {
  return {"outside", meaning + "; constant when not given", word_of(study::outside_words)};
}

/// What is no product.
std::vector<Key> simple_keys() {
  return {{"times", "of a table: instants, ascending [time]", list(number(), 1)},
          {"values", "of a table: factors, one for each instant", list(number())},
          outside("before the first and after the last instant of a table"),
          {"csv", "a table: file with columns of numbers, relative to the folder of the deck", name()},
          {"time", "name of the column of instants; the first one when not given", name()},
          {"value", "name of the column of values", name()},
          {"ramp", "a straight line between two instants, constant before and after",
           either(list(number(), 2, 2),
                  map("a ramp", {{"begin", "instant at which it begins [time]; 0 when not given", number()},
                                 {"end", "instant at which it ends [time]", number(), true},
                                 {"from", "value before; 0 when not given", number()},
                                 {"to", "value after; 1 when not given", number()}}))},
          {"sine", "mean + amplitude sin(2 pi frequency t + phase)",
           map("a sine", {{"frequency", "[1/time]", number(study::bounds::frequency), true},
                          {"amplitude", "1 when not given", number()},
                          {"phase", "[degrees]; 0 when not given", number()},
                          {"mean", "added to it; 0 when not given", number()}})},
          {"expression", "an expression of t", expression()}};
}

Forms table_along_axis() {
  std::vector<std::string> axes(study::axis_words.begin(), study::axis_words.end());
  return map("a table along an axis",
             {{"along", "axis of the coordinates, undeformed", word(std::move(axes)), true},
              {"at", "coordinates, ascending [length]", list(number(), 1)},
              {"values", "values, one for each coordinate", list(number())},
              {"csv", "file with columns of numbers, relative to the folder of the deck", name()},
              {"coordinate", "name of the column of coordinates; the first one when not given", name()},
              {"column", "name of the column of values", name()},
              outside("before the first and after the last coordinate")});
}

Forms field_of_file() {
  return map("a field at the nodes of a file, on the same mesh",
             {{"field", "file (.med, .rmed, .vtu, .pvd), relative to the folder of the deck", name(), true},
              {"name", "of the field", name(), true},
              {"component", "of a field that has several", name()},
              {"at", "instant of the file [time]; linear between its instants when not given", number()}});
}

} // namespace

Forms functions() {
  auto keys = simple_keys();
  keys.push_back({"product", "the product of functions: names of others, or functions",
                  list(either(name(), map("a factor", simple_keys())), 1)});
  return named(map("a function of time", std::move(keys)));
}

Forms field_value(const study::Range& range) {
  auto number_or_text = expression();
  number_or_text.front().range = range;
  return either(std::move(number_or_text), either(table_along_axis(), field_of_file()));
}

} // namespace rubato::deck::grammar
