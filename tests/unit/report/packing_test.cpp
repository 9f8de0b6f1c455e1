// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/base64.hpp"
#include "rubato/report/packing.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <vector>
#include <zlib.h>

namespace rubato::report::packing_test {
namespace {

/// Undoes what data.js undoes, from the format's description.
template <class T> std::vector<T> unpacked(const std::string& text, std::size_t count) {
  const auto compressed = from_base64(text);
  auto size = static_cast<uLongf>(count * sizeof(T));
  std::vector<unsigned char> bytes(size + 1);
  EXPECT_EQ(uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(compressed.data()),
                       static_cast<uLong>(compressed.size())),
            Z_OK);
  EXPECT_EQ(size, count * sizeof(T));
  std::vector<T> numbers;
  T sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    T difference = 0;
    for (std::size_t plane = 0; plane < sizeof(T); ++plane)
      difference = static_cast<T>(difference | static_cast<T>(T{bytes[plane * count + i]} << (8 * plane)));
    sum = static_cast<T>(sum + difference);
    numbers.push_back(sum);
  }
  return numbers;
}

TEST(PackedNumbers, AreReadBackWhereDifferencesLeaveTheRangeToo) {
  const std::vector<std::uint16_t> sixteen{0, 65535, 1, 65534, 40000, 3, 3};
  EXPECT_EQ(unpacked<std::uint16_t>(packed(sixteen), sixteen.size()), sixteen);
  const std::vector<std::uint32_t> thirty_two{7, 0, 4294967295U, 1, 70000, 5};
  EXPECT_EQ(unpacked<std::uint32_t>(packed(thirty_two), thirty_two.size()), thirty_two);
}

TEST(PackedNumbers, KeepTheBitsOfRealNumbers) {
  const std::vector<float> numbers{0.0F, -1.5F, 3e38F, 1e-40F, 0.1F};
  const auto bits = unpacked<std::uint32_t>(packed(numbers), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(std::bit_cast<float>(bits[i]), numbers[i]);
}

TEST(PackedNumbers, OfASmoothFieldTakeLittleRoom) {
  std::vector<std::uint16_t> ramp;
  for (std::uint16_t i = 0; i < 10000; ++i)
    ramp.push_back(static_cast<std::uint16_t>(3 * i));
  EXPECT_LT(packed(ramp).size(), 200U);
}

TEST(PackedNumbers, MayBeNone) {
  EXPECT_TRUE(unpacked<std::uint16_t>(packed(std::vector<std::uint16_t>{}), 0).empty());
}

} // namespace
} // namespace rubato::report::packing_test
