// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/inp/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::inp {
namespace {

/// The curve as a function of total time, its own zero being at `origin`.
Function function_of(const Curve& curve, double origin) {
  if (!curve.formula.empty()) {
    const auto own = origin == 0 ? std::string("t") : fmt::format("(t-({}))", origin);
    std::string text;
    for (const char letter : curve.formula)
      letter == 'T' ? text += own : text += letter;
    return {Expression(text)};
  }
  auto table = curve.table;
  for (auto& instant : table.at)
    instant += origin;
  return {table};
}

double origin_of(const Course& course) {
  return course.curve->total_time ? 0 : course.origin;
}

/// Equal functions share a name.
std::string function_name(study::Study& study, const std::string& wanted, const Function& function) {
  auto name = wanted;
  for (int i = 2; study.functions.contains(name) && !(study.functions.at(name) == function); ++i)
    name = fmt::format("{}_{}", wanted, i);
  study.functions.try_emplace(name, function);
  return name;
}

} // namespace

double value_at_end(const Course& course, double, double end) {
  return course.curve == nullptr
             ? course.to
             : course.scale * value_at(function_of(*course.curve, origin_of(course)), end);
}

std::pair<double, std::string> value_in(study::Study& study, const Course& course, double begin, double end,
                                        int step) {
  if (course.curve != nullptr)
    return {course.scale,
            function_name(study, course.curve->name, function_of(*course.curve, origin_of(course)))};
  if (course.from == course.to)
    return {course.to, {}};
  const auto wanted = fmt::format("step{}_{}", step, course.rise > 0 ? "rise" : "ramp");
  if (course.rise > 0)
    end = std::min(end, begin + course.rise);
  if (course.to == 0)
    return {course.from, function_name(study, fmt::format("step{}_fall", step), {Ramp{begin, end, 1, 0}})};
  return {course.to, function_name(study, wanted,
                                   {Ramp{begin, end, course.from == 0 ? 0 : course.from / course.to, 1}})};
}

} // namespace rubato::inp
