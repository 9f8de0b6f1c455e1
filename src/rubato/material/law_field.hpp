// SPDX-License-Identifier: LGPL-3.0-or-later
/// Material laws whose numbers, or axes, depend on the undeformed place.
#pragma once

#include "rubato/core/field_function.hpp"
#include "rubato/material/law.hpp"
#include "rubato/study/material_laws.hpp"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rubato::material {

class LawField {
public:
  /// Of a material that keeps the study's rules; the files of its fields have been read. Throws InputError
  /// when an expression is broken.
  LawField(const study::Material& material, study::Physics physics);

  /// The law at a place (2D: z = 0). Throws InputError at the value in the study when a number is beyond its
  /// bounds there, when the numbers together give some strain no positive energy, and on the line about which
  /// cylindrical axes turn: a sentence with the place.
  Law at(const Eigen::Vector3d& place) const;
  /// The density alone, 0 when there is none. Throws as `at` does, when it is not > 0 where it depends on the
  /// place.
  double density_at(const Eigen::Vector3d& place) const;

  /// Whether the tangent depends on the place, and the density.
  bool varies_tangent() const { return !numbers_.empty() || axes_.has_value(); }
  bool varies_density() const { return density_.has_value(); }

  /// From the line about which cylindrical axes turn; nothing without such axes [length].
  std::optional<double> distance_to_axis(const Eigen::Vector3d& place) const;
  /// Of those axes in the study.
  std::string path_of_axes() const { return path_ + ".axes"; }

private:
  struct Placed {
    study::Number<study::Material> number;
    FieldFunction value;
  };
  study::Material with_numbers_at(const Eigen::Vector3d& place) const;
  void check_together(const study::Material& numbers, const Eigen::Vector3d& place) const;

  study::Material material_; ///< its numbers that are the same everywhere
  study::Physics physics_;
  std::string path_;
  std::vector<Placed> numbers_;
  std::optional<FieldFunction> density_;
  std::optional<study::CylindricalAxes> axes_;
};

/// Null when the material is the same everywhere.
std::shared_ptr<const LawField> law_field(const study::Material& material, study::Physics physics);

} // namespace rubato::material
