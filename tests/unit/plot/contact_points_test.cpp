// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/contact_points.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <cmath>
#include <fstream>

namespace rubato::plot::contact_points_test {
namespace {

class ContactPointsOfARun : public testing::Test {
protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string fault(const std::string& zone) const {
    return test::fault_of([&] { read_contact_points(folder_.path(), zone); });
  }
  test::ScratchFolder folder_;
};

TEST_F(ContactPointsOfARun, AreReadWithoutWordsAndWithGaps) {
  write("resultants_fit.csv", "t\n");
  write("contact_fit.csv", "t,node,s,pressure,gap,status\n0.5,N1,0,45,1e-3,sticks\n1,,0.5,46,,open\n");
  const auto points = read_contact_points(folder_.path(), "fit");
  EXPECT_EQ(points.names, (std::vector<std::string>{"s", "pressure", "gap"}));
  EXPECT_EQ(points.t, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(points.columns[1], (std::vector<double>{45, 46}));
  EXPECT_EQ(points.columns[2][0], 1e-3);
  EXPECT_TRUE(std::isnan(points.columns[2][1]));
}

TEST_F(ContactPointsOfARun, AreRefusedWithTheNearestZoneOrTheLine) {
  const auto path = folder_.path().string();
  EXPECT_EQ(fault("fit"), path + ": the run has no contact zone");
  write("resultants_fit.csv", "t\n");
  write("contact_fit.csv", "t,pressure\n");
  EXPECT_EQ(fault("fti"), path + ": no contact zone is called 'fti'; did you mean 'fit'?");
  EXPECT_EQ(fault("fit"), path + "/contact_fit.csv: the table has no line yet");
  write("contact_fit.csv", "t,pressure\n1,2\n2,many\n");
  EXPECT_NE(fault("fit").find("found 'many', expected a number"), std::string::npos) << fault("fit");
  write("contact_fit.csv", "t,pressure\n1\n");
  EXPECT_NE(fault("fit").find("found 1 values, expected 2"), std::string::npos) << fault("fit");
}

} // namespace
} // namespace rubato::plot::contact_points_test
