// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/ccx/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace rubato::ccx {
namespace {

constexpr std::size_t longest_field = 20;
constexpr std::size_t longest_label = 70;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_label_character(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

std::string folded_label(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string made_valid(std::string_view name) {
  std::string label(name.substr(0, longest_label));
  std::ranges::replace_if(
      label, [](char c) { return !is_label_character(c); }, '_');
  return label.empty() || !is_letter(label.front()) ? "N" + label : label;
}

/// *SPRING reads a number without a point as a degree of freedom.
std::string with_point(std::string text) {
  if (text.find('.') == std::string::npos)
    text.insert(std::min(text.find('e'), text.size()), 1, '.');
  return text;
}

} // namespace

std::string shown_number(double value) {
  auto text = with_point(fmt::format("{}", value));
  for (int digits = 16; text.size() > longest_field; --digits)
    text = with_point(fmt::format("{:.{}g}", value, digits));
  return text;
}

std::string rows_of(std::span<const std::string> entries, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_last = i + 1 == entries.size();
    text += entries[i];
    text += is_last ? "\n" : (i + 1) % most == 0 ? ",\n" : ", ";
  }
  return text;
}

std::string rows_of(std::span<const std::int64_t> numbers) {
  std::vector<std::string> entries;
  entries.reserve(numbers.size());
  for (const auto number : numbers)
    entries.push_back(fmt::format("{}", number));
  return rows_of(entries);
}

std::string Labels::chosen(std::string_view kind, std::string_view name) {
  auto& taken = taken_[std::string(kind)];
  const auto wanted = made_valid(name);
  auto label = wanted;
  for (int i = 2; !taken.insert(folded_label(label)).second; ++i)
    label = fmt::format("{}_{}", wanted, i);
  return label;
}

} // namespace rubato::ccx
