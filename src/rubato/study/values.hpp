// SPDX-License-Identifier: LGPL-3.0-or-later
/// Values of a study that may change with place and time.
#pragma once

#include "rubato/core/field_function.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace rubato::study {

/// A number, times a named function of time when `function` is not empty.
struct Amplitude {
  double value = 0;
  std::string function;
  bool operator==(const Amplitude&) const = default;
};

/// The text of an expression (core/expression.hpp) of x, y, z, the undeformed place, and t, the instant.
struct Formula {
  std::string text;
  bool operator==(const Formula&) const = default;
};

/// A field at the nodes of a file (.med or .rmed, .vtu, .pvd), whose mesh is that of the study: nodes are
/// matched by their places. Between nodes it has the shape functions of the study's cells.
struct FileField {
  std::string file;
  std::string name;
  std::string component;    ///< empty: the field is a scalar
  std::optional<double> at; ///< instant; without one the field runs through those of the file, linearly
  /// What the file has; the model reads it.
  std::shared_ptr<const SampledField> values = {};
  bool operator==(const FileField& other) const {
    return file == other.file && name == other.name && component == other.component && at == other.at;
  }
};

/// A field that the program computes which made the study. No deck has it: an echo has its name only.
struct GivenField {
  std::string name; ///< by which messages call it
  std::shared_ptr<const SampledField> values = {};
  bool operator==(const GivenField&) const = default;
};

/// A number, or a number at each place: an expression, which may have the instant too, a table along an
/// axis, a field of a file or one that a program gives.
struct FieldValue {
  FieldValue(double number = 0) : is(number) {}
  FieldValue(Formula formula) : is(std::move(formula)) {}
  FieldValue(Profile profile) : is(std::move(profile)) {}
  FieldValue(FileField field) : is(std::move(field)) {}
  FieldValue(GivenField field) : is(std::move(field)) {}

  std::variant<double, Formula, Profile, FileField, GivenField> is;

  /// What it is; null when it is one of the others.
  const double* number() const { return std::get_if<double>(&is); }
  const Formula* formula() const { return std::get_if<Formula>(&is); }
  const Profile* profile() const { return std::get_if<Profile>(&is); }
  const FileField* of_file() const { return std::get_if<FileField>(&is); }
  const GivenField* of_program() const { return std::get_if<GivenField>(&is); }
  bool operator==(const FieldValue&) const = default;
};

/// What of a motion a value gives. From a velocity and an acceleration the displacement follows by
/// integration over time; the enumerators count the integrals.
enum class Given { displacement, velocity, acceleration };

/// A number, an expression, a table, a field of a file or of a program, times a named function of time when
/// `function` is not empty.
struct Field {
  Field() = default;
  Field(double number, std::string of_time = {}) : value(number), function(std::move(of_time)) {}
  Field(Formula formula, std::string of_time = {})
      : value(std::move(formula)), function(std::move(of_time)) {}
  Field(Profile profile, std::string of_time = {})
      : value(std::move(profile)), function(std::move(of_time)) {}
  Field(FileField field, std::string of_time = {}) : value(std::move(field)), function(std::move(of_time)) {}
  Field(GivenField field, std::string of_time = {}) : value(std::move(field)), function(std::move(of_time)) {}
  Field(Amplitude amplitude) : value(amplitude.value), function(std::move(amplitude.function)) {}

  FieldValue value;
  std::string function;
  Given given = Given::displacement; ///< of supports and of the base; all others give what they are
  bool operator==(const Field&) const = default;
};

} // namespace rubato::study
