// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/law_field.hpp"

#include "rubato/core/error.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/fields.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <span>

namespace rubato::material {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::span<const double, 3> numbers_of(const Vector3d& place) {
  return std::span<const double, 3>(place.data(), 3);
}

Vector3d vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

Vector3d direction_of(const study::CylindricalAxes& axes) {
  return vector_of(axes.direction).normalized();
}

/// From the line to the place, square to the line.
Vector3d arm_of(const study::CylindricalAxes& axes, const Vector3d& place) {
  const Vector3d along = direction_of(axes);
  const Vector3d arm = place - vector_of(axes.point);
  return arm - arm.dot(along) * along;
}

/// Columns: away from the line, around it, along it.
Matrix3d axes_at(const study::CylindricalAxes& axes, const Vector3d& place, const std::string& path) {
  const Vector3d arm = arm_of(axes, place);
  if (!(arm.norm() > 0))
    throw InputError({fault_at(
        path, fmt::format("{}: {} is on the line about which the axes turn, where they have no direction",
                          path, shown_place(numbers_of(place))))});
  Matrix3d columns;
  columns.col(0) = arm.normalized();
  columns.col(2) = direction_of(axes);
  columns.col(1) = columns.col(2).cross(columns.col(0));
  return columns;
}

/// A value of the study within its bounds.
double value_at(const FieldFunction& field, const Vector3d& place, const study::Range& range) {
  const double value = field.at(numbers_of(place), 0);
  if (!range.contains(value))
    throw InputError(
        {fault_at(field.path, fmt::format("{}: found {:.6g} at {}, expected a number{}", field.path, value,
                                          shown_place(numbers_of(place)), study::bounds_text(range)))});
  return value;
}

/// Without what only messages need: it is copied at each point.
study::Material numbers_alone(const study::Material& material) {
  study::Material numbers;
  numbers.law = material.law;
  numbers.young = material.young;
  numbers.poisson = material.poisson;
  numbers.orthotropy = material.orthotropy;
  numbers.density = material.density;
  return numbers;
}

FieldFunction field_of(const study::FieldValue& value, const std::string& path) {
  return study::field_function(value, {}, {}, path);
}

} // namespace

LawField::LawField(const study::Material& material, study::Physics physics)
    : material_(numbers_alone(material)), physics_(physics), path_("materials." + material.name) {
  for (const auto& number : study::entry_of(material.law).numbers)
    if (const auto placed = material.in_place.find(std::string(number.key));
        placed != material.in_place.end())
      numbers_.push_back({number, field_of(placed->second, path_ + "." + placed->first)});
  if (const auto placed = material.in_place.find("density"); placed != material.in_place.end())
    density_ = field_of(placed->second, path_ + ".density");
  if (material.law == study::LawKind::orthotropic)
    axes_ = material.orthotropy.cylindrical;
}

study::Material LawField::with_numbers_at(const Vector3d& place) const {
  auto numbers = material_;
  for (const auto& [number, value] : numbers_)
    number.set(numbers, value_at(value, place, number.range));
  if (density_)
    numbers.density = density_at(place);
  return numbers;
}

void LawField::check_together(const study::Material& numbers, const Vector3d& place) const {
  const auto& law = study::entry_of(numbers.law);
  if (numbers_.empty() || law.faults == nullptr)
    return;
  for (const auto& fault : law.faults(numbers, physics_)) {
    const auto path = fault.missing ? path_ : fmt::format("{}.{}", path_, fault.keys.front());
    throw InputError(
        {fault_at(path, fmt::format("{}: at {}: {}", path, shown_place(numbers_of(place)), fault.text))});
  }
}

Law LawField::at(const Vector3d& place) const {
  const auto numbers = with_numbers_at(place);
  check_together(numbers, place);
  if (!axes_)
    return make_law(numbers);
  return make_orthotropic(numbers.orthotropy, numbers.density.value_or(0),
                          axes_at(*axes_, place, path_of_axes()));
}

double LawField::density_at(const Vector3d& place) const {
  return density_ ? value_at(*density_, place, study::bounds::density_in_place)
                  : material_.density.value_or(0);
}

std::optional<double> LawField::distance_to_axis(const Vector3d& place) const {
  if (!axes_)
    return std::nullopt;
  return arm_of(*axes_, place).norm();
}

std::shared_ptr<const LawField> law_field(const study::Material& material, study::Physics physics) {
  const bool turns = material.law == study::LawKind::orthotropic && material.orthotropy.cylindrical;
  if (material.in_place.empty() && !turns)
    return nullptr;
  return std::make_shared<const LawField>(material, physics);
}

} // namespace rubato::material
