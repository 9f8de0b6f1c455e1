// SPDX-License-Identifier: LGPL-3.0-or-later
// Values of a study that are expressions of place and time.
#include "rubato/core/error.hpp"
#include "rubato/study/echo.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace rubato::study::fields_test {
namespace {

const std::string refused = "', expected a number or an expression of x, y, z and t: ";

/// What is wrong with the value at that path.
template <class Change> std::string flaw_at(const std::string& path, const Change& change) {
  Study study;
  study.physics = Physics::plane_strain;
  study.functions["ramp"] = {{0, 1}, {0, 1}, Function::Outside::constant};
  study.supports = {{"ground", {Field(), Field(), std::nullopt}}};
  study.loads = {{LoadKind::pressure, "above", {1e6, 0, 0}, "ramp"}};
  study.contact.emplace_back().name = "joint";
  study.time.scheme = SchemeKind::static_steps;
  change(study);
  for (const auto& rule : broken_rules(study))
    if (rule.paths.front() == path)
      return rule.text;
  return {};
}

TEST(AStudyOfAProgram, MayHaveExpressions) {
  const auto change = [](Study& s) {
    s.contact[0].gap = Formula{"1e-3*x"};
    s.contact[0].interference = {Formula{"1e-3*abs(y)"}, "ramp"};
    s.supports[0].components[1] = Field(Formula{"0.1*x*t"});
    s.loads[0].components[0] = Formula{"1e6*(1-y)"};
  };
  for (const auto* path :
       {"contact.joint.gap", "contact.joint.interference", "supports.0.y", "loads.0.pressure.value"})
    EXPECT_EQ(flaw_at(path, change), "") << path;
}

TEST(AStudyOfAProgram, MeetsTheRefusalsOfADeck) {
  EXPECT_EQ(flaw_at("contact.joint.gap", [](Study& s) { s.contact[0].gap = Formula{"x="}; }),
            "found 'x=" + refused + "'=' at character 2 would assign, expected '==', which compares");
  EXPECT_EQ(flaw_at("contact.joint.interference.value",
                    [](Study& s) {
                      s.contact[0].interference = {Formula{"(x"}, "ramp"};
                    }),
            "found '(x" + refused + "a closing bracket is missing");
  EXPECT_EQ(flaw_at("supports.0.y", [](Study& s) { s.supports[0].components[1] = Field(Formula{"x*"}); }),
            "found 'x*" + refused + "it ends where a value is expected");
  EXPECT_EQ(flaw_at("loads.0.pressure.value", [](Study& s) { s.loads[0].components[0] = Formula{""}; }),
            "found '" + refused + "it is empty");
  EXPECT_EQ(flaw_at("contact.joint.gap", [](Study& s) { s.contact[0].gap = Formula{"ramp"}; }),
            "found 'ramp', a function of time, expected {value: 1, function: ramp}");
  EXPECT_EQ(flaw_at("contact.joint.gap", [](Study& s) { s.contact[0].gap = Formula{"z"}; }),
            "found z in 'z', plane_strain has x and y only");
  EXPECT_EQ(flaw_at("contact.joint.gap.function",
                    [](Study& s) {
                      s.contact[0].gap = {Formula{"x"}, "ramb"};
                    }),
            "no function is called 'ramb'; did you mean 'ramp'?");
}

TEST(AStudyOfAProgram, MayHaveAGapOfPlaceButNotOfTimeInExplicitSteps) {
  const auto with = [](const Field& gap) {
    return flaw_at("contact.joint.gap", [&](Study& s) {
      s.time.scheme = SchemeKind::central_difference;
      s.contact[0].gap = gap;
    });
  };
  EXPECT_EQ(with(Formula{"x"}), "");
  const std::string told = "found a gap that changes, which the scheme central_difference does not follow, "
                           "expected an implicit scheme or a number or an expression without t";
  EXPECT_EQ(with(Formula{"x*t"}), told);
  EXPECT_EQ(with({Formula{"x"}, "ramp"}), told);
}

TEST(AField, IsWhatItsValueAndItsFunctionSay) {
  const std::map<std::string, Function> functions{{"ramp", {{0, 1}, {0, 1}}}};
  constexpr std::array place{2.0, 3.0, 4.0};
  EXPECT_EQ(field_function(Field(0.5, "ramp"), functions, "a").at(place, 0.5), 0.25);
  EXPECT_EQ(field_function(Formula{"x*y*z*t"}, functions, "a").at(place, 0.5), 12);
  EXPECT_EQ(field_function({Formula{"x"}, "ramp"}, functions, "a").at(place, 0.5), 1);
  EXPECT_TRUE(is_zero(Field()));
  EXPECT_FALSE(is_zero(Formula{"0"}));
  EXPECT_TRUE(varies_in_time(Formula{"x+t"}));
  EXPECT_FALSE(varies_in_time(Formula{"x+"})) << "what is broken does not";
  EXPECT_EQ(Field(Amplitude{2, "ramp"}), Field(2, "ramp"));
}

/// t x, as a program may compute it.
class Computed : public SampledField {
public:
  explicit Computed(bool in_time) : in_time_(in_time) {}
  double at(std::span<const double, 3> place, double t) const override {
    return in_time_ ? t * place[0] : place[0];
  }
  bool varies_in_time() const override { return in_time_; }

private:
  bool in_time_;
};

GivenField given(bool in_time) {
  return {"mine", std::make_shared<const Computed>(in_time)};
}

TEST(AFieldOfAProgram, IsWhatItsFunctionSays) {
  const std::map<std::string, Function> functions{{"ramp", {{0, 1}, {0, 1}}}};
  constexpr std::array place{2.0, 3.0, 4.0};
  EXPECT_EQ(field_function(Field(given(true)), functions, "a").at(place, 0.5), 1);
  EXPECT_EQ(field_function(Field(given(true), "ramp"), functions, "a").at(place, 0.5), 0.5);
  EXPECT_TRUE(varies_in_time(given(true)));
  EXPECT_FALSE(varies_in_time(given(false)));
  EXPECT_TRUE(varies_in_time(Field(given(false), "ramp")));
  EXPECT_THROW(field_function(Field(GivenField{"mine"}), functions, "a"), InputError);
}

TEST(AFieldOfAProgram, IsEqualToItselfAlone) {
  const auto one = given(false);
  EXPECT_EQ(one, GivenField(one));
  EXPECT_NE(one, given(false)) << "another function";
  EXPECT_NE(one, (GivenField{"other", one.values}));
  EXPECT_NE(FieldValue(one), FieldValue(0));
}

TEST(AFieldOfAProgram, IsJudgedByItsNameAndItsValues) {
  const auto with = [](const Field& gap) { return [gap](Study& s) { s.contact[0].gap = gap; }; };
  EXPECT_EQ(flaw_at("contact.joint.gap", with(given(true))), "");
  EXPECT_EQ(flaw_at("contact.joint.gap", with(GivenField{"mine"})),
            "the field 'mine' has no values, expected those that a program gives it");
  EXPECT_EQ(flaw_at("contact.joint.gap.given", with(GivenField{"", given(true).values})),
            "found no name, expected one");
  EXPECT_EQ(
      flaw_at("base_motion.x", [](Study& s) { s.base_motion.emplace().components[0] = Field(given(false)); }),
      "found a motion that depends on the place, expected a number or an expression of t: the base moves "
      "as a whole");
}

TEST(AFieldOfAProgram, IsEchoedByItsName) {
  Study study;
  study.loads = {{LoadKind::pressure, "above", {given(false), 0, 0}, ""}};
  EXPECT_NE(to_json(study).find("\"given\": \"mine\""), std::string::npos);
}

} // namespace
} // namespace rubato::study::fields_test
