// SPDX-License-Identifier: LGPL-3.0-or-later
// Requests of fields as files.
#include "rubato/core/naming.hpp"
#include "rubato/inp/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubato::inp {
namespace {

using mesh::inp::compact;

/// A word and the field that files have for it; empty: every file has it already.
struct FieldWord {
  std::string_view word;
  std::string_view field;
};
constexpr std::array field_words{FieldWord{"U", ""},
                                 FieldWord{"UT", ""},
                                 FieldWord{"V", ""},
                                 FieldWord{"VT", ""},
                                 FieldWord{"A", ""},
                                 FieldWord{"AT", ""},
                                 FieldWord{"RF", "reaction"},
                                 FieldWord{"RT", "reaction"},
                                 FieldWord{"NT", ""},
                                 FieldWord{"S", ""},
                                 FieldWord{"MISES", ""},
                                 FieldWord{"E", "strain"},
                                 FieldWord{"ME", "strain"},
                                 FieldWord{"PE", "plastic_strain"},
                                 FieldWord{"PEEQ", "cumulated_plastic_strain"},
                                 FieldWord{"CDIS", ""},
                                 FieldWord{"CDISP", ""},
                                 FieldWord{"CSTR", ""},
                                 FieldWord{"CSTRESS", ""},
                                 FieldWord{"CPRESS", ""},
                                 FieldWord{"COPEN", ""},
                                 FieldWord{"CSTATUS", ""}};

const FieldWord* field_word(std::string word) {
  auto found = std::ranges::find(field_words, word, &FieldWord::word);
  while (found == field_words.end() && word.size() > 1 && word.back() >= '1' && word.back() <= '6') {
    word.pop_back();
    found = std::ranges::find(field_words, word, &FieldWord::word);
  }
  return found == field_words.end() ? nullptr : found;
}

std::optional<double> number_at(Reading& reading, const Block& block, std::string_view key) {
  const auto* const given = block.find(key);
  return given == nullptr
             ? std::nullopt
             : mesh::inp::require_number(given->value, "the value of the parameter", reading.faults);
}

/// The numbers of a line of *TIME POINTS; with GENERATE first, last and interval.
void add_time_points(Reading& reading, const Block& points, const mesh::inp::Line& line,
                     std::vector<double>& instants) {
  std::vector<double> numbers;
  for (const auto& word : mesh::inp::fields_of(line))
    if (!word.empty())
      if (const auto number = mesh::inp::require_number(word, "an instant", reading.faults))
        numbers.push_back(*number);
  if (points.find("GENERATE") == nullptr) {
    instants.insert(instants.end(), numbers.begin(), numbers.end());
    return;
  }
  constexpr double most = 100'000;
  if (numbers.size() < 3 || numbers[2] <= 0 || (numbers[1] - numbers[0]) / numbers[2] > most)
    return reading.faults.add(points.at, "found a line of *TIME POINTS, GENERATE that gives no instants, "
                                         "expected first and last instant and the interval > 0");
  for (int i = 0; numbers[0] + i * numbers[2] < numbers[1] + numbers[2] * 1e-6; ++i)
    instants.push_back(numbers[0] + i * numbers[2]);
}

} // namespace

std::vector<double> time_points(Reading& reading, const Block& block, const Step& step) {
  const auto* const named = block.find("TIMEPOINTS");
  if (named == nullptr)
    return {};
  const auto& blocks = reading.content.layout.blocks;
  const auto found = std::ranges::find_if(blocks, [&](const Placed& placed) {
    const auto* const name = placed.block->is("TIME POINTS") ? placed.block->find("NAME") : nullptr;
    return name != nullptr && mesh::inp::folded(name->value.text) == mesh::inp::folded(named->value.text);
  });
  if (found == blocks.end()) {
    reading.faults.add(named->value, fmt::format("found {}, expected the name of *TIME POINTS of the file",
                                                 shown(std::string(named->value.text))));
    return {};
  }
  const auto& points = *found->block;
  const auto* const time = points.find("TIME");
  const bool total = time != nullptr && compact(time->value.text) == "TOTALTIME";
  std::vector<double> instants;
  for (const auto& line : points.lines)
    add_time_points(reading, points, line, instants);
  for (auto& t : instants)
    t += total ? 0 : step.time.begin;
  std::erase_if(instants, [&](double t) {
    return t <= step.time.begin || t >= step.time.end - 1e-9 * (step.time.end - step.time.begin);
  });
  std::ranges::sort(instants);
  instants.erase(std::ranges::unique(instants).begin(), instants.end());
  return instants;
}

void read_instants(Reading& reading, const Block& block, const Step& step, study::FieldOutput& fields) {
  fields.at = time_points(reading, block, step);
  fields.every = 0;
  if (block.find("TIMEPOINTS") != nullptr)
    return;
  const double begin = step.time.begin;
  const double length = step.time.end - begin;
  double interval = number_at(reading, block, "TIMEINTERVAL").value_or(0);
  if (const auto count = number_at(reading, block, "NUMBERINTERVAL"); count && *count >= 1)
    interval = length / *count;
  constexpr double most_instants = 10'000;
  if (interval > 0 && length / interval <= most_instants) {
    fields.at.clear();
    for (int i = 1; begin + i * interval < begin + length * (1 - 1e-9); ++i)
      fields.at.push_back(begin + i * interval);
  } else {
    const double every = std::clamp(number_at(reading, block, "FREQUENCY").value_or(1), 0.0, 1e9);
    fields.every = static_cast<int>(every);
  }
}

void add_field_words(Reading& reading, const Block& block, Step& step) {
  auto& also = step.requests.fields.also;
  for (const auto& line : block.lines)
    for (const auto& word : mesh::inp::fields_of(line)) {
      if (word.empty())
        continue;
      const auto* const row = field_word(compact(word.text));
      if (row == nullptr)
        leave_out(reading, word, fmt::format("{} in {}", shown(std::string(word.text)), block.at.text));
      else if (!row->field.empty() && std::ranges::find(also, row->field) == also.end())
        also.emplace_back(row->field);
    }
}

void read_field_request(Reading& reading, const Placed& placed, Step& step) {
  const auto& block = *placed.block;
  if (block.is("OUTPUT")) {
    step.of_fields = block.find("FIELD") != nullptr;
    step.output_every =
        static_cast<int>(std::clamp(number_at(reading, block, "FREQUENCY").value_or(1), 0.0, 1e9));
    if (!*step.of_fields)
      return;
  } else {
    add_field_words(reading, block, step);
  }
  step.requests.of_fields = &block;
  if (number_at(reading, block, "FREQUENCY") == 0.0)
    return;
  step.requests.fields.vtu = true;
  step.requests.fields.frd = true;
  read_instants(reading, block, step, step.requests.fields);
}

} // namespace rubato::inp
