// SPDX-License-Identifier: LGPL-3.0-or-later
// A resumed run asks for columns in another order than one that was never stopped.
#include "rubato/deck/read.hpp"
#include "rubato/step/compliance.hpp"
#include "rubato/step/effective_system.hpp"

#include <gtest/gtest.h>

#include "decks.hpp"
#include <numeric>
#include <vector>

namespace rubato::step {
namespace {

class ComplianceOf : public testing::TestWithParam<const char*> {};

TEST_P(ComplianceOf, HasTheSameBitsInWhateverOrderItIsAskedFor) {
  const auto model = model::build_model(
      deck::parse_deck(test::two_beams, "deck.yaml", {{{"mesh.refine", GetParam()}}}).runs.front());
  const auto scheme = time::make_scheme(model.study.time);
  auto by_one = make_effective_system(model, scheme, 1e-3);
  auto backwards = make_effective_system(model, scheme, 1e-3);
  auto whole = make_effective_system(model, scheme, 1e-3);
  std::vector<int> all(whole.compliance->surface().size());
  std::iota(all.begin(), all.end(), 0);
  for (const int position : all)
    by_one.compliance->prepare(std::vector{position});
  for (std::size_t i = all.size(); i > 0; i -= std::min<std::size_t>(i, 7))
    backwards.compliance->prepare(std::vector{all[i - 1], all[i / 2]});
  const Eigen::MatrixXd expected = whole.compliance->between(all);
  EXPECT_EQ(by_one.compliance->between(all), expected);
  EXPECT_EQ(backwards.compliance->between(all), expected);
}

INSTANTIATE_TEST_SUITE_P(SurfacesCutInto, ComplianceOf, testing::Values("1", "8"),
                         [](const auto& chosen) { return std::string(chosen.param); });

} // namespace
} // namespace rubato::step
