// SPDX-License-Identifier: LGPL-3.0-or-later
// Records, words and the rules of a study, for the classes that the package makes of them (_records.py).
#include "rubato/study/echo.hpp"
#include "rubato/study/validate.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "record.hpp"
#include <algorithm>
#include <functional>
#include <map>

namespace rubato::python {
namespace {

struct Records {
  std::vector<RecordEntry> entries;
  std::map<std::string_view, std::map<std::string_view, const MemberEntry*>> members;
};

Records make_records() {
  Records records;
  for (const auto& make :
       {value_records, mesh_records, solid_records, contact_records, result_records, run_records})
    std::ranges::move(make(), std::back_inserter(records.entries));
  for (const auto& entry : records.entries)
    for (const auto& member : entry.members)
      records.members[entry.name][member.name] = &member;
  return records;
}

/// The table is made once and never changed.
const Records& all_records() {
  static const Records records = make_records();
  return records;
}

py::str text(std::string_view view) {
  return {view.data(), view.size()};
}

/// (name, meaning, ((member, type, meaning), …)) of each record.
py::tuple described_records() {
  py::list result;
  for (const auto& entry : all_records().entries) {
    py::list members;
    for (const auto& member : entry.members)
      members.append(py::make_tuple(text(member.name), member.type, text(member.meaning)));
    result.append(py::make_tuple(text(entry.name), text(entry.meaning), py::tuple(members)));
  }
  return result;
}

/// (name, meaning, words) of each enumeration.
py::tuple described_words() {
  py::list result;
  for (const auto* list : all_words()) {
    py::list words;
    for (const auto& word : list->words)
      words.append(word);
    result.append(py::make_tuple(text(list->class_name), text(list->meaning), py::tuple(words)));
  }
  return result;
}

py::tuple defaults_of(const std::string& record) {
  const auto& entries = all_records().entries;
  return std::ranges::find(entries, record, &RecordEntry::name)->defaults();
}

py::object tidied(const std::string& record, const std::string& member, const py::object& value) {
  return all_records().members.at(record).at(member)->tidy(value, fmt::format("{}.{}", record, member));
}

study::Study study_of(const py::object& record) {
  return Codec<study::Study>::from(record, "");
}

} // namespace

void bind_study(py::module_& module) {
  module.def("_records", &described_records);
  module.def("_words", &described_words);
  module.def("_defaults", &defaults_of);
  module.def("_tidied", &tidied);
  module.def("_validate", [](const py::object& record) { study::validate(study_of(record)); });
  module.def("_to_json", [](const py::object& record) { return study::to_json(study_of(record)); });
}

} // namespace rubato::python
