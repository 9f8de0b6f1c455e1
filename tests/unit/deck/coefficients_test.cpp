// SPDX-License-Identifier: LGPL-3.0-or-later
// Coefficients of contact methods: each takes its own.
#include <gtest/gtest.h>

#include "sample_deck.hpp"
#include <string>

namespace rubato::deck::coefficients_test {
namespace {

using test::faults_of_zone;
using test::Sentences;

TEST(ContactCoefficients, OfAnExponentialPressureAreItsTwoNumbersAndNoStiffness) {
  const auto faults = [](const std::string& coefficients) {
    return faults_of_zone("method: exponential" + coefficients);
  };
  EXPECT_EQ(faults(", coefficients: {pressure: 2e6, clearance: 1e-5}"), Sentences{});
  EXPECT_EQ(faults(""),
            (Sentences{"contact.a: 'coefficients.clearance' is missing, which exponential needs",
                       "contact.a: 'coefficients.pressure' is missing, which exponential needs"}));
  EXPECT_EQ(faults(", coefficients: {pressure: 2e6}"),
            Sentences{"contact.a.coefficients: 'clearance' is missing"});
  EXPECT_EQ(faults(", coefficients: {pressure: -1, clearance: 0}").size(), 2U);
  EXPECT_EQ(faults(", coefficients: {pressure: 2e6, clearance: 1e-5, normal: 1}"),
            Sentences{"contact.a.coefficients.normal: the method exponential takes no normal, "
                      "augmented_lagrangian, penalty, nodal_lagrange, nodal_penalty and nodal_pcg take it; a "
                      "run removes it by 'normal: ~'"});
  EXPECT_EQ(faults_of_zone("method: penalty, coefficients: {clearance: 1}"),
            Sentences{"contact.a.coefficients.clearance: the method penalty takes no clearance, exponential "
                      "takes it; a run removes it by 'clearance: ~'"});
}

} // namespace
} // namespace rubato::deck::coefficients_test
