// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/vtu.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include "unit/mesh_io/one_cell.hpp"
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <zlib.h>

namespace rubato::results::vtu_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A .vtu file taken apart: attributes of each array, and the bytes it points to.
class Parsed {
public:
  explicit Parsed(const std::filesystem::path& path) : text_(text_of(path)) {
    const std::string mark = "<AppendedData encoding=\"raw\">\n_";
    const auto start = text_.find(mark);
    EXPECT_NE(start, std::string::npos);
    data_ = text_.substr(start + mark.size());
    head_ = text_.substr(0, start);
    for (auto at = head_.find(opening); at != std::string::npos; at = head_.find(opening, at + 1)) {
      const auto tag = head_.substr(at, head_.find("/>", at) - at);
      EXPECT_EQ(attribute(tag, "format"), "appended");
      offsets_[attribute(tag, "Name")] = std::stoul(attribute(tag, "offset"));
      components_[attribute(tag, "Name")] = std::stoi(attribute(tag, "NumberOfComponents"));
    }
  }

  template <class T> std::vector<T> values(const std::string& name) const {
    const auto head = head_at(offsets_.at(name));
    std::string bytes;
    auto next = offsets_.at(name) + (3 + head.at(0)) * sizeof head[0];
    for (std::uint64_t piece = 0; piece < head.at(0); ++piece) {
      const bool shorter = piece + 1 == head.at(0) && head.at(2) > 0;
      std::string whole(shorter ? head.at(2) : head.at(1), '\0');
      auto size = static_cast<uLongf>(whole.size());
      EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(whole.data()), &size,
                           reinterpret_cast<const Bytef*>(data_.data() + next), head.at(3 + piece)),
                Z_OK);
      EXPECT_EQ(size, whole.size()) << name;
      bytes += whole;
      next += head.at(3 + piece);
    }
    std::vector<T> found(bytes.size() / sizeof(T));
    std::memcpy(found.data(), bytes.data(), bytes.size());
    return found;
  }

  /// Whether the blocks follow each other without gap and the document ends after the last one.
  bool blocks_fill_the_data() const {
    std::vector<std::size_t> starts;
    for (const auto& [name, at] : offsets_)
      starts.push_back(at);
    std::ranges::sort(starts);
    std::size_t next = 0;
    for (const auto at : starts) {
      if (at != next)
        return false;
      const auto head = head_at(at);
      next =
          at + head.size() * sizeof head[0] + std::accumulate(head.begin() + 3, head.end(), std::size_t{0});
    }
    return data_.substr(next) == "\n</AppendedData>\n</VTKFile>\n";
  }

  /// How many pieces an array is compressed in.
  std::uint64_t pieces(const std::string& name) const { return head_at(offsets_.at(name)).at(0); }
  std::size_t size() const { return text_.size(); }
  bool has(const std::string& name) const { return offsets_.contains(name); }
  int components(const std::string& name) const { return components_.at(name); }
  const std::string& head() const { return head_; }

private:
  static constexpr const char* opening = "<DataArray ";

  /// Of a compressed array: pieces, size of one, of the last, and the compressed size of each.
  std::vector<std::uint64_t> head_at(std::size_t at) const {
    std::vector<std::uint64_t> head(3);
    std::memcpy(head.data(), data_.data() + at, 3 * sizeof head[0]);
    head.resize(3 + head[0]);
    std::memcpy(head.data(), data_.data() + at, head.size() * sizeof head[0]);
    return head;
  }

  static std::string attribute(const std::string& tag, const std::string& name) {
    const auto start = tag.find(" " + name + "=\"") + name.size() + 3;
    return tag.substr(start, tag.find('"', start) - start);
  }

  std::string text_;
  std::string head_;
  std::string data_;
  std::map<std::string, std::size_t> offsets_;
  std::map<std::string, int> components_;
};

