// SPDX-License-Identifier: LGPL-3.0-or-later
// What laws beyond linear elasticity have that is no plain number: hardening, back stresses, terms of series.
#include "rubato/core/transformed.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::study {
namespace {

using Point = std::array<double, 2>;

constexpr std::string_view no_softening =
    "where the yield stress falls with plastic strain, answers depend on the mesh";

/// Of the strain at which a tension test begins to yield.
constexpr double elastic_line = 1e-3;

bool are_finite(const std::vector<Point>& points) {
  return std::ranges::all_of(
      points, [](const Point& point) { return std::isfinite(point[0]) && std::isfinite(point[1]); });
}

/// Stresses > 0 that do not fall.
void check_stresses(Rules& rules, const std::vector<Point>& points, const std::string& path) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    rules.number(fmt::format("{}.{}.1", path, i), points[i][1], above(0));
    if (i > 0 && points[i][1] < points[i - 1][1])
      rules.broken({fmt::format("{}.{}.1", path, i), path},
                   fmt::format("found {} after {}, expected stresses that do not fall: {}", points[i][1],
                               points[i - 1][1], no_softening));
  }
}

void check_table(Rules& rules, const std::vector<Point>& points, const std::string& path) {
  const auto strains = transformed<double>(points, [](const Point& point) { return point[0]; });
  if (strains.front() != 0)
    rules.broken(
        {path + ".0.0"},
        fmt::format("found {}, expected 0: the first point has the yield stress without plastic strain",
                    strains.front()));
  for (std::size_t i = 1; i < strains.size(); ++i)
    if (strains[i] <= strains[i - 1])
      rules.broken(
          {fmt::format("{}.{}.0", path, i), path},
          fmt::format("found {} after {}, expected numbers that ascend", strains[i], strains[i - 1]));
}

/// The first point is where yielding begins; then the plastic part of the strain must grow.
void check_tension_table(Rules& rules, const Material& material, const std::string& path) {
  const auto& points = material.plasticity.points;
  const double young = material.young;
  const double elastic = points.front()[1] / young;
  if (std::abs(points.front()[0] - elastic) > elastic_line * elastic)
    rules.broken(
        {path + ".0.0", path},
        fmt::format("found {} with the stress {}, expected the strain of Young's modulus there, {:.6g}",
                    points.front()[0], points.front()[1], elastic));
  double before = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double plastic = points[i][0] - points[i][1] / young;
    if (plastic <= before)
      rules.broken(
          {fmt::format("{}.{}.0", path, i), path},
          fmt::format("found {} with the stress {}, whose plastic part {:.6g} is not more than that of "
                      "the point before, {:.6g}",
                      points[i][0], points[i][1], plastic, before));
    before = plastic;
  }
}

void check_points(Rules& rules, const Material& material, const std::string& path) {
  const auto& points = material.plasticity.points;
  if (points.empty())
    return rules.broken({path}, "found no point, expected at least one");
  for (std::size_t i = 0; i < points.size(); ++i)
    rules.number(fmt::format("{}.{}.0", path, i), points[i][0]);
  check_stresses(rules, points, path);
  if (!are_finite(points))
    return;
  if (material.plasticity.hardening == HardeningKind::table)
    check_table(rules, points, path);
  else if (material.young > 0)
    check_tension_table(rules, material, path);
}

/// What would let the yield stress fall.
bool softens(const Number<Plasticity>& number, double value) {
  constexpr std::array growing{"modulus", "saturation", "factor"};
  return value < 0 && std::ranges::find(growing, number.key) != growing.end();
}

void check_hardening(Rules& rules, const Material& material, const std::string& of_material) {
  const auto& row = entry_of(material.plasticity.hardening);
  const auto path = fmt::format("{}.hardening.{}", of_material, row.name);
  for (const auto& number : row.numbers) {
    const double value = *number.get(material.plasticity);
    rules.number(path + "." + std::string(number.key), value, number.range,
                 softens(number, value) ? no_softening : "");
  }
  if (is_table(row.kind))
    check_points(rules, material, path);
}

/// A deck has one back stress without a list.
void check_kinematic(Rules& rules, const std::vector<BackStress>& terms, const std::string& path) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto at = terms.size() == 1 ? path : fmt::format("{}.{}", path, i);
    rules.number(at + ".modulus", terms[i].modulus, bounds::back_stress);
    rules.number(at + ".recall", terms[i].recall, bounds::back_stress);
  }
  if (terms.size() > most_back_stresses)
    rules.broken(
        {path}, fmt::format("found {} back stresses, expected at most {}", terms.size(), most_back_stresses));
}

void check_prony(Rules& rules, const std::vector<PronyTerm>& terms, const std::string& path) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    rules.number(fmt::format("{}.{}.shear", path, i), terms[i].shear, bounds::prony_shear);
    rules.number(fmt::format("{}.{}.time", path, i), terms[i].time, bounds::relaxation_time);
  }
  if (terms.empty())
    rules.broken({path}, "found no term, expected at least one");
}

void check_ogden(Rules& rules, const std::vector<OgdenTerm>& terms, const std::string& path) {
  double sum = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    rules.number(fmt::format("{}.{}.shear", path, i), terms[i].shear);
    rules.number(fmt::format("{}.{}.exponent", path, i), terms[i].exponent);
    if (terms[i].exponent == 0)
      rules.broken({fmt::format("{}.{}.exponent", path, i)}, "found 0, whose term has no stress");
    sum += terms[i].shear;
  }
  if (terms.empty())
    rules.broken({path}, "found no term, expected at least one");
  else if (std::isfinite(sum) && sum <= 0)
    rules.broken({path},
                 fmt::format("the sum of 'shear' is {:.6g}, expected more than 0: it is the shear modulus "
                             "at small strain",
                             sum));
}

void check_hyperelasticity(Rules& rules, const Material& material, const std::string& path) {
  const auto& given = material.hyperelasticity;
  const double sum = given.c10 + given.c01;
  if (material.law == LawKind::ogden)
    check_ogden(rules, given.terms, path + ".terms");
  if (material.law == LawKind::hyperelastic && std::isfinite(sum) && sum <= 0)
    rules.broken(
        {path + ".c10", path + ".c01"},
        fmt::format("c10 + c01 is {:.6g}, expected more than 0: it is half the shear modulus at small "
                    "strain",
                    sum));
  if (given.bulk && material.poisson != 0)
    rules.broken({path + ".poisson", path + ".bulk"},
                 "found 'poisson' beside 'bulk', expected one of the two");
}

} // namespace

void check_law_words(Rules& rules, const Material& material, const std::string& path) {
  if (material.law == LawKind::plastic) {
    check_hardening(rules, material, path);
    check_kinematic(rules, material.plasticity.kinematic, path + ".kinematic");
  }
  if (material.law == LawKind::prony)
    check_prony(rules, material.prony, path + ".terms");
  if (is_hyperelastic(material.law))
    check_hyperelasticity(rules, material, path);
}

} // namespace rubato::study
