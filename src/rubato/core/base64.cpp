// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/base64.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>

namespace rubato {
namespace {

constexpr std::string_view base64_letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr unsigned bits_of_letter = 6;
constexpr unsigned bits_of_byte = 8;
constexpr unsigned letter_mask = (1U << bits_of_letter) - 1;
constexpr std::int8_t no_letter = -1;

constexpr auto value_of_letter = [] {
  std::array<std::int8_t, 256> values{};
  values.fill(no_letter);
  for (std::size_t i = 0; i < base64_letters.size(); ++i)
    values[static_cast<unsigned char>(base64_letters[i])] = static_cast<std::int8_t>(i);
  return values;
}();

bool is_blank(char letter) {
  return letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t';
}

} // namespace

std::string to_base64(std::span<const std::byte> bytes) {
  constexpr std::size_t group = 3; // bytes that four letters hold
  std::string text;
  text.reserve((bytes.size() + group - 1) / group * (group + 1));
  std::uint32_t held = 0;
  unsigned bits = 0;
  for (const auto byte : bytes) {
    held = held << bits_of_byte | std::to_integer<std::uint32_t>(byte);
    for (bits += bits_of_byte; bits >= bits_of_letter; bits -= bits_of_letter)
      text += base64_letters[held >> (bits - bits_of_letter) & letter_mask];
  }
  if (bits > 0)
    text += base64_letters[held << (bits_of_letter - bits) & letter_mask];
  while (text.size() % (group + 1) != 0)
    text += '=';
  return text;
}

std::vector<std::byte> from_base64(std::string_view text) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() * bits_of_letter / bits_of_byte);
  std::uint32_t held = 0;
  unsigned bits = 0;
  for (const char letter : text) {
    if (letter == '=')
      break;
    if (is_blank(letter))
      continue;
    const auto value = value_of_letter[static_cast<unsigned char>(letter)];
    if (value == no_letter)
      throw std::invalid_argument("found a letter that base64 does not have");
    held = held << bits_of_letter | static_cast<std::uint32_t>(value);
    bits += bits_of_letter;
    if (bits >= bits_of_byte) {
      bits -= bits_of_byte;
      bytes.push_back(static_cast<std::byte>(held >> bits));
    }
  }
  return bytes;
}

} // namespace rubato
