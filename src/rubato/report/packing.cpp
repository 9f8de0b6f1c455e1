// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/packing.hpp"

#include "rubato/core/base64.hpp"

#include <bit>
#include <new>
#include <vector>
#include <zlib.h>

namespace rubato::report {
namespace {

using Bytes = std::vector<std::byte>;

std::string compressed(const Bytes& bytes) {
  auto size = compressBound(static_cast<uLong>(bytes.size()));
  Bytes smaller(size);
  if (compress2(reinterpret_cast<Bytef*>(smaller.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::bad_alloc();
  return to_base64(std::span(smaller).first(size));
}

/// The bytes of the differences in planes: all lowest bytes first.
template <class T> Bytes planes(std::span<const T> numbers) {
  constexpr unsigned bits_of_plane = 8;
  const auto count = numbers.size();
  Bytes bytes(count * sizeof(T));
  T former = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto difference = static_cast<T>(numbers[i] - former);
    former = numbers[i];
    for (std::size_t plane = 0; plane < sizeof(T); ++plane)
      bytes[plane * count + i] = static_cast<std::byte>(difference >> (bits_of_plane * plane));
  }
  return bytes;
}

} // namespace

std::string packed(std::span<const std::uint16_t> numbers) {
  return compressed(planes(numbers));
}

std::string packed(std::span<const std::uint32_t> numbers) {
  return compressed(planes(numbers));
}

std::string packed(std::span<const float> numbers) {
  std::vector<std::uint32_t> bits;
  bits.reserve(numbers.size());
  for (const float number : numbers)
    bits.push_back(std::bit_cast<std::uint32_t>(number));
  return compressed(planes(std::span<const std::uint32_t>(bits)));
}

} // namespace rubato::report
