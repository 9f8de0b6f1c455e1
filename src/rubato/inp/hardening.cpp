// SPDX-License-Identifier: LGPL-3.0-or-later
// *PLASTIC, *CYCLIC HARDENING and *RATE DEPENDENT as hardening and back stresses.
#include "rubato/core/naming.hpp"
#include "rubato/inp/reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using study::HardeningKind;

struct HardeningWord {
  std::string_view word;
  HardeningRule rule;
};
constexpr std::array hardening_words{HardeningWord{"ISOTROPIC", HardeningRule::isotropic},
                                     HardeningWord{"KINEMATIC", HardeningRule::kinematic},
                                     HardeningWord{"COMBINED", HardeningRule::combined},
                                     HardeningWord{"JOHNSONCOOK", HardeningRule::johnson_cook}};

/// The stress stays beyond the last point, where tables of a study go on with their last slope.
StressCurve ending_flat(StressCurve curve) {
  curve.push_back({curve.back()[0] + 1, curve.back()[1]});
  return curve;
}

void set_table(const StressCurve& curve, study::Plasticity& plasticity) {
  if (curve.size() == 1) {
    plasticity.hardening = HardeningKind::linear;
    plasticity.yield_stress = curve.front()[1];
    return;
  }
  plasticity.hardening = HardeningKind::table;
  plasticity.points = ending_flat(curve);
}

/// C of C/γ (1 − exp(−γ p)) with the least squares of distances to the stresses, and their sum.
std::array<double, 2> fitted_modulus(const StressCurve& back, double recall) {
  double products = 0, squares = 0;
  const auto shape = [&](double strain) { return -std::expm1(-recall * strain) / recall; };
  for (const auto& [strain, stress] : back) {
    products += stress * shape(strain);
    squares += shape(strain) * shape(strain);
  }
  const double modulus = std::max(0.0, products / squares);
  double distance = 0;
  for (const auto& [strain, stress] : back)
    distance += std::pow(stress - modulus * shape(strain), 2);
  return {modulus, distance};
}

/// One back stress that follows the stresses above the yield stress: a straight line where there are two
/// points, else the fit of least squares.
study::BackStress back_stress_of(const StressCurve& back) {
  if (back.size() < 2 || back.back()[0] <= 0)
    return {};
  if (back.size() == 2)
    return {(back[1][1] - back[0][1]) / (back[1][0] - back[0][0]), 0};
  constexpr double ratio = 0.6180339887498949;
  constexpr int rounds = 80;
  double low = std::log(1e-4 / back.back()[0]), high = std::log(1e3 / back.back()[0]);
  for (int i = 0; i < rounds; ++i) {
    const double a = high - ratio * (high - low), b = low + ratio * (high - low);
    (fitted_modulus(back, std::exp(a))[1] < fitted_modulus(back, std::exp(b))[1] ? high : low) =
        fitted_modulus(back, std::exp(a))[1] < fitted_modulus(back, std::exp(b))[1] ? b : a;
  }
  const double recall = std::exp(0.5 * (low + high));
  return {fitted_modulus(back, recall)[0], recall};
}

/// Returns the size of the yield surface of a combined law at a plastic strain.
double size_at(const study::Plasticity& p, double strain) {
  if (p.hardening == HardeningKind::voce)
    return p.yield_stress - p.saturation * std::expm1(-p.rate * strain);
  if (p.hardening == HardeningKind::linear)
    return p.yield_stress;
  for (std::size_t i = 1; i < p.points.size(); ++i)
    if (strain <= p.points[i][0])
      return p.points[i - 1][1] + (p.points[i][1] - p.points[i - 1][1]) * (strain - p.points[i - 1][0]) /
                                      (p.points[i][0] - p.points[i - 1][0]);
  return p.points.back()[1];
}

void set_size(const HardeningPart& part, double temperature, double first, study::Plasticity& plasticity) {
  if (!part.cyclic_parameters.numbers.empty()) {
    const auto n = numbers_at(part.cyclic_parameters, temperature);
    plasticity.hardening = HardeningKind::voce;
    plasticity.yield_stress = n[0];
    plasticity.saturation = n[1];
    plasticity.rate = n[2];
  } else if (!part.cyclic.curves.empty()) {
    set_table(curve_at(part.cyclic, temperature), plasticity);
  } else {
    plasticity.hardening = HardeningKind::linear;
    plasticity.yield_stress = first;
  }
}