/// A quadrangle of nine nodes and a triangle of seven beside it, with one edge.
mesh::Mesh flat_mesh() {
  mesh::Mesh mesh;
  mesh.dimension = 2;
  for (int i = 0; i < 13; ++i)
    mesh.points.emplace_back(i, 0.5 * i, 0.0);
  mesh.node_numbers = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 130};
  mesh.blocks = {{CellType::seg3, {0, 1, 4}, {1}},
                 {CellType::tria7, {1, 9, 2, 10, 11, 5, 12}, {3}},
                 {CellType::quad9, {0, 1, 2, 3, 4, 5, 6, 7, 8}, {2}}};
  return mesh;
}

TEST(VtuFile, HoldsTheCellsOfHighestDimensionWithVtksTypes) {
  const ScratchFolder folder;
  const auto mesh = flat_mesh();
  write_vtu(folder / "a.vtu", mesh, {});
  const Parsed file(folder / "a.vtu");
  EXPECT_NE(file.head().find("NumberOfPoints=\"13\" NumberOfCells=\"2\""), std::string::npos);
  EXPECT_EQ(file.values<std::uint8_t>("types"), (std::vector<std::uint8_t>{34, 28}));
  EXPECT_EQ(file.values<std::int64_t>("offsets"), (std::vector<std::int64_t>{7, 16}));
  EXPECT_EQ(file.values<std::int32_t>("connectivity"),
            (std::vector<std::int32_t>{1, 9, 2, 10, 11, 5, 12, 0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(file.values<std::int64_t>("cell_number"), (std::vector<std::int64_t>{3, 2}));
  EXPECT_EQ(file.values<std::int64_t>("node_number"), mesh.node_numbers);
  EXPECT_EQ(file.values<double>("Points").at(3 * 5 + 1), 2.5);
  EXPECT_TRUE(file.blocks_fill_the_data());
}

TEST(VtuFile, HoldsEveryCellWhenAsked) {
  const ScratchFolder folder;
  write_vtu(folder / "a.vtu", flat_mesh(), {}, {.displacement = {}, .all_cells = true});
  EXPECT_EQ(Parsed(folder / "a.vtu").values<std::uint8_t>("types"), (std::vector<std::uint8_t>{21, 34, 28}));
}

TEST(VtuFile, KnowsVtksNumberOfEveryCellType) {
  const ScratchFolder folder;
  const std::map<std::string_view, int> expected{
      {"POINT1", 1},   {"SEG2", 3},     {"SEG3", 21},   {"TRIA3", 5},   {"TRIA6", 22},
      {"TRIA7", 34},   {"QUAD4", 9},    {"QUAD8", 23},  {"QUAD9", 28},  {"TETRA4", 10},
      {"TETRA10", 24}, {"PYRA5", 14},   {"PYRA13", 27}, {"PENTA6", 13}, {"HEXA8", 12},
      {"PENTA15", 26}, {"PENTA18", 32}, {"HEXA20", 25}, {"HEXA27", 29}};
  for (const auto& cell : cell::all_topologies()) {
    mesh::Mesh mesh;
    const auto nodes = static_cast<std::size_t>(cell.node_count);
    mesh.points.assign(nodes, Eigen::Vector3d::Zero());
    mesh.blocks = {{cell.type, std::vector<mesh::NodeIndex>(nodes, 0), {}}};
    write_vtu(folder / "a.vtu", mesh, {});
    EXPECT_EQ(Parsed(folder / "a.vtu").values<std::uint8_t>("types").at(0), expected.at(cell.name))
        << cell.name;
  }
}

/// A solid as VTK documents its nodes: faces whose normals point outward by the right hand rule, edges in the
/// order of the nodes in their middles, then the faces (by corners) in the order of the nodes in their
/// middles.
struct VtkSolid {
  int type;
  std::vector<std::vector<int>> faces;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> faces_with_middles;
};

VtkSolid vtk_solid(int type) {
  const std::vector<std::vector<int>> tetra_faces{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  const std::vector<std::vector<int>> pyramid_faces{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const std::vector<std::vector<int>> wedge_faces{
      {0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  const std::vector<std::vector<int>> hexa_faces{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                                 {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  const std::vector<std::array<int, 2>> tetra_edges{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  const std::vector<std::array<int, 2>> pyramid_edges{{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                                      {0, 4}, {1, 4}, {2, 4}, {3, 4}};
  const std::vector<std::array<int, 2>> wedge_edges{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                                    {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  const std::vector<std::array<int, 2>> hexa_edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                                   {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  const std::vector<VtkSolid> solids{
      {10, tetra_faces, {}, {}},
      {24, tetra_faces, tetra_edges, {}},
      {14, pyramid_faces, {}, {}},
      {27, pyramid_faces, pyramid_edges, {}},
      {13, wedge_faces, {}, {}},
      {26, wedge_faces, wedge_edges, {}},
      {32, wedge_faces, wedge_edges, {wedge_faces.begin() + 2, wedge_faces.end()}},
      {12, hexa_faces, {}, {}},
      {25, hexa_faces, hexa_edges, {}},
      {29, hexa_faces, hexa_edges, hexa_faces}};
  return *std::ranges::find(solids, type, &VtkSolid::type);
}

/// The points of the only cell of a file, in the order of its nodes there.
test::Points cell_points(const Parsed& file) {
  const auto flat = file.values<double>("Points");
  test::Points points;
  for (const auto node : file.values<std::int32_t>("connectivity"))
    points.emplace_back(Eigen::Map<const Eigen::Vector3d>(&flat[3 * static_cast<std::size_t>(node)]));
  return points;
}

double volume_within(const std::vector<std::vector<int>>& faces, const test::Points& points) {
  double six_volumes = 0;
  for (const auto& face : faces)
    for (std::size_t i = 2; i < face.size(); ++i) {
      const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(face[k])]; };
      six_volumes += at(0).dot(at(i - 1).cross(at(i)));
    }
  return six_volumes / 6;
}

TEST(VtuFile, HasSolidsOfPositiveVolumeWithTheirMiddlesWhereVtkHasThem) {
  const ScratchFolder folder;
  for (const auto& cell : cell::all_topologies()) {
    if (cell.dimension < 3)
      continue;
    SCOPED_TRACE(cell.name);
    const auto mesh = test::one_cell(cell.type, 3);
    write_vtu(folder / "a.vtu", mesh, {});
    const Parsed file(folder / "a.vtu");
    const auto solid = vtk_solid(file.values<std::uint8_t>("types").at(0));
    const auto points = cell_points(file);
    EXPECT_NEAR(volume_within(solid.faces, points), test::measure(cell.type, mesh.points), 1e-14);
    EXPECT_GT(volume_within(solid.faces, points), 0.1);
    auto next = points.begin() + cell.corner_count;
    for (const auto& edge : solid.edges)
      EXPECT_LT((*next++ - test::mean_of(points, edge, 2)).norm(), 1e-15);
    for (const auto& face : solid.faces_with_middles)
      EXPECT_LT((*next++ - test::mean_of(points, face, 4)).norm(), 1e-15);
  }
}

TEST(VtuFile, PadsVectorsOfThePlaneToThreeComponents) {
  const ScratchFolder folder;
  std::vector<double> u(26);
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = static_cast<double>(i);
  const std::vector<double> p(13, 4.0);
  const std::array fields{NodalField{"displacement", 2, u, {"DX", "DY"}, "m"},
                          NodalField{"pressure <x & \"y\">", 1, p, {}, "Pa"}};
  write_vtu(folder / "a.vtu", flat_mesh(), fields);
  const Parsed file(folder / "a.vtu");
  EXPECT_EQ(file.components("displacement"), 3);
  const auto values = file.values<double>("displacement");
  ASSERT_EQ(values.size(), 39U);
  EXPECT_EQ((std::vector<double>(values.begin() + 3, values.begin() + 9)),
            (std::vector<double>{2, 3, 0, 4, 5, 0}));
  EXPECT_NE(file.head().find(R"(ComponentName1="DY" ComponentName2="z")"), std::string::npos);
  EXPECT_EQ(file.values<double>("pressure &lt;x &amp; &quot;y&quot;&gt;"), p);
  EXPECT_TRUE(file.blocks_fill_the_data());
}

/// A grid with more than one piece of coordinates, and values that no rounding shortens.
mesh::Mesh many_nodes(int count) {
  mesh::Mesh mesh;
  mesh.dimension = 2;
  for (int i = 0; i < count; ++i)
    mesh.points.emplace_back(0.001 * i, 0.0, 0.0);
  mesh.blocks = {{CellType::tria3, {0, 1, 2}, {}}};
  return mesh;
}

std::vector<double> roots(int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(i % 2 == 0 ? std::sqrt(2.0 + i) : -1e-9 * std::cbrt(i));
  return values;
}

TEST(VtuFile, CompressesLongArraysInPieces) {
  const ScratchFolder folder;
  constexpr int count = 40'000;
  const auto values = roots(count);
  const std::array fields{NodalField{"root", 1, values, {}, ""}};
  write_vtu(folder / "a.vtu", many_nodes(count), fields);
  const Parsed file(folder / "a.vtu");
  EXPECT_EQ(file.pieces("root"), 2U);
  EXPECT_EQ(file.pieces("Points"), 4U);
  EXPECT_EQ(file.values<double>("root"), values);
  EXPECT_TRUE(file.blocks_fill_the_data());
}

TEST(VtuFile, KeepsTheDigitsItIsTold) {
  const ScratchFolder folder;
  constexpr int count = 5'000;
  auto values = roots(count);
  values[7] = std::numeric_limits<double>::infinity();
  values[8] = std::numeric_limits<double>::max();
  values[9] = 0;
  const std::array fields{NodalField{"root", 1, values, {}, ""}};
  std::map<int, std::size_t> sizes;
  for (const int digits : {6, 9, 15, 17}) {
    write_vtu(folder / "a.vtu", many_nodes(count), fields, {.digits = digits});
    const Parsed file(folder / "a.vtu");
    sizes[digits] = file.size();
    const auto kept = file.values<double>("root");
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (std::isfinite(values[i]))
        EXPECT_LE(std::abs(kept[i] - values[i]), 0.5 * std::pow(10, -digits) * std::abs(values[i])) << i;
      else
        EXPECT_EQ(kept[i], values[i]);
    EXPECT_EQ(kept == values, digits == 17);
  }
  EXPECT_LT(sizes[6], sizes[9]);
  EXPECT_LT(sizes[9], sizes[15]);
}

TEST(VtuFile, TellsWhichGroupsNodesAndCellsBelongTo) {
  const ScratchFolder folder;
  auto mesh = flat_mesh();
  mesh.node_groups = {{"corner", {0, 12}}, {"both", {3}}};
  mesh.cell_groups = {{"edge", {0}}, {"round", {2}}, {"mixed", {0, 1}}, {"both", {0}}};
  write_vtu(folder / "a.vtu", mesh, {});
  const Parsed file(folder / "a.vtu");
  using Marks = std::vector<std::uint8_t>;
  EXPECT_EQ(file.values<std::uint8_t>("group_corner"), (Marks{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(file.values<std::uint8_t>("group_edge"), (Marks{1, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(file.values<std::uint8_t>("group_round"), (Marks{0, 1}));
  EXPECT_EQ(file.values<std::uint8_t>("group_both"), (Marks{0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}))
      << "the nodes' one";
  const auto mixed = file.head().find("Name=\"group_mixed\"");
  EXPECT_LT(mixed, file.head().find("</PointData>")) << "its edge shows at nodes";
  EXPECT_NE(file.head().find("Name=\"group_mixed\"", mixed + 1), std::string::npos) << "its triangle";
}

TEST(VtuFile, HoldsFieldsInCellsAsTheirMeans) {
  const ScratchFolder folder;
  const CellField stress{"stress_elga",
                         1,
                         {},
                         study::FieldPlace::gauss_points,
                         {{CellType::tria7, 2, {1, 4}}, {CellType::quad9, 3, {6, 6, 9}}},
                         {2, 1, 1, 1, 2}};
  const CellField nodal{"stress_elno",
                        2,
                        {"a", "b"},
                        study::FieldPlace::element_nodes,
                        {{CellType::tria7, 2, {1, 10, 3, 30}}, {CellType::quad9, 1, {7, 70}}},
                        {}};
  write_vtu(folder / "a.vtu", flat_mesh(), {}, {.cell_fields = std::array{stress, nodal}});
  const Parsed file(folder / "a.vtu");
  EXPECT_EQ(file.values<double>("stress_elga"), (std::vector<double>{2, 7.5})) << "over the volume";
  EXPECT_EQ(file.values<double>("stress_elno"), (std::vector<double>{2, 20, 7, 70}));
  EXPECT_GT(file.head().find("stress_elno"), file.head().find("<CellData>"));
}

TEST(VtuFile, ShowsTheDeformedShapeWhenGivenDisplacements) {
  const ScratchFolder folder;
  const std::vector<double> u(26, 0.25);
  write_vtu(folder / "a.vtu", flat_mesh(), {}, {.displacement = u});
  const auto points = Parsed(folder / "a.vtu").values<double>("Points");
  EXPECT_EQ((std::vector<double>(points.begin() + 3, points.begin() + 6)),
            (std::vector<double>{1.25, 0.75, 0.0}));
}

TEST(VtuFile, RefusesWhatDoesNotFit) {
  const ScratchFolder folder;
  const std::vector<double> few(5);
  const std::array fields{NodalField{"u", 2, few, {}, ""}};
  EXPECT_THROW(write_vtu(folder / "a.vtu", flat_mesh(), fields), std::invalid_argument);
  EXPECT_THROW(write_vtu(folder / "a.vtu", flat_mesh(), {}, {.displacement = few}), std::invalid_argument);
  EXPECT_NE(fault_of([&] { write_vtu(folder / "no/a.vtu", flat_mesh(), {}); }).find("cannot be written"),
            std::string::npos);
}

TEST(PvdSeries, IsCompleteAfterEachAddition) {
  const ScratchFolder folder;
  PvdSeries series(folder / "run.pvd");
  EXPECT_FALSE(std::filesystem::exists(folder / "run.pvd"));
  series.add(0.0, folder / "fields/0.vtu");
  EXPECT_EQ(text_of(folder / "run.pvd"), "<?xml version=\"1.0\"?>\n"
                                         "<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n"
                                         "<DataSet timestep=\"0\" part=\"0\" file=\"fields/0.vtu\"/>\n"
                                         "</Collection>\n</VTKFile>\n");
  series.add(0.001, folder / "fields/1.vtu");
  EXPECT_NE(text_of(folder / "run.pvd").find("timestep=\"0.001\" part=\"0\" file=\"fields/1.vtu\""),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "run.pvd.new"));
}

TEST(PvdSeries, ShowsInstantsWithoutWhatRoundingAdds) {
  const ScratchFolder folder;
  PvdSeries series(folder / "run.pvd");
  double time = 0;
  for (int step = 0; step < 9; ++step)
    time += 0.001;
  ASSERT_NE(time, 0.009);
  series.add(time, folder / "fields/9.vtu");
  EXPECT_NE(text_of(folder / "run.pvd").find("timestep=\"0.009\""), std::string::npos);
  series.add(1.0 / 3.0, folder / "fields/10.vtu");
  EXPECT_NE(text_of(folder / "run.pvd").find("timestep=\"0.333333333333\""), std::string::npos);
}

TEST(PvdSeries, GoesOnFromWhatWasThere) {
  const ScratchFolder folder;
  PvdSeries series(folder / "run.pvd", {{0.0, "0.vtu"}});
  series.add(1.0, folder / "1.vtu");
  const auto text = text_of(folder / "run.pvd");
  EXPECT_LT(text.find("0.vtu"), text.find("1.vtu"));
  EXPECT_EQ(series.entries().size(), 2U);
  PvdSeries nowhere(folder / "no/run.pvd");
  EXPECT_NE(fault_of([&] { nowhere.add(0.0, "0.vtu"); }).find("cannot be written"), std::string::npos);
}

} // namespace
} // namespace rubato::results::vtu_test
