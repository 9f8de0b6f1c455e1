// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/study_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace rubato::report {
namespace {

using Json = nlohmann::ordered_json;
using Sentences = std::vector<std::string>;

const Json& part(const Json& map, const char* key) {
  static const Json none;
  return map.is_object() && map.contains(key) ? map.at(key) : none;
}

std::string value_text(const Json& value);

/// All digits, and an exponent where there would be many zeros.
std::string number_text(double value) {
  constexpr double large = 1e5;
  constexpr double small = 1e-4;
  auto plain = fmt::format("{}", value);
  if (value == 0 || (std::abs(value) < large && std::abs(value) >= small) ||
      plain.find('e') != std::string::npos)
    return plain;
  for (int digits = 0; digits <= std::numeric_limits<double>::max_digits10; ++digits)
    if (auto text = fmt::format("{:.{}e}", value, digits); std::stod(text) == value)
      return text;
  return plain;
}

std::string list_text(const Json& list) {
  Sentences words;
  for (const auto& entry : list)
    words.push_back(value_text(entry));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// A value times a function of time is one value to a reader: "0.05 × press".
std::string varying_text(const Json& value) {
  auto text = value_text(part(value, "value"));
  if (const auto& function = part(value, "function"); function.is_string())
    text += fmt::format(" × {}(t)", function.get<std::string>());
  return text;
}

std::string value_text(const Json& value) {
  if (value.is_number_integer())
    return fmt::format("{}", value.get<long long>());
  if (value.is_number())
    return number_text(value.get<double>());
  if (value.is_string())
    return value.get<std::string>();
  if (value.is_boolean())
    return value.get<bool>() ? "yes" : "no";
  if (value.is_array())
    return fmt::format("({})", list_text(value));
  if (value.is_object() && value.contains("value"))
    return varying_text(value);
  Sentences words;
  for (const auto& [key, entry] : value.items())
    words.push_back(fmt::format("{} {}", key, value_text(entry)));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// What counts as not said: nothing, zero, an empty map.
bool is_none(const Json& value) {
  if (value.is_object() && value.contains("value"))
    return is_none(value.at("value"));
  return value.is_null() || ((value.is_object() || value.is_array()) && value.empty()) ||
         (value.is_string() && value.get<std::string>().empty()) ||
         (value.is_boolean() && !value.get<bool>()) || (value.is_number() && value.get<double>() == 0.0);
}

/// "key value" of every entry that says something, but those named.
std::string entries_text(const Json& map, std::initializer_list<std::string_view> but) {
  Sentences words;
  for (const auto& [key, value] : map.items())
    if (std::ranges::find(but, std::string_view(key)) == but.end() && !is_none(value))
      words.push_back(fmt::format("{} {}", key, value_text(value)));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string text_of(const Json& map, const char* key) {
  const auto& value = part(map, key);
  return value.is_null() ? "" : value_text(value);
}

std::string spaced(std::string word) {
  std::ranges::replace(word, '_', ' ');
  return word;
}

Sentences words_on_physics(const Json& study) {
  auto text = spaced(text_of(study, "physics"));
  if (!part(study, "thickness").is_null())
    text += fmt::format(", thickness {}", text_of(study, "thickness"));
  const auto units = text_of(study, "units");
  return {text, units.empty() ? "The deck names no units." : fmt::format("Units: {}", units)};
}

Sentences words_on_mesh(const Json& study) {
  const auto& source = part(study, "mesh");
  Sentences sentences;
  if (!part(source, "file").is_null())
    sentences.push_back(fmt::format("From the file {}.", text_of(source, "file")));
  for (const auto& body : part(source, "generate")) {
    const bool is_box = body.contains("box");
    const auto& shape = part(body, is_box ? "box" : "rectangle");
    sentences.push_back(fmt::format(
        "Generated: {}, a {} from {} to {}, {} cells of {}.", text_of(body, "name"),
        is_box ? "box" : "rectangle", text_of(shape, "from"), text_of(shape, "to"),
        fmt::join(part(body, "divisions").get<std::vector<int>>(), " × "), text_of(body, "cells")));
  }
  if (const auto convert = text_of(source, "convert"); !convert.empty() && convert != "none")
    sentences.push_back(fmt::format("Converted to {} cells.", spaced(convert)));
  if (const auto& refine = part(source, "refine"); refine.is_number() && refine.get<int>() > 1)
    sentences.push_back(fmt::format("Every edge is cut into {} parts.", value_text(refine)));
  return sentences;
}

Sentences words_on_materials(const Json& study) {
  Sentences sentences;
  for (const auto& [name, material] : part(study, "materials").items())
    sentences.push_back(fmt::format(
        "{}: {}; {}; on {}", name, spaced(text_of(material, "law")),
        entries_text(material, {"law", "cells", "rayleigh", "damping"}),
        material.contains("cells") && material.at("cells") != "all"
            ? list_text(material.at("cells").is_array() ? material.at("cells") : Json{material.at("cells")})
            : "all cells"));
  for (const auto& [name, material] : part(study, "materials").items())
    if (const auto damping = entries_text(part(material, "rayleigh"), {}); !damping.empty())
      sentences.push_back(fmt::format("Rayleigh damping of {}: {}", name, damping));
  for (const auto& [name, material] : part(study, "materials").items())
    if (const auto& damping = part(material, "damping"); damping.contains("ratio"))
      sentences.push_back(fmt::format("Rayleigh damping of {}: ratios {} at the frequencies {}", name,
                                      text_of(damping, "ratio"), text_of(damping, "at")));
  return sentences;
}

/// Each of a list of parts that stand on a group.
Sentences on_groups(const Json& list) {
  Sentences sentences;
  for (const auto& entry : list) {
    Sentences parts;
    for (const auto& [key, value] : entry.items())
      if (key != "on")
        parts.push_back(fmt::format("{} = {}", key, value_text(value)));
    sentences.push_back(fmt::format("{}: {}", text_of(entry, "on"), fmt::join(parts, ", ")));
  }
  return sentences;
}

/// "x = acceleration -1, function quake; counted from the base".
Sentences words_on_base(const Json& study) {
  const auto& base = part(study, "base_motion");
  if (base.is_null())
    return {};
  Sentences parts;
  for (const auto& [key, value] : base.items())
    if (key != "frame")
      parts.push_back(fmt::format("{} = {}", key, value_text(value)));
  return {fmt::format("{}; displacements are {}", fmt::join(parts, ", "),
                      text_of(base, "frame") == "relative" ? "those relative to the base" : "absolute")};
}

Sentences words_on_loads(const Json& study) {
  Sentences sentences;
  for (const auto& load : part(study, "loads"))
    for (const auto& [kind, values] : load.items()) {
      auto text = spaced(kind);
      if (const auto on = text_of(values, "on"); !on.empty())
        text += " on " + on;
      Sentences parts;
      for (const auto& [key, value] : values.items())
        if (key != "on" && key != "function" && !is_none(value))
          parts.push_back(key == "value" ? value_text(value)
                                         : fmt::format("{} = {}", key, value_text(value)));
      text += fmt::format(": {}", fmt::join(parts, ", "));
      if (const auto function = text_of(values, "function"); !function.empty())
        text += fmt::format(" × {}(t)", function);
      sentences.push_back(text);
    }
  return sentences;
}

Sentences words_on_preloads(const Json& study) {
  Sentences sentences;
  for (const auto& [name, preload] : part(study, "preload").items())
    sentences.push_back(fmt::format("{}: {}", name, entries_text(preload, {})));
  return sentences;
}

/// "hub, rigid: on bore, at (0, 0)".
Sentences words_on_relations(const Json& study) {
  Sentences sentences;
  for (const auto& [name, relation] : part(study, "relations").items())
    for (const auto& [kind, values] : relation.items())
      sentences.push_back(fmt::format("{}, {}: {}", name, kind, entries_text(values, {})));
  return sentences;
}

std::string surfaces_of(const Json& zone) {
  if (zone.contains("between"))
    return fmt::format("between {}", list_text(zone.at("between")));
  if (zone.contains("self"))
    return fmt::format("of {} with itself", text_of(zone, "self"));
  if (zone.contains("all"))
    return "between all surfaces of different bodies";
  if (zone.contains("obstacle"))
    return fmt::format("{} on the obstacle {}", text_of(zone, "slave"), value_text(zone.at("obstacle")));
  return fmt::format("slave {}, master {}", text_of(zone, "slave"), text_of(zone, "master"));
}

Sentences words_on_contact(const Json& zone) {
  Sentences sentences{fmt::format("{}.", surfaces_of(zone))};
  if (!is_none(part(zone, "tie")))
    sentences.emplace_back("The surfaces are tied.");
  else {
    sentences.push_back(fmt::format("Method: {}.", spaced(text_of(zone, "method"))));
    sentences.push_back(is_none(part(zone, "friction"))
                            ? "No friction."
                            : fmt::format("Coulomb friction, coefficient {}, by {}.",
                                          text_of(zone, "friction"),
                                          spaced(text_of(zone, "friction_method"))));
  }
  sentences.push_back(fmt::format("Contact points: {}.", text_of(zone, "integration")));
  for (const auto* key : {"coefficients", "interference", "gap", "bilateral", "freeze", "restitution"})
    if (!is_none(part(zone, key)))
      sentences.push_back(fmt::format("{}: {}.", key, value_text(zone.at(key))));
  return sentences;
}

Sentences words_on_time(const Json& study) {
  const auto& time = part(study, "time");
  Sentences sentences;
  auto scheme = spaced(text_of(time, "scheme"));
  const auto numbers = entries_text(
      time, {"scheme", "contact_mass", "begin", "step", "end", "instants", "start", "on_failure"});
  sentences.push_back(fmt::format("Scheme: {}{}{}.", scheme, numbers.empty() ? "" : "; ", numbers));
  if (time.contains("instants"))
    sentences.push_back(fmt::format("{} instants given by the deck, from t = {}.", time.at("instants").size(),
                                    text_of(time, "begin")));
  else
    sentences.push_back(fmt::format("From t = {} to {}, step {}.", text_of(time, "begin"),
                                    text_of(time, "end"), text_of(time, "step")));
  if (part(time, "contact_mass") == "redistributed")
    sentences.emplace_back("Contact surfaces without mass.");
  if (part(time, "start").is_object())
    sentences.push_back(fmt::format("Starts from the end of the run {}.", text_of(time.at("start"), "from")));
  return sentences;
}

Sentences words_on_solution(const Json& study) {
  const auto& newton = part(study, "newton");
  return {fmt::format("At most {} iterations of Newton's method, residual below {}.",
                      text_of(newton, "max_iterations"), text_of(newton, "residual")),
          fmt::format("Solver: {}.", text_of(study, "solver"))};
}

} // namespace

std::vector<Topic> study_in_words(const Json& study) {
  std::vector<Topic> topics{{"Physics", words_on_physics(study)},
                            {"Mesh", words_on_mesh(study)},
                            {"Materials", words_on_materials(study)},
                            {"Supports", on_groups(part(study, "supports"))},
                            {"Base motion", words_on_base(study)},
                            {"Preload", words_on_preloads(study)},
                            {"Relations", words_on_relations(study)},
                            {"Springs", on_groups(part(study, "springs"))},
                            {"Connectors", on_groups(part(study, "connectors"))},
                            {"Masses", on_groups(part(study, "masses"))},
                            {"Loads", words_on_loads(study)},
                            {"Motion at the start", on_groups(part(study, "initial"))}};
  for (const auto& [name, zone] : part(study, "contact").items())
    topics.push_back({"Contact " + name, words_on_contact(zone)});
  topics.push_back({"Time", words_on_time(study)});
  topics.push_back({"Solution", words_on_solution(study)});
  std::erase_if(topics, [](const Topic& topic) { return topic.sentences.empty(); });
  return topics;
}

} // namespace rubato::report
