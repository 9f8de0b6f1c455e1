// SPDX-License-Identifier: LGPL-3.0-or-later
/// Fields that functions of Python give.
#pragma once

#include "rubato/core/field_function.hpp"

#include <pybind11/pybind11.h>
#include <string>

namespace rubato::python {

/// A function of x, y, z, the undeformed place, and t, which is called with the interpreter's lock held, by
/// whatever thread.
class CalledField : public SampledField {
public:
  CalledField(std::string name, pybind11::object function, bool varies_in_time);
  /// In any thread, with the lock or without it.
  ~CalledField() override;

  /// Throws InputError, which names the field, the place and what the function raised; KeyboardInterrupt and
  /// SystemExit pass.
  double at(std::span<const double, 3> place, double t) const override;
  bool varies_in_time() const override { return varies_in_time_; }
  const pybind11::object& function() const { return function_; }

private:
  std::string name_;
  pybind11::object function_;
  bool varies_in_time_;
};

} // namespace rubato::python
