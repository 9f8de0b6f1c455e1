// SPDX-License-Identifier: LGPL-3.0-or-later
// Hardening as tables of stress and plastic strain, which CalculiX keeps constant beyond their end.
#include "rubato/ccx/draft.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rubato::ccx {
namespace {

using study::HardeningKind;
using study::Material;
using study::Plasticity;

/// Plastic strain up to which straight lines go on.
constexpr double far = 10;
constexpr int samples = 100;
/// Plastic strain of the first sample of curves.
constexpr double first_sample = 1e-5;

struct Point {
  double strain = 0;
  double stress = 0;
};

/// A line that goes on beyond the last point, as it does in rubato.
void go_on(std::vector<Point>& points) {
  if (points.size() < 2)
    return;
  const auto last = points.back(), before = points[points.size() - 2];
  const double slope = (last.stress - before.stress) / (last.strain - before.strain);
  if (slope != 0 && last.strain < far)
    points.push_back({far, last.stress + slope * (far - last.strain)});
}

double stress_of(const Plasticity& given, double p) {
  if (given.hardening == HardeningKind::johnson_cook)
    return given.yield_stress + given.factor * std::pow(p, given.exponent);
  return given.yield_stress + given.saturation * (1 - std::exp(-given.rate * p)) + given.modulus * p;
}

/// Points that are denser at the begin: each is a constant factor further than the one before.
std::vector<Point> sampled(const Plasticity& given) {
  std::vector<Point> points{{0, given.yield_stress}};
  const double factor = std::pow(far / first_sample, 1.0 / samples);
  double p = first_sample;
  for (int i = 0; i <= samples; ++i, p *= factor)
    points.push_back({p, stress_of(given, p)});
  return points;
}

std::vector<Point> points_of(const Material& material) {
  const auto& given = material.plasticity;
  std::vector<Point> points;
  switch (given.hardening) {
  case HardeningKind::linear:
    points = {{0, given.yield_stress}};
    if (given.modulus > 0)
      points.push_back({far, given.yield_stress + far * given.modulus});
    return points;
  case HardeningKind::table:
    for (const auto& [strain, stress] : given.points)
      points.push_back({strain, stress});
    break;
  case HardeningKind::tension_table:
    for (const auto& [strain, stress] : given.points)
      points.push_back({points.empty() ? 0 : strain - stress / material.young, stress});
    break;
  case HardeningKind::voce:
  case HardeningKind::johnson_cook:
    return sampled(given);
  }
  go_on(points);
  return points;
}

} // namespace

std::string hardening_lines(Run& run, const Material& material) {
  const auto path = "materials." + material.name;
  const auto& given = material.plasticity;
  if (!given.kinematic.empty())
    run.refuse(path + ".kinematic", "found kinematic hardening; CalculiX 2.20 has falling stresses in "
                                    "monotonic tension with it, expected "
                                    "isotropic hardening");
  if (given.hardening == HardeningKind::johnson_cook && given.rate_factor != 0)
    run.refuse(
        path + ".hardening.rate_factor",
        fmt::format("found a yield stress that grows with the rate of strain, {}; the table of CalculiX has "
                    "none, expected 0",
                    given.rate_factor));
  if (given.hardening == HardeningKind::voce || given.hardening == HardeningKind::johnson_cook)
    add_note(run.draft, fmt::format("material {}: the curve of its yield stress is a table of {} points",
                                    material.name, samples + 2));
  std::string text = "*PLASTIC\n";
  for (const auto& point : points_of(material))
    text += fmt::format("{}, {}\n", shown_number(point.stress), shown_number(point.strain));
  return text;
}

} // namespace rubato::ccx
