// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/schema.hpp"

#include "rubato/deck/grammar/parts.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace rubato::deck {
namespace {

using grammar::Form;
using grammar::Forms;
using Json = nlohmann::ordered_json;
using Kind = Form::Kind;

/// Where a value stands: in the deck, over which runs may be laid; in an entry of a list, which is replaced
/// whole and so must be complete; in a run, which may remove any value by `~`.
enum class Place { deck, list, run };

Json to_json(const Forms& forms, Place place);

/// Letters, digits, '_' and '-', as core/naming.hpp has it, which counts bytes.
constexpr auto name_pattern = R"(^([A-Za-z0-9_-]|[^\x00-\x7F]){1,100}$)";

void put_bounds(Json& schema, const study::Range& range) {
  if (std::isfinite(range.low))
    schema[range.low_allowed ? "minimum" : "exclusiveMinimum"] = range.low;
  if (std::isfinite(range.high))
    schema[range.high_allowed ? "maximum" : "exclusiveMaximum"] = range.high;
}

Json of_number(const char* type, const study::Range& range) {
  Json schema{{"type", type}};
  put_bounds(schema, range);
  return schema;
}

/// A word may look like a number or like a truth to YAML.
Json of_any_word() {
  return {{"type", {"string", "number", "boolean"}}};
}

Json of_list(const Form& form) {
  Json schema{{"type", "array"}, {"items", to_json(form.of, Place::list)}};
  if (form.least > 0)
    schema["minItems"] = form.least;
  if (form.most != Form::any_count)
    schema["maxItems"] = form.most;
  return schema;
}

Json required_keys(const Form& form) {
  auto keys = Json::array();
  for (const auto& key : form.keys)
    if (key.required)
      keys.push_back(key.name);
  return keys;
}

Json of_map(const Form& form, Place place) {
  Json schema{{"title", form.title}, {"type", "object"}, {"additionalProperties", false}};
  schema["properties"] = Json::object();
  for (const auto& key : form.keys) {
    if (key.forms.empty())
      continue;
    Json property{{"description", key.meaning}};
    property.update(to_json(key.forms, place));
    schema["properties"][key.name] = property;
  }
  if (place != Place::list)
    return schema;
  if (auto required = required_keys(form); !required.empty())
    schema["required"] = std::move(required);
  if (form.least > 0)
    schema["minProperties"] = form.least;
  if (form.most != Form::any_count)
    schema["maxProperties"] = form.most;
  return schema;
}

Json of_named(const Form& form, Place place) {
  return {{"type", "object"},
          {"propertyNames", {{"pattern", name_pattern}}},
          {"additionalProperties", to_json(form.of, place)}};
}

Json to_json(const Form& form, Place place) {
  switch (form.kind) {
  case Kind::number:
    return of_number("number", form.range);
  case Kind::whole_number:
    return of_number("integer", form.range);
  case Kind::truth: // in quotes it is one, too
    return {{"type", {"boolean", "string"}}, {"pattern", "^(true|false)$"}};
  case Kind::word:
    return {{"enum", form.words}};
  case Kind::name: {
    auto schema = of_any_word();
    schema["minLength"] = 1;
    return schema;
  }
  case Kind::text:
    return of_any_word();
  case Kind::expression: {
    Json schema{{"type", {"number", "string"}}};
    put_bounds(schema, form.range);
    return schema;
  }
  case Kind::list:
    return of_list(form);
  case Kind::map:
    return of_map(form, place);
  case Kind::named:
    return of_named(form, place);
  }
  return {};
}

Json to_json(const Forms& forms, Place place) {
  auto choices = Json::array();
  for (const auto& form : forms)
    choices.push_back(to_json(form, place));
  if (place == Place::run)
    choices.push_back({{"type", "null"}});
  return choices.size() == 1 ? choices.front() : Json{{"anyOf", choices}};
}

Json of_runs() {
  auto schema = to_json(grammar::runs().front(), Place::run);
  schema["minProperties"] = 1;
  return schema;
}

} // namespace

std::string schema() {
  const auto& deck = grammar::deck().front();
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}};
  schema.update(to_json(deck, Place::deck));
  schema["properties"]["runs"] = of_runs();
  schema["properties"]["runs"]["description"] = "changes of the deck by names of runs";
  schema["if"] = {{"not", {{"required", {"runs"}}}}};
  schema["then"] = {{"required", required_keys(deck)}};
  constexpr int indentation = 1;
  return schema.dump(indentation) + "\n";
}

} // namespace rubato::deck
