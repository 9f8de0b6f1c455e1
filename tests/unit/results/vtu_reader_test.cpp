// SPDX-License-Identifier: LGPL-3.0-or-later
// Files that this program wrote, and the other forms that the format allows, made here byte by byte.
#include "rubato/core/base64.hpp"
#include "rubato/mesh/io/vtu_reader.hpp"
#include "rubato/results/vtu.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include "unit/mesh_io/one_cell.hpp"
#include <cstring>
#include <fstream>
#include <zlib.h>

namespace rubato::results::vtu_reader_test {
namespace {

using mesh::vtk::read_pvd;
using mesh::vtk::read_vtu;
using test::fault_of;
using test::ScratchFolder;

template <class T> std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string coded(const std::string& bytes) {
  return to_base64(std::as_bytes(std::span(bytes)));
}

std::string deflated(const std::string& bytes) {
  auto size = compressBound(static_cast<uLong>(bytes.size()));
  std::string smaller(size, '\0');
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(smaller.data()), &size,
                     reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size())),
            Z_OK);
  return smaller.substr(0, size);
}

/// The forms in which an array stands in a file; counts have 32 bits.
std::string plain(const std::string& bytes) {
  return bytes_of(std::vector{static_cast<std::uint32_t>(bytes.size())}) + bytes;
}
/// Counts and blocks of at most 16 bytes.
std::pair<std::string, std::string> in_blocks(const std::string& bytes) {
  constexpr std::size_t block = 16;
  std::vector<std::uint32_t> counts{static_cast<std::uint32_t>((bytes.size() + block - 1) / block), block,
                                    static_cast<std::uint32_t>(bytes.size() % block)};
  std::string blocks;
  for (std::size_t at = 0; at < bytes.size(); at += block) {
    const auto smaller = deflated(bytes.substr(at, block));
    counts.push_back(static_cast<std::uint32_t>(smaller.size()));
    blocks += smaller;
  }
  return {bytes_of(counts), blocks};
}

struct Form {
  std::string format; ///< of each array
  bool compressed = false;
  std::string encoding; ///< of appended data
};

/// A triangle with a temperature and its nodes' numbers, in some form.
class Triangle {
public:
  explicit Triangle(Form form) : form_(std::move(form)) {}

  std::string text() {
    const auto grid = fmt::format(
        "<UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n<PointData>{}{}</PointData>\n"
        "<Points>{}</Points>\n<Cells>{}{}{}</Cells></Piece></UnstructuredGrid>\n",
        array<double>("Float64", "temperature", 1, {20.5, -3.25, 1e-300}),
        array<std::int64_t>("Int64", "node_number", 1, {4, 9, 2}),
        array<float>("Float32", "Points", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0}),
        array<std::int32_t>("Int32", "connectivity", 1, {0, 1, 2}),
        array<std::int64_t>("Int64", "offsets", 1, {3}), array<std::uint8_t>("UInt8", "types", 1, {5}));
    auto file = fmt::format("<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"{}>\n{}",
                            form_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "", grid);
    if (!form_.encoding.empty())
      file +=
          fmt::format("<AppendedData encoding=\"{}\">\n _{}\n</AppendedData>\n", form_.encoding, appended_);
    return file + "</VTKFile>\n";
  }

private:
  std::string form_of(const std::string& bytes, bool as_text) const {
    if (!form_.compressed)
      return as_text ? coded(plain(bytes)) : plain(bytes);
    const auto [counts, blocks] = in_blocks(bytes);
    return as_text ? coded(counts) + coded(blocks) : counts + blocks;
  }

  template <class T>
  std::string array(const std::string& type, const std::string& name, int components, std::vector<T> values) {
    auto tag = fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="{}")", type,
                           name, components, form_.format);
    if (form_.format == "ascii")
      return fmt::format("{}>\n {} \n</DataArray>\n", tag, fmt::join(values, " "));
    if (form_.format == "binary")
      return fmt::format("{}>\n {}\n</DataArray>\n", tag, form_of(bytes_of(values), true));
    tag += fmt::format(" offset=\"{}\"/>\n", appended_.size());
    appended_ += form_of(bytes_of(values), form_.encoding == "base64");
    return tag;
  }

  Form form_;
  std::string appended_;
};

