// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/base64.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace rubato::base64_test {
namespace {

std::string coded(const std::string& text) {
  return to_base64(std::as_bytes(std::span(text)));
}

std::string decoded(std::string_view text) {
  const auto bytes = from_base64(text);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The examples of RFC 4648, section 10.
TEST(Base64, IsThatOfItsStandard) {
  const std::string all = "foobar";
  const char* const codes[]{"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t size = 0; size <= all.size(); ++size) {
    EXPECT_EQ(coded(all.substr(0, size)), codes[size]);
    EXPECT_EQ(decoded(codes[size]), all.substr(0, size));
  }
}

TEST(Base64, KeepsEveryByte) {
  std::string bytes;
  for (int i = 0; i < 256; ++i)
    bytes += static_cast<char>(i);
  EXPECT_EQ(decoded(coded(bytes)), bytes);
}

TEST(Base64, MayBeBrokenIntoLinesAndRefusesOtherLetters) {
  EXPECT_EQ(decoded(" Zm9v\nYmFy\n"), "foobar");
  EXPECT_THROW(from_base64("Zm9*"), std::invalid_argument);
}

} // namespace
} // namespace rubato::base64_test
