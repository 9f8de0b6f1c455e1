// SPDX-License-Identifier: LGPL-3.0-or-later
// Libraries that are loaded while a program runs, and the messages when they are missing.
#include "rubato/core/dynamic_library.hpp"
#include "rubato/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rubato::dynamic_library_test {
namespace {

constexpr LibraryName mathematics{.soname = "libm.so.6", .package = "libc6", .users = "cosines"};

/// The message of the InputError that `work` throws.
template <class Work> std::string refusal(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

TEST(DynamicLibraries, GiveTheirFunctions) {
  const DynamicLibrary library(mathematics);
  double (*const cosine)(double) = library.symbol("cos");
  EXPECT_EQ(cosine(1.0), std::cos(1.0));
}

TEST(DynamicLibraries, GiveTheirVariables) {
  const DynamicLibrary library(mathematics);
  const int* sign_of_gamma = library.symbol("signgam");
  EXPECT_NE(sign_of_gamma, nullptr);
}

TEST(DynamicLibraries, AreNamedWithTheirPackageWhenTheyAreMissing) {
  const LibraryName missing{.soname = "librubato_missing.so.1",
                            .package = "librubato-missing1",
                            .users = "MED files",
                            .otherwise = " or convert the mesh to VTU"};
  EXPECT_EQ(
      refusal([&] { DynamicLibrary library(missing); }),
      "MED files need the library librubato_missing.so.1, which cannot be loaded "
      "(librubato_missing.so.1: cannot open shared object file: No such file or directory); install the "
      "Debian package librubato-missing1 or convert the mesh to VTU");
}

TEST(DynamicLibraries, AreNamedAloneWhereNoPackageIsKnown) {
  const LibraryName missing{.soname = "librubato_missing.so.1", .package = "", .users = "MED files"};
  EXPECT_TRUE(refusal([&] { DynamicLibrary library(missing); }).ends_with("; install it"));
}

TEST(DynamicLibraries, AreNamedWithTheFunctionThatTheyLack) {
  const DynamicLibrary library(mathematics);
  const auto text = refusal([&] { library.symbol("rubato_missing"); });
  EXPECT_TRUE(text.starts_with("cosines need the library libm.so.6, which cannot be loaded (")) << text;
  EXPECT_TRUE(text.ends_with("undefined symbol: rubato_missing); install the Debian package libc6")) << text;
}

} // namespace
} // namespace rubato::dynamic_library_test
