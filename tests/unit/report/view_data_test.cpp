// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/packing.hpp"
#include "rubato/report/quantise.hpp"
#include "rubato/report/view_data.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "unit/mesh_io/one_cell.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::report::view_data_test {
namespace {

/// A strip of many quadrangles with a displacement and a rough scalar.
results::StoredFields strip(std::size_t instants) {
  constexpr int cells = 400;
  results::StoredFields stored;
  stored.mesh.dimension = 2;
  mesh::CellBlock block{CellType::quad4, {}, {}};
  for (int i = 0; i <= cells; ++i) {
    stored.mesh.points.emplace_back(i, 0, 0);
    stored.mesh.points.emplace_back(i, 1, 0);
    if (i < cells)
      block.nodes.insert(block.nodes.end(), {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  stored.mesh.blocks = {block};
  for (std::size_t i = 0; i < stored.mesh.points.size(); ++i)
    stored.mesh.node_numbers.push_back(static_cast<std::int64_t>(100 + i));
  for (std::size_t i = 0; i < instants; ++i)
    stored.instants.push_back(0.5 * static_cast<double>(i));
  stored.fields = {{"displacement", {"x", "y"}}, {"von_mises", {""}}, {"contact_gap", {""}}};
  stored.values_at = [nodes = stored.mesh.points.size()](std::size_t instant) {
    std::vector<double> shift;
    std::vector<double> rough;
    std::vector<double> gap(nodes, 0.0);
    gap[7] = instant == 1 ? 0.25 : 0.0;
    for (std::size_t i = 0; i < nodes; ++i) {
      shift.insert(shift.end(),
                   {0.001 * static_cast<double>(i * instant), std::sin(static_cast<double>(i + instant))});
      rough.push_back(std::sin(1e5 * static_cast<double>((i + 1) * (instant + 3))));
    }
    return std::vector<std::vector<double>>{shift, rough, gap};
  };
  return stored;
}

std::string text_of(const ViewData& data, const std::string& name) {
  const auto found = std::ranges::find(data.blobs, name, &Blob::name);
  return found == data.blobs.end() ? "none" : found->text;
}

std::size_t size_of(const ViewData& data) {
  std::size_t size = 0;
  for (const auto& blob : data.blobs)
    size += blob.text.size();
  return size;
}

constexpr std::size_t ample = 100'000'000;

TEST(ViewData, HasEveryFieldAndInstantWhereThereIsRoom) {
  const auto data = view_data(strip(4), "r0", ample);
  const auto& about = data.description;
  EXPECT_EQ(data.shown_instants, 4U);
  EXPECT_EQ(about.at("instants").size(), 4U);
  EXPECT_EQ(about.at("drawn_nodes"), 802);
  EXPECT_EQ(about.at("cells").at("QUAD4"), 400);
  for (const auto& field : about.at("fields"))
    EXPECT_EQ(field.at("levels"), finest_levels);
  EXPECT_EQ(about.at("ranges").size(), 3U);
  EXPECT_EQ(about.at("ranges").at(0).at(3).size(), 2U) << "two components";
  EXPECT_NE(text_of(data, "r0f2i3"), "none");
}

TEST(ViewData, OfAFieldAreItsQuantisedComponentsOneAfterAnother) {
  const auto stored = strip(2);
  const auto data = view_data(stored, "r0", ample);
  const auto values = stored.values_at(1)[0];
  std::vector<std::uint16_t> numbers;
  for (std::size_t c = 0; c < 2; ++c) {
    std::vector<double> component;
    for (std::size_t i = c; i < values.size(); i += 2)
      component.push_back(values[i]);
    const auto quantised = quantise(component);
    EXPECT_EQ(data.description.at("ranges").at(0).at(1).at(c).at(0), quantised.least);
    EXPECT_EQ(data.description.at("ranges").at(0).at(1).at(c).at(1), quantised.step);
    numbers.insert(numbers.end(), quantised.numbers.begin(), quantised.numbers.end());
  }
  EXPECT_EQ(text_of(data, "r0f0i1"), packed(numbers));
}

TEST(ViewData, NameTheNodesThatContactHasEverTouched) {
  const auto data = view_data(strip(2), "r0", ample);
  EXPECT_EQ(text_of(data, "r0contact"), packed(std::vector<std::uint32_t>{7}));
}

TEST(ViewData, MakeOtherFieldsThanTheDisplacementCoarserFirst) {
  const auto whole = size_of(view_data(strip(12), "r0", ample));
  const auto data = view_data(strip(12), "r0", whole * 9 / 10);
  EXPECT_EQ(data.shown_instants, 12U);
  EXPECT_LE(size_of(data), whole * 9 / 10);
  EXPECT_EQ(data.description.at("fields").at(0).at("levels"), finest_levels);
  EXPECT_LT(data.description.at("fields").at(1).at("levels"), finest_levels);
}

TEST(ViewData, LeaveInstantsOutThenButNotTheLast) {
  const auto whole = size_of(view_data(strip(12), "r0", ample));
  for (const auto part : {4, 6}) {
    const auto room = whole / static_cast<std::size_t>(part);
    const auto data = view_data(strip(12), "r0", room);
    EXPECT_LE(size_of(data), room);
    EXPECT_LT(data.shown_instants, 12U);
    EXPECT_GE(data.shown_instants, 2U);
    EXPECT_EQ(data.stored_instants, 12U);
    EXPECT_EQ(data.description.at("instants").front(), 0.0);
    EXPECT_EQ(data.description.at("instants").back(), 5.5);
  }
}

} // namespace
} // namespace rubato::report::view_data_test
