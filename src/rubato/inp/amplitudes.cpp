// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/inp/reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::inp {
namespace {

/// All numbers of the data lines; nothing after a fault.
std::optional<std::vector<double>> amplitude_numbers(const Block& block, Faults& faults) {
  std::vector<double> numbers;
  bool sound = true;
  for (const auto& line : block.lines)
    for (const auto& word : mesh::inp::fields_of(line)) {
      const auto number = mesh::inp::require_number(word, "a value of the amplitude", faults);
      sound = sound && number.has_value();
      numbers.push_back(number.value_or(0));
    }
  if (sound && numbers.empty())
    faults.add(block.at, fmt::format("found {} without data, expected some", block.at.text));
  return sound && !numbers.empty() ? std::optional(numbers) : std::nullopt;
}

bool require_count(const Block& block, const std::vector<double>& numbers, std::size_t count,
                   Faults& faults) {
  if (numbers.size() == count)
    return true;
  faults.add(block.at, fmt::format("found {} numbers of the amplitude, expected {}", numbers.size(), count));
  return false;
}

double parameter_number(const Block& block, std::string_view key, double absent, Faults& faults) {
  const auto* const given = block.find(key);
  return given == nullptr
             ? absent
             : mesh::inp::require_number(given->value, "the value of the parameter", faults).value_or(absent);
}

/// Fills the table of pairs, or the ends of one.
bool add_pairs(const Block& block, const std::vector<double>& numbers, Curve& curve, Faults& faults) {
  if (numbers.size() % 2 != 0) {
    faults.add(block.at, fmt::format("found {} numbers, expected pairs of time and value", numbers.size()));
    return false;
  }
  const double shift_t = parameter_number(block, "SHIFTX", 0, faults);
  const double shift_value = parameter_number(block, "SHIFTY", 0, faults);
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    if (!curve.table.at.empty() && numbers[i] + shift_t <= curve.table.at.back()) {
      faults.add(block.at, fmt::format("found the time {} after {}, expected times that ascend", numbers[i],
                                       curve.table.at.back() - shift_t));
      return false;
    }
    curve.table.at.push_back(numbers[i] + shift_t);
    curve.table.values.push_back(numbers[i + 1] + shift_value);
  }
  return true;
}

void read_tabular(const Block& block, const std::vector<double>& numbers, Curve& curve, Faults& faults) {
  add_pairs(block, numbers, curve, faults);
}

void read_equally_spaced(const Block& block, const std::vector<double>& numbers, Curve& curve,
                         Faults& faults) {
  const double interval = parameter_number(block, "FIXEDINTERVAL", 0, faults);
  const double begin = parameter_number(block, "BEGIN", 0, faults);
  if (!(interval > 0))
    return faults.add(block.at, "found an equally spaced amplitude, expected FIXED INTERVAL= above 0");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    curve.table.at.push_back(begin + static_cast<double>(i) * interval);
    curve.table.values.push_back(numbers[i]);
  }
}

/// Between two values a + (b − a) ξ³ (10 − 15 ξ + 6 ξ²).
void read_smooth_step(const Block& block, const std::vector<double>& numbers, Curve& curve, Faults& faults) {
  if (!add_pairs(block, numbers, curve, faults))
    return;
  const auto& at = curve.table.at;
  const auto& values = curve.table.values;
  auto& text = curve.formula;
  text = fmt::format("{}", values.front());
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const auto part = fmt::format("min(max((T-({}))/({}),0),1)", at[i], at[i + 1] - at[i]);
    if (values[i + 1] != values[i])
      text += fmt::format("+({})*{}^3*(10-15*{}+6*{}^2)", values[i + 1] - values[i], part, part, part);
  }
  constexpr std::size_t longest = 2000;
  if (text.size() > longest)
    faults.add(block.at, "found a smooth step of too many points, expected fewer");
}

