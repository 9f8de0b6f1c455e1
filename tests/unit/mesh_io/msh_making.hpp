// SPDX-License-Identifier: LGPL-3.0-or-later
/// .msh files of every kind, written by the Gmsh reference manual's words on the format alone.
#pragma once

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace rubato::test {

struct MshKind {
  int version = 4; ///< 2: 2.2, 4: 4.1
  bool binary = false;
  bool swapped = false; ///< the other byte order
  std::string name() const {
    return std::string(version == 2 ? "Version2" : "Version4") + (binary ? "Binary" : "Text") +
           (swapped ? "Swapped" : "");
  }
};

inline const std::vector<MshKind> all_msh_kinds{{2, false, false}, {2, true, false}, {2, true, true},
                                                {4, false, false}, {4, true, false}, {4, true, true}};

/// Cells of one type on one piece of the geometry.
struct MshCells {
  int dimension;
  int entity;
  int type; ///< Gmsh's number
  std::vector<std::int64_t> tags;
  std::vector<std::vector<std::int64_t>> nodes; ///< of each cell
};

struct MshSample {
  std::vector<std::pair<std::int64_t, Eigen::Vector3d>> nodes;
  std::vector<MshCells> cells;
  std::map<std::pair<int, int>, std::vector<int>> physicals; ///< of (dimension, entity)
  std::map<std::pair<int, int>, std::string> names;          ///< of (dimension, physical group)
  bool parametric = false; ///< nodes with parameters, as on a surface with tag 1
};

/// Writes numbers as the kind wants them.
class MshWriting {
public:
  explicit MshWriting(MshKind kind) : kind_(kind) {}

  MshWriting& text(const std::string& words) {
    bytes_ += words;
    return *this;
  }
  MshWriting& integer(std::int64_t value) { return number(static_cast<std::int32_t>(value), value); }
  MshWriting& size(std::int64_t value) { return number(value, value); }
  MshWriting& real(double value) { return number(value, value); }
  /// The end of a line of numbers.
  MshWriting& end() { return kind_.binary ? *this : text("\n"); }

  const std::string& bytes() const { return bytes_; }

private:
  template <class Raw, class Shown> MshWriting& number(Raw raw, Shown shown) {
    if (!kind_.binary)
      return text(fmt::format("{} ", shown));
    auto bytes = std::bit_cast<std::array<char, sizeof(Raw)>>(raw);
    if (kind_.swapped)
      std::ranges::reverse(bytes);
    bytes_.append(bytes.data(), bytes.size());
    return *this;
  }

  MshKind kind_;
  std::string bytes_;
};

inline std::string msh_head(MshKind kind) {
  MshWriting out(kind);
  out.text(fmt::format("$MeshFormat\n{} {} 8\n", kind.version == 2 ? "2.2" : "4.1", kind.binary ? 1 : 0));
  if (kind.binary)
    out.integer(1).text("\n");
  return out.bytes() + "$EndMeshFormat\n";
}

inline std::string msh_names(const MshSample& sample) {
  auto text = fmt::format("$PhysicalNames\n{}\n", sample.names.size());
  for (const auto& [group, name] : sample.names)
    text += fmt::format("{} {} \"{}\"\n", group.first, group.second, name);
  return text + "$EndPhysicalNames\n";
}

inline std::vector<int> msh_groups_of(const MshSample& sample, const MshCells& cells) {
  const auto found = sample.physicals.find({cells.dimension, cells.entity});
  return found == sample.physicals.end() ? std::vector<int>{} : found->second;
}

inline std::string msh_nodes_2(const MshSample& sample, MshKind kind) {
  const std::string section = sample.parametric ? "ParametricNodes" : "Nodes";
  MshWriting out(kind);
  out.text(fmt::format("${}\n{}\n", section, sample.nodes.size()));
  for (const auto& [tag, point] : sample.nodes) {
    out.integer(tag).real(point.x()).real(point.y()).real(point.z());
    if (sample.parametric)
      out.integer(2).integer(1).real(0.25).real(0.75);
    out.end();
  }
  return out.bytes() + fmt::format("{}$End{}\n", kind.binary ? "\n" : "", section);
}

/// A cell once for each of its physical groups, numbered on; with two tags about partitions.
inline std::string msh_cells_2(const MshSample& sample, MshKind kind) {
  MshWriting out(kind);
  std::size_t count = 0;
  std::map<std::int64_t, bool> known;
  std::int64_t next = 100000;
  for (const auto& cells : sample.cells) {
    auto groups = msh_groups_of(sample, cells);
    if (groups.empty())
      groups.push_back(0);
    for (const auto group : groups) {
      if (kind.binary)
        out.integer(cells.type).integer(static_cast<std::int64_t>(cells.tags.size())).integer(4);
      for (std::size_t i = 0; i < cells.tags.size(); ++i) {
        out.integer(group == groups.front() ? cells.tags[i] : next++);
        if (!kind.binary)
          out.integer(cells.type).integer(4);
        out.integer(group).integer(cells.entity).integer(1).integer(1);
        for (const auto node : cells.nodes[i])
          out.integer(node);
        out.end();
        ++count;
      }
    }
  }
  return fmt::format("$Elements\n{}\n", count) + out.bytes() +
         fmt::format("{}$EndElements\n", kind.binary ? "\n" : "");
}

inline std::string msh_entities_4(const MshSample& sample, MshKind kind) {
  MshWriting out(kind);
  std::array<std::vector<int>, 4> tags;
  for (const auto& [entity, groups] : sample.physicals)
    tags[static_cast<std::size_t>(entity.first)].push_back(entity.second);
  for (const auto& of_dimension : tags)
    out.size(static_cast<std::int64_t>(of_dimension.size()));
  out.end();
  for (int dimension = 0; dimension < 4; ++dimension)
    for (const auto tag : tags[static_cast<std::size_t>(dimension)]) {
      out.integer(tag);
      for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i)
        out.real(0.5 * i);
      const auto& groups = sample.physicals.at({dimension, tag});
      out.size(static_cast<std::int64_t>(groups.size()));
      for (const auto group : groups)
        out.integer(group);
      if (dimension > 0)
        out.size(2).integer(1).integer(-2);
      out.end();
    }
  return "$Entities\n" + out.bytes() + fmt::format("{}$EndEntities\n", kind.binary ? "\n" : "");
}

