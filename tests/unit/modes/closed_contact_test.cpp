// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "modal_model.hpp"

namespace rubato::modes::closed_contact_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int number = 8;

double largest_difference(const VectorXd& a, const VectorXd& b) {
  return (a - b).cwiseQuotient(b).cwiseAbs().maxCoeff();
}

class ClosedZone : public testing::TestWithParam<const char*> {};

TEST_P(ClosedZone, StuckOnAMatchingMeshVibratesAsOneBody) {
  const auto two = modes_of(test::modal_model(test::stacked_blocks("[2, 2, 2]", GetParam())),
                            {.number = number, .contact = Contact::stuck});
  const auto one = modes_of(test::modal_model(test::one_block), {.number = number});
  EXPECT_TRUE(two.converged);
  EXPECT_LE(largest_difference(two.frequencies, one.frequencies), 1e-9);
  ASSERT_EQ(two.notes.size(), 1U);
  EXPECT_TRUE(two.notes.front().starts_with("contact.joint: ")) << two.notes.front();
}

TEST_P(ClosedZone, SlidingHoldsNothingAlongTheSurface) {
  const auto model = test::modal_model(test::stacked_blocks("[2, 2, 2]", GetParam()));
  const auto modes = modes_of(model, {.number = number, .contact = Contact::sliding});
  EXPECT_TRUE(modes.converged);
  EXPECT_EQ((modes.frequencies.array() == 0).count(), 3) << "two translations and a turn about y";
  const auto stuck = modes_of(model, {.number = number, .contact = Contact::stuck});
  EXPECT_TRUE((modes.frequencies.array() < stuck.frequencies.array()).all());
  const Eigen::VectorXd apart = (closed_contact(model, Contact::sliding).relations.transpose() * modes.shapes)
                                    .cwiseAbs()
                                    .rowwise()
                                    .sum();
  EXPECT_LE(apart.maxCoeff(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Discretised, ClosedZone,
                         testing::Values("integration: nodes", "integration: mortar",
                                         "integration: {gauss: 2}, friction: 0.2",
                                         "integration: nodes, method: penalty"));

TEST(ClosedContact, IsNoneWhereSurfacesDoNotTouch) {
  const auto zone = "integration: nodes, gap: 1e-3";
  const auto model = test::modal_model(test::stacked_blocks("[2, 2, 2]", zone));
  EXPECT_EQ(closed_contact(model, Contact::stuck).relations.nonZeros(), 0);
  const auto modes = modes_of(model, {.number = number, .contact = Contact::stuck});
  EXPECT_EQ((modes.frequencies.array() == 0).count(), 6);
}

TEST(ClosedContact, HoldsTiesThatAreOpenToo) {
  const auto tied = test::stacked_blocks("[3, 2, 3]", "tie: true");
  const auto mortar = test::stacked_blocks("[3, 2, 3]", "integration: mortar");
  const auto a = modes_of(test::modal_model(tied), {.number = number});
  const auto b = modes_of(test::modal_model(mortar), {.number = number, .contact = Contact::stuck});
  EXPECT_GT(a.frequencies[0], 0);
  EXPECT_LE(largest_difference(a.frequencies, b.frequencies), 1e-9);
}

} // namespace
} // namespace rubato::modes::closed_contact_test