/// a0 + Σ A_n cos nω(t − t0) + B_n sin nω(t − t0) from t0 on, a0 before.
void read_periodic(const Block& block, const std::vector<double>& numbers, Curve& curve, Faults& faults) {
  constexpr std::size_t head = 4;
  const bool whole = numbers.size() > head && numbers.size() % 2 == 0;
  if (!whole || 2 * numbers[0] != static_cast<double>(numbers.size() - head))
    return faults.add(block.at,
                      fmt::format("found {} numbers of a periodic amplitude, expected N, the frequency, t0, "
                                  "A0 and N pairs",
                                  numbers.size()));
  std::string sum;
  for (std::size_t i = head; i + 1 < numbers.size(); i += 2) {
    const auto harmonic = 1 + (i - head) / 2;
    const auto angle = fmt::format("{}*(T-({}))", static_cast<double>(harmonic) * numbers[1], numbers[2]);
    sum += fmt::format("+({})*cos({})+({})*sin({})", numbers[i], angle, numbers[i + 1], angle);
  }
  curve.formula = fmt::format("({})+if(T<({}),0,0{})", numbers[3], numbers[2], sum);
}

/// a0 + A exp(−(t − t0)/d) from t0 on, a0 before.
void read_decay(const Block& block, const std::vector<double>& numbers, Curve& curve, Faults& faults) {
  if (!require_count(block, numbers, 4, faults))
    return;
  if (numbers[3] == 0)
    return faults.add(block.at, "found the decay time 0, expected another one");
  curve.formula = fmt::format("({})+if(T<({}),0,({})*exp(-(T-({}))/({})))", numbers[0], numbers[2],
                              numbers[1], numbers[2], numbers[3]);
}

/// a0 + A sin ω1(t − t0) sin ω2(t − t0) from t0 on, a0 before.
void read_modulated(const Block& block, const std::vector<double>& numbers, Curve& curve, Faults& faults) {
  if (require_count(block, numbers, 5, faults))
    curve.formula = fmt::format("({})+if(T<({}),0,({})*sin({}*(T-({})))*sin({}*(T-({}))))", numbers[0],
                                numbers[2], numbers[1], numbers[3], numbers[2], numbers[4], numbers[2]);
}

struct Definition {
  std::string_view word;
  void (*read)(const Block&, const std::vector<double>&, Curve&, Faults&);
};
constexpr std::array definitions{Definition{"TABULAR", read_tabular},
                                 Definition{"EQUALLYSPACED", read_equally_spaced},
                                 Definition{"SMOOTHSTEP", read_smooth_step},
                                 Definition{"PERIODIC", read_periodic},
                                 Definition{"DECAY", read_decay},
                                 Definition{"MODULATED", read_modulated}};

/// Words of parameters that must be what rubato does.
void check_words(const Block& block, Faults& faults) {
  if (const auto* value = block.find("VALUE");
      value != nullptr && mesh::inp::compact(value->value.text) != "RELATIVE")
    faults.add(value->name, fmt::format("found VALUE={}, expected RELATIVE: values multiply the magnitude",
                                        value->value.text));
  if (const auto* smooth = block.find("SMOOTH");
      smooth != nullptr && mesh::inp::number_in(smooth->value.text).value_or(1) != 0)
    faults.add(smooth->name,
               fmt::format("found SMOOTH={}, which rubato does not do, expected 0", smooth->value.text));
}

} // namespace

void read_amplitude(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto& faults = reading.faults;
  const auto name = mesh::inp::require_value(block, "NAME", "the name of the amplitude", faults);
  check_words(block, faults);
  Curve curve{std::string(name.text), {}, {}, false};
  if (const auto* time = block.find("TIME"); time != nullptr) {
    const auto word = mesh::inp::compact(time->value.text);
    curve.total_time = word == "TOTALTIME";
    if (!curve.total_time && word != "STEPTIME")
      faults.add(time->value,
                 fmt::format("found TIME={}, expected STEP TIME or TOTAL TIME", time->value.text));
  }
  const auto* const kind = block.find("DEFINITION");
  const auto word = kind == nullptr ? std::string("TABULAR") : mesh::inp::compact(kind->value.text);
  const auto* const found = std::ranges::find(definitions, std::string_view(word), &Definition::word);
  if (found == definitions.end()) {
    const auto words = transformed<std::string>(definitions, &Definition::word);
    return faults.add(kind->value, fmt::format("found DEFINITION={}, expected one of {}", kind->value.text,
                                               fmt::join(words, ", ")));
  }
  const auto numbers = amplitude_numbers(block, faults);
  if (numbers)
    found->read(block, *numbers, curve, faults);
  if (!name.empty() && !reading.curves.try_emplace(mesh::inp::folded(name.text), std::move(curve)).second)
    faults.add(name, fmt::format("found a second amplitude {}, expected each name once",
                                 shown(std::string(name.text))));
}

} // namespace rubato::inp