void set_combined(const HardeningPart& part, double temperature, study::Plasticity& plasticity) {
  if (!part.parameters.numbers.empty()) {
    const auto n = numbers_at(part.parameters, temperature);
    set_size(part, temperature, n[0], plasticity);
    for (std::size_t i = 1; i + 1 < n.size(); i += 2)
      plasticity.kinematic.push_back({n[i], n[i + 1]});
    return;
  }
  auto curve = curve_at(part.curves, temperature);
  set_size(part, temperature, curve.front()[1], plasticity);
  for (auto& point : curve)
    point[1] -= size_at(plasticity, point[0]);
  if (const auto back = back_stress_of(curve); back.modulus != 0)
    plasticity.kinematic = {back};
}

void set_johnson_cook(const HardeningPart& part, double temperature, study::Plasticity& plasticity) {
  const auto& n = part.parameters.numbers.front();
  const double power = n[3], melting = n[4], transition = n[5];
  const double heat =
      melting > transition ? std::clamp((temperature - transition) / (melting - transition), 0.0, 1.0) : 0.0;
  const double left = heat > 0 ? 1 - std::pow(heat, power) : 1;
  plasticity.hardening = HardeningKind::johnson_cook;
  plasticity.yield_stress = n[0] * left;
  plasticity.factor = n[1] * left;
  plasticity.exponent = n[2];
  if (part.rate) {
    plasticity.rate_factor = part.rate->at(0);
    plasticity.reference_rate = part.rate->at(1);
  }
}

/// A curve that one straight line follows.
bool is_straight(const StressCurve& curve) {
  const auto slope = [&](std::size_t i) {
    return (curve[i][1] - curve.front()[1]) / (curve[i][0] - curve.front()[0]);
  };
  for (std::size_t i = 2; i < curve.size(); ++i)
    if (std::abs(slope(i) - slope(1)) > 1e-3 * std::abs(slope(1)))
      return false;
  return true;
}

HardeningPart* hardening_above(Reading& reading, std::size_t index) {
  auto* const data = material_above(reading, index);
  const auto& at = reading.content.layout.blocks[index].block->at;
  if (data == nullptr)
    return nullptr;
  if (!data->hardening)
    reading.faults.add(at, fmt::format("found {} without *PLASTIC above it, which it belongs to", at.text));
  return data->hardening ? &*data->hardening : nullptr;
}

void read_parameters(Reading& reading, const Block& block, HardeningPart& part) {
  constexpr std::int64_t most = study::most_back_stresses;
  std::int64_t count = 1;
  if (const auto* number = block.find("NUMBERBACKSTRESSES"); number != nullptr)
    count =
        mesh::inp::require_integer(number->value, "the number of back stresses", reading.faults).value_or(1);
  if (count < 1 || count > most)
    return reading.faults.add(block.find("NUMBERBACKSTRESSES")->value,
                              fmt::format("found {} back stresses, expected 1 to {}", count, most));
  const auto numbers = static_cast<std::size_t>(2 * count + 1);
  part.parameters =
      heat_table(reading, block, numbers - 1, numbers, "a yield stress, C and gamma of each back stress");
}

void read_combined(Reading& reading, const Block& block, HardeningPart& part) {
  const auto* const type = block.find("DATATYPE");
  const auto word = type == nullptr ? std::string("HALFCYCLE") : compact(type->value.text);
  if (word == "PARAMETERS")
    return read_parameters(reading, block, part);
  if (word != "HALFCYCLE")
    return reading.faults.add(
        type->value, fmt::format("found DATA TYPE={}, expected PARAMETERS or HALF CYCLE", type->value.text));
  part.curves = heat_curves(reading, block);
  if (std::ranges::any_of(part.curves.curves, [](const StressCurve& curve) { return curve.size() > 2; }))
    note(reading, block.at,
         "the curve of the first half cycle is followed by one back stress, fitted by least squares; rubato "
         "deck shows its numbers");
}

} // namespace

