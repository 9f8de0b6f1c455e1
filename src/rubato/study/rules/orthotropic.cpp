// SPDX-License-Identifier: LGPL-3.0-or-later
// Which numbers an orthotropic material needs, and that they make its energy positive.
#include "rubato/study/material_laws.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace rubato::study {
namespace {

bool is_in_place(const Material& material, std::string_view key) {
  return material.in_place.contains(std::string(key));
}

void tell_missing(const Material& material, Physics physics, std::vector<LawFault>& faults) {
  const auto& numbers = material.orthotropy;
  const auto need = [&](const std::optional<double>& number, std::string_view key) {
    if (!number && !is_in_place(material, key))
      faults.push_back({{key},
                        true,
                        fmt::format("'{}' is missing: the law orthotropic needs it in {}", key,
                                    word_of(physics_words, physics))});
  };
  if (physics != Physics::plane_stress) {
    need(numbers.young_z, "young_z");
    need(numbers.poisson_yz, "poisson_yz");
    need(numbers.poisson_xz, "poisson_xz");
  }
  if (physics == Physics::solid) {
    need(numbers.shear_yz, "shear_yz");
    need(numbers.shear_xz, "shear_xz");
  }
}

void tell_turns_out_of_plane(const Material& material, Physics physics, std::vector<LawFault>& faults) {
  if (physics == Physics::solid)
    return;
  const auto refuse = [&](double angle, std::string_view key) {
    const bool in_place = is_in_place(material, key);
    if (angle != 0 || in_place)
      faults.push_back(
          {{key},
           false,
           fmt::format("found {}, but axes turn in the plane only in {}, expected angle_z",
                       in_place ? "a turn" : fmt::format("{}", angle), word_of(physics_words, physics))});
  };
  refuse(material.orthotropy.angle_y, "angle_y");
  refuse(material.orthotropy.angle_x, "angle_x");
}

/// Numbers that depend on the place are judged where they are evaluated.
bool can_be_judged(const Material& material) {
  return std::ranges::all_of(orthotropic_numbers, [&](const Number<Material>& number) {
    const auto value = number.get(material);
    return !is_in_place(material, number.key) && (!value || number.range.contains(*value));
  });
}

/// A ratio between two axes is bounded by their moduli: ν_ab² < E_a/E_b.
struct Pair {
  std::string_view poisson;
  std::string_view young_a;
  std::string_view young_b;
  double ratio;
  double a;
  double b;
};

void tell_ratio(const Pair& pair, std::vector<LawFault>& faults) {
  const double bound = std::sqrt(pair.a / pair.b);
  if (std::abs(pair.ratio) < bound)
    return;
  faults.push_back({{pair.poisson, pair.young_a, pair.young_b},
                    false,
                    fmt::format("found {}, expected a number between {:.6g} and {:.6g}, the roots of "
                                "{}/{}: else a strain has no positive energy",
                                pair.ratio, -bound, bound, pair.young_a, pair.young_b)});
}

/// det S > 0 of the direct strains, S scaled by the roots of the moduli.
void tell_all_three(const Pair& xy, const Pair& yz, const Pair& xz, std::vector<LawFault>& faults) {
  const auto scaled = [](const Pair& pair) { return pair.ratio * std::sqrt(pair.b / pair.a); };
  const double a = scaled(xy);
  const double b = scaled(yz);
  const double c = scaled(xz);
  const double rest = 1 - a * a - b * b - c * c - 2 * a * b * c;
  if (rest > 0)
    return;
  faults.push_back({{"poisson_xy", "poisson_yz", "poisson_xz", "young_x", "young_y", "young_z"},
                    false,
                    fmt::format("poisson_xy {}, poisson_yz {} and poisson_xz {} make 1 - nu_xy nu_yx - nu_yz "
                                "nu_zy - nu_xz nu_zx - 2 nu_yx nu_zy nu_xz = {:.6g}, expected more than 0: "
                                "else a strain has no positive energy",
                                xy.ratio, yz.ratio, xz.ratio, rest)});
}

void tell_indefinite(const Orthotropy& o, Physics physics, std::vector<LawFault>& faults) {
  const Pair xy{"poisson_xy", "young_x", "young_y", o.poisson_xy, o.young_x, o.young_y};
  tell_ratio(xy, faults);
  if (physics == Physics::plane_stress || !o.young_z || !o.poisson_yz || !o.poisson_xz)
    return;
  const Pair yz{"poisson_yz", "young_y", "young_z", *o.poisson_yz, o.young_y, *o.young_z};
  const Pair xz{"poisson_xz", "young_x", "young_z", *o.poisson_xz, o.young_x, *o.young_z};
  tell_ratio(yz, faults);
  tell_ratio(xz, faults);
  if (faults.empty())
    tell_all_three(xy, yz, xz, faults);
}

} // namespace

std::vector<LawFault> orthotropic_faults(const Material& material, Physics physics) {
  std::vector<LawFault> faults;
  tell_missing(material, physics, faults);
  tell_turns_out_of_plane(material, physics, faults);
  if (can_be_judged(material))
    tell_indefinite(material.orthotropy, physics, faults);
  return faults;
}

} // namespace rubato::study