/// The nodes in two blocks.
inline std::string msh_nodes_4(const MshSample& sample, MshKind kind) {
  MshWriting out(kind);
  const auto total = sample.nodes.size();
  out.size(2).size(static_cast<std::int64_t>(total)).size(1).size(std::int64_t{1} << 40).end();
  const std::array<std::size_t, 3> bounds{0, total / 2, total};
  for (std::size_t block = 0; block < 2; ++block) {
    const auto first = bounds[block];
    const auto last = bounds[block + 1];
    out.integer(2)
        .integer(1)
        .integer(sample.parametric ? 1 : 0)
        .size(static_cast<std::int64_t>(last - first))
        .end();
    for (auto i = first; i < last; ++i)
      out.size(sample.nodes[i].first).end();
    for (auto i = first; i < last; ++i) {
      const auto& point = sample.nodes[i].second;
      out.real(point.x()).real(point.y()).real(point.z());
      if (sample.parametric)
        out.real(0.25).real(0.75);
      out.end();
    }
  }
  return "$Nodes\n" + out.bytes() + fmt::format("{}$EndNodes\n", kind.binary ? "\n" : "");
}

inline std::string msh_cells_4(const MshSample& sample, MshKind kind) {
  MshWriting out(kind);
  std::size_t count = 0;
  for (const auto& cells : sample.cells)
    count += cells.tags.size();
  out.size(static_cast<std::int64_t>(sample.cells.size()))
      .size(static_cast<std::int64_t>(count))
      .size(1)
      .size(9999);
  out.end();
  for (const auto& cells : sample.cells) {
    out.integer(cells.dimension).integer(cells.entity).integer(cells.type);
    out.size(static_cast<std::int64_t>(cells.tags.size())).end();
    for (std::size_t i = 0; i < cells.tags.size(); ++i) {
      out.size(cells.tags[i]);
      for (const auto node : cells.nodes[i])
        out.size(node);
      out.end();
    }
  }
  return "$Elements\n" + out.bytes() + fmt::format("{}$EndElements\n", kind.binary ? "\n" : "");
}

inline std::string msh_bytes(const MshSample& sample, MshKind kind) {
  const auto head = msh_head(kind) + (sample.names.empty() ? "" : msh_names(sample));
  if (kind.version == 2)
    return head + msh_nodes_2(sample, kind) + msh_cells_2(sample, kind);
  return head + msh_entities_4(sample, kind) + msh_nodes_4(sample, kind) + msh_cells_4(sample, kind);
}

/// Two cubes side by side on nodes with tags that have gaps and no order, one node of nothing; the cubes in
/// two groups with names, their common face in a group without, an edge in a group, a corner as a point.
inline MshSample two_cubes() {
  MshSample sample;
  const auto tag = [](int x, int y, int z) { return std::int64_t{1000} - 70 * (x + 3 * y + 6 * z); };
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x)
        sample.nodes.emplace_back(tag(x, y, z), Eigen::Vector3d(x, y, z));
  sample.nodes.emplace_back(7, Eigen::Vector3d(9, 9, 9));
  const auto cube = [&](int x) {
    return std::vector<std::int64_t>{tag(x, 0, 0), tag(x + 1, 0, 0), tag(x + 1, 1, 0), tag(x, 1, 0),
                                     tag(x, 0, 1), tag(x + 1, 0, 1), tag(x + 1, 1, 1), tag(x, 1, 1)};
  };
  sample.cells = {{0, 3, 15, {90}, {{tag(2, 1, 1)}}},
                  {1, 4, 1, {11}, {{tag(0, 0, 0), tag(1, 0, 0)}}},
                  {2, 1, 3, {12}, {{tag(1, 0, 0), tag(1, 1, 0), tag(1, 1, 1), tag(1, 0, 1)}}},
                  {3, 1, 5, {21, 22}, {cube(0), cube(1)}}};
  sample.physicals = {{{0, 3}, {5}}, {{1, 4}, {6}}, {{2, 1}, {12}}, {{3, 1}, {1, 2}}};
  sample.names = {{{0, 5}, "tip"}, {{1, 6}, "edge"}, {{3, 1}, "both cubes"}, {{3, 2}, "steel"}};
  return sample;
}

} // namespace rubato::test