class VtuReader : public testing::Test {
protected:
  mesh::vtk::VtuContent read(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    return read_vtu(path_);
  }
  std::string fault(const std::string& text) const {
    const auto found = fault_of([&] { read(text); });
    return found.starts_with(path_.string() + ": ") ? found.substr(path_.string().size() + 2) : found;
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "fields.vtu";
};

TEST_F(VtuReader, OfThisProgramComesBackWithEveryKindOfCell) {
  for (const auto& shape : cell::all_topologies()) {
    const auto mesh = test::one_cell(shape.type, 3);
    std::vector<double> values;
    for (std::size_t i = 0; i < 3 * mesh.points.size(); ++i)
      values.push_back(0.1 * static_cast<double>(i));
    const std::vector<results::NodalField> fields{
        {"shift", 3, values, {"x", "y", "z"}, ""},
        {"level", 1, std::span(values).first(mesh.points.size()), {}, ""}};
    results::write_vtu(path_, mesh, fields);
    const auto content = read_vtu(path_);
    EXPECT_EQ(content.mesh.points, mesh.points);
    EXPECT_EQ(content.mesh.node_numbers, mesh.node_numbers);
    ASSERT_EQ(content.mesh.blocks.size(), 1U) << shape.name;
    EXPECT_EQ(content.mesh.blocks[0].type, shape.type);
    EXPECT_EQ(content.mesh.blocks[0].nodes, mesh.blocks[0].nodes) << shape.name;
    EXPECT_EQ(content.mesh.dimension, shape.dimension);
    ASSERT_EQ(content.arrays.size(), 2U) << "without node_number";
    EXPECT_EQ(content.arrays[0].values, values);
    EXPECT_EQ(content.arrays[0].component_names, (std::vector<std::string>{"x", "y", "z"}));
    EXPECT_EQ(content.arrays[1].name, "level");
    EXPECT_EQ(content.arrays[1].component_names, std::vector<std::string>{""});
  }
}

TEST_F(VtuReader, IsReadInEveryForm) {
  for (const auto& form : {Form{"ascii", false, ""}, Form{"binary", false, ""}, Form{"binary", true, ""},
                           Form{"appended", false, "raw"}, Form{"appended", true, "raw"},
                           Form{"appended", false, "base64"}, Form{"appended", true, "base64"}}) {
    SCOPED_TRACE(form.format + " " + form.encoding + (form.compressed ? " compressed" : ""));
    const auto content = read(Triangle(form).text());
    ASSERT_EQ(content.arrays.size(), 1U) << "without node_number";
    EXPECT_EQ(content.arrays[0].values, (std::vector<double>{20.5, -3.25, 1e-300}));
    EXPECT_EQ(content.mesh.node_numbers, (std::vector<std::int64_t>{4, 9, 2}));
    EXPECT_EQ(content.mesh.points[2], Eigen::Vector3d(0, 1, 0));
    EXPECT_EQ(content.mesh.blocks.at(0).type, CellType::tria3);
    EXPECT_EQ(content.mesh.dimension, 2);
  }
}

TEST_F(VtuReader, ThatIsCutShortIsRefusedWhereverItEnds) {
  for (const auto& form :
       {Form{"binary", true, ""}, Form{"appended", true, "raw"}, Form{"appended", false, "base64"}}) {
    const auto whole = Triangle(form).text();
    const auto data = whole.find("</Cells>");
    for (std::size_t size = 0; size < whole.size(); size += 7) {
      const auto said = fault(whole.substr(0, size));
      EXPECT_TRUE(size >= data || said != "nothing thrown") << size;
    }
  }
}

TEST_F(VtuReader, SaysWhatIsWrongWithIt) {
  const auto text = Triangle({"ascii", false, ""}).text();
  const auto with = [&](const std::string& word, const std::string& other) {
    auto changed = text;
    return changed.replace(changed.find(word), word.size(), other);
  };
  EXPECT_EQ(fault(with("20.5", "warm")), "found a word that is no number");
  EXPECT_EQ(fault(with(" 0 1 2 ", " 0 1 3 ")), "a cell has a node that does not exist");
  EXPECT_EQ(fault(with(" 5 ", " 42 ")), "found cells of VTK's type 42, which rubato does not know");
  EXPECT_EQ(fault(with("\"UnstructuredGrid\"", "\"PolyData\"")),
            "found a file of type 'PolyData', expected 'UnstructuredGrid'");
  EXPECT_EQ(fault(with("20.5 ", "")), "'temperature' has 2 values for 3 nodes of 1 components");
  EXPECT_EQ(fault(with("LittleEndian", "BigEndian")), "its bytes are BigEndian, expected LittleEndian");
  EXPECT_EQ(fault(with("byte_order", "compressor=\"vtkLZMADataCompressor\" byte_order")),
            "compressed by vtkLZMADataCompressor, expected vtkZLibDataCompressor");
}

TEST_F(VtuReader, SeriesAreReadWithTheirTimes) {
  results::PvdSeries series(folder_ / "fields.pvd");
  series.add(0.25, folder_ / "fields/000001.vtu");
  series.add(0.5, folder_ / "fields/a & b.vtu");
  const auto entries = read_pvd(folder_ / "fields.pvd");
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].time, 0.25);
  EXPECT_EQ(entries[1].file, folder_ / "fields/a & b.vtu");
  EXPECT_TRUE(read_pvd(folder_ / "none.pvd").empty());
}

} // namespace
} // namespace rubato::results::vtu_reader_test
