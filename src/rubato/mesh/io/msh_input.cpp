// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/msh_input.hpp"

#include "rubato/core/error.hpp"
#include "rubato/mesh/io/file_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

namespace rubato::mesh::msh {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

bool is_blank(char letter) {
  return blanks.find(letter) != std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

} // namespace

Input::Input(const std::filesystem::path& path, const std::filesystem::path& called)
    : called_(called.empty() ? path : called), text_(file_content(path, called_, "a Gmsh file")) {}

void Input::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_]))
    ++at_;
}

template <class T> T Input::parsed(std::string_view what) {
  skip_blanks();
  T value{};
  const auto* const last = text_.data() + text_.size();
  const auto [end, error] = std::from_chars(text_.data() + at_, last, value);
  if (error != std::errc() || (end != last && !is_blank(*end)))
    refuse_found(what);
  at_ = static_cast<std::size_t>(end - text_.data());
  return value;
}

template <class T> T Input::raw(std::string_view what) {
  std::array<char, sizeof(T)> bytes{};
  if (text_.size() - at_ < sizeof(T))
    refuse_here(fmt::format("it ends where {} was expected", what));
  std::memcpy(bytes.data(), text_.data() + at_, sizeof(T));
  at_ += sizeof(T);
  if (encoding_.swapped)
    std::ranges::reverse(bytes);
  T value{};
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

std::int64_t Input::integer(std::string_view what) {
  return encoding_.binary ? raw<std::int32_t>(what) : parsed<std::int64_t>(what);
}

std::int64_t Input::size(std::string_view what) {
  if (!encoding_.binary)
    return parsed<std::int64_t>(what);
  return encoding_.size_bytes == 4 ? raw<std::uint32_t>(what) : raw<std::int64_t>(what);
}

double Input::real(std::string_view what) {
  return encoding_.binary ? raw<double>(what) : parsed<double>(what);
}

std::size_t Input::count(std::int64_t count, Least each, std::string_view what) const {
  // As text a number takes a digit and a blank.
  const int bytes = encoding_.binary ? 4 * each.integers + encoding_.size_bytes * each.sizes + 8 * each.reals
                                     : 2 * (each.integers + each.sizes + each.reals);
  if (count < 0 ||
      static_cast<std::uint64_t>(count) > (text_.size() - at_ + 1) / static_cast<unsigned>(bytes))
    refuse_here(fmt::format("it announces {} {}, more than it can hold", count, what));
  return static_cast<std::size_t>(count);
}

std::int64_t Input::text_integer(std::string_view what) {
  return parsed<std::int64_t>(what);
}

std::string_view Input::word() {
  skip_blanks();
  const auto begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]))
    ++at_;
  return std::string_view(text_).substr(begin, at_ - begin);
}

std::string_view Input::rest_of_line() {
  const auto line = rest().substr(0, rest().find('\n'));
  at_ = std::min(text_.size(), at_ + line.size() + 1);
  return trimmed(line);
}

std::string_view Input::next_section() {
  while (at_ < text_.size())
    if (const auto line = rest_of_line(); line.starts_with('$'))
      return line.substr(1);
  return {};
}

void Input::end_section(std::string_view name) {
  skip_blanks();
  const auto end = fmt::format("$End{}", name);
  if (!rest().starts_with(end))
    refuse_found(end);
  at_ += end.size();
}

void Input::skip_section(std::string_view name) {
  const auto end = fmt::format("$End{}", name);
  const auto found = text_.find(end, at_);
  if (found == std::string::npos)
    refuse(fmt::format("is truncated or damaged: its section ${} has no {}", name, end));
  at_ = found + end.size();
}

void Input::refuse(std::string_view text) const {
  throw InputError(fmt::format("mesh file '{}' {}", called_.string(), text));
}

void Input::refuse_here(std::string_view text) const {
  const auto place =
      encoding_.binary
          ? fmt::format("byte {}", at_)
          : fmt::format("line {}", 1 + std::count(text_.begin(),
                                                  text_.begin() + static_cast<std::ptrdiff_t>(
                                                                      std::min(at_, text_.size())),
                                                  '\n'));
  refuse(fmt::format("is truncated or damaged at {}: {}", place, text));
}

void Input::refuse_found(std::string_view what) const {
  constexpr std::size_t shown = 24;
  auto found = std::string(rest().substr(0, std::min(shown, rest().find_first_of(blanks))));
  std::ranges::replace_if(
      found, [](unsigned char letter) { return letter < ' ' || letter > '~'; }, '?');
  refuse_here(found.empty() ? fmt::format("it ends where {} was expected", what)
                            : fmt::format("found '{}', expected {}", found, what));
}

} // namespace rubato::mesh::msh