void read_plastic(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const data = material_above(reading, index);
  if (data == nullptr)
    return;
  if (const auto* rate = block.find("RATE"); rate != nullptr)
    return reading.faults.add(rate->name,
                              "found yield stresses by the rate of plastic strain, which rubato "
                              "has of HARDENING=JOHNSON COOK only, expected a block without RATE");
  if (data->hardening)
    return reading.faults.add(
        block.at, fmt::format("found a second *PLASTIC of {}, expected one", shown(data->material.name)));
  const auto* const hardening = block.find("HARDENING");
  const auto word = hardening == nullptr ? std::string("ISOTROPIC") : compact(hardening->value.text);
  const auto* const found = std::ranges::find(hardening_words, std::string_view(word), &HardeningWord::word);
  if (found == hardening_words.end())
    return reading.faults.add(hardening->value,
                              fmt::format("found HARDENING={}, expected ISOTROPIC, KINEMATIC, COMBINED or "
                                          "JOHNSON COOK",
                                          hardening->value.text));
  auto& part = data->hardening.emplace();
  part.rule = found->rule;
  part.at = block.at;
  constexpr std::size_t of_johnson_cook = 6;
  if (part.rule == HardeningRule::combined)
    read_combined(reading, block, part);
  else if (part.rule == HardeningRule::johnson_cook)
    part.parameters = heat_table(reading, block, 3, of_johnson_cook,
                                 "A, B, n, m, the melting and the transition temperature");
  else
    part.curves = heat_curves(reading, block);
}

void read_cyclic_hardening(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const part = hardening_above(reading, index);
  if (part == nullptr)
    return;
  if (part->rule != HardeningRule::combined)
    return reading.faults.add(block.at, fmt::format("found {} beside *PLASTIC without HARDENING=COMBINED, "
                                                    "expected it there",
                                                    block.at.text));
  if (block.find("PARAMETERS") != nullptr)
    part->cyclic_parameters = heat_table(reading, block, 3, 3, "a yield stress, Q and b");
  else
    part->cyclic = heat_curves(reading, block);
}

void read_rate_dependent(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const part = hardening_above(reading, index);
  if (part == nullptr)
    return;
  const auto* const type = block.find("TYPE");
  if (type == nullptr || compact(type->value.text) != "JOHNSONCOOK" ||
      part->rule != HardeningRule::johnson_cook)
    return reading.faults.add(
        type == nullptr ? block.at : type->value,
        "found a yield stress that depends on the rate of plastic strain in another way "
        "than Johnson and Cook's, expected TYPE=JOHNSON COOK beside *PLASTIC, "
        "HARDENING=JOHNSON COOK");
  const auto table = heat_table(reading, block, 2, 2, "C and the reference rate");
  if (!table.numbers.empty())
    part->rate = {table.numbers.front()[0], table.numbers.front()[1]};
}

void check_hardening(Reading& reading, const HardeningPart& part) {
  if (part.rule != HardeningRule::kinematic)
    return;
  if (!std::ranges::all_of(part.curves.curves, is_straight))
    reading.faults.add(part.at, "found kinematic hardening along several slopes, expected one straight line, "
                                "or HARDENING=COMBINED");
}

void set_hardening(const HardeningPart& part, double temperature, study::Material& material) {
  material.law = study::LawKind::plastic;
  auto& plasticity = material.plasticity;
  switch (part.rule) {
  case HardeningRule::isotropic:
    return set_table(curve_at(part.curves, temperature), plasticity);
  case HardeningRule::kinematic: {
    const auto curve = curve_at(part.curves, temperature);
    plasticity.yield_stress = curve.front()[1];
    if (curve.size() > 1)
      plasticity.kinematic = {
          {(curve.back()[1] - curve.front()[1]) / (curve.back()[0] - curve.front()[0]), 0}};
    return;
  }
  case HardeningRule::combined:
    return set_combined(part, temperature, plasticity);
  case HardeningRule::johnson_cook:
    return set_johnson_cook(part, temperature, plasticity);
  }
}

} // namespace rubato::inp
