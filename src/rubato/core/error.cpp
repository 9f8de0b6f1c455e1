// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"

#include <fmt/format.h>

namespace rubato {
namespace {

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const auto& fault : faults) {
    const auto place = place_of(fault);
    text += fmt::format("{}{}{}{}", text.empty() ? "" : "\n", place, place.empty() ? "" : ": ", fault.text);
  }
  return text;
}

} // namespace

Fault fault_at(std::string path, std::string text) {
  return {{}, std::move(text), std::move(path)};
}

std::string place_of(const Fault& fault) {
  const auto at = to_string(fault.at);
  return !at.empty() || fault.text.starts_with(fault.path) ? at : fault.path;
}

std::string to_string(const Location& at) {
  if (at.line <= 0)
    return at.file;
  return at.column > 0 ? fmt::format("{}:{}:{}", at.file, at.line, at.column)
                       : fmt::format("{}:{}", at.file, at.line);
}

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(joined(faults)), faults_(std::move(faults)) {}

InputError::InputError(std::string text, Location at)
    : InputError(std::vector<Fault>{{std::move(at), std::move(text)}}) {}

} // namespace rubato
