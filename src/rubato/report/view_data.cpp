// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/view_data.hpp"

#include "rubato/report/packing.hpp"
#include "rubato/report/quantise.hpp"
#include "rubato/report/view_mesh.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace rubato::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view displacement = "displacement";
constexpr std::string_view contact_prefix = "contact_";

/// What one instant of one field takes on the page.
struct PackedField {
  Json ranges = Json::array(); ///< of each component [least, step]
  std::string text;
};

using PackedInstant = std::vector<PackedField>;

std::size_t size_of(const PackedInstant& instant) {
  constexpr std::size_t around = 80; // the tag of the array, and its ranges
  std::size_t size = 0;
  for (const auto& field : instant)
    size += field.text.size() + around;
  return size;
}

/// The components one after another, each with a range of its own.
PackedField pack(std::span<const double> values, std::size_t components, const ViewMesh& view,
                 std::uint16_t levels) {
  PackedField packed_field;
  std::vector<std::uint16_t> numbers;
  numbers.reserve(view.nodes.size() * components);
  std::vector<double> of_component(view.nodes.size());
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t i = 0; i < view.nodes.size(); ++i)
      of_component[i] = values[static_cast<std::size_t>(view.nodes[i]) * components + c];
    const auto quantised = quantise(of_component, levels);
    packed_field.ranges.push_back({quantised.least, quantised.step});
    numbers.insert(numbers.end(), quantised.numbers.begin(), quantised.numbers.end());
  }
  packed_field.text = packed(std::span<const std::uint16_t>(numbers));
  return packed_field;
}

/// Packs instants of the fields, and notes which nodes contact has to do with.
class Packer {
public:
  Packer(const results::StoredFields& fields, const ViewMesh& view)
      : fields_(fields), view_(view), touched_(view.nodes.size(), 0) {}

  PackedInstant instant(std::size_t index, std::uint16_t levels) {
    const auto& values = values_at(index);
    PackedInstant packed_fields;
    for (std::size_t f = 0; f < values.size(); ++f) {
      const auto& layout = fields_.fields[f];
      if (layout.name.starts_with(contact_prefix))
        note_contact(values[f], layout.components.size());
      packed_fields.push_back(pack(values[f], layout.components.size(), view_,
                                   layout.name == displacement ? finest_levels : levels));
    }
    return packed_fields;
  }

  /// Those with a value of contact that is not 0, at any instant so far.
  std::vector<std::uint32_t> contact_nodes() const {
    std::vector<std::uint32_t> nodes;
    for (std::size_t i = 0; i < touched_.size(); ++i)
      if (touched_[i] != 0)
        nodes.push_back(static_cast<std::uint32_t>(i));
    return nodes;
  }

private:
  /// What was read last is kept: the same instant is packed with other levels next.
  const std::vector<std::vector<double>>& values_at(std::size_t index) {
    if (read_ != index)
      values_ = fields_.values_at(index);
    read_ = index;
    return values_;
  }

  void note_contact(const std::vector<double>& values, std::size_t components) {
    for (std::size_t i = 0; i < view_.nodes.size(); ++i)
      for (std::size_t c = 0; c < components; ++c)
        if (values[static_cast<std::size_t>(view_.nodes[i]) * components + c] != 0.0)
          touched_[i] = 1;
  }

  const results::StoredFields& fields_;
  const ViewMesh& view_;
  std::vector<char> touched_;
  std::optional<std::size_t> read_;
  std::vector<std::vector<double>> values_;
};

/// The first of the levels with which all instants fit, by the sizes of some that are spread over the run.
std::uint16_t levels_for(Packer& packer, std::size_t instants, std::size_t room) {
  constexpr std::size_t looked_at = 5;
  constexpr double margin = 1.05; // the others may be larger
  const auto count = std::min(looked_at, instants);
  for (const auto levels : coarser_levels) {
    std::size_t size = 0;
    for (std::size_t i = 1; i <= count; ++i)
      size += size_of(packer.instant(i * instants / count - 1, levels));
    const auto mean = static_cast<double>(size) / static_cast<double>(count);
    if (margin * mean * static_cast<double>(instants) <= static_cast<double>(room))
      return levels;
  }
  return coarser_levels.back();
}

/// Every k-th instant and the last, such that they fit.
std::vector<std::size_t> instants_that_fit(const std::vector<PackedInstant>& instants, std::size_t room) {
  std::vector<std::size_t> kept;
  for (std::size_t stride = 1; stride <= instants.size(); ++stride) {
    kept.clear();
    for (std::size_t i = 0; i < instants.size(); i += stride)
      kept.push_back(i);
    if (kept.back() + 1 != instants.size())
      kept.push_back(instants.size() - 1);
    std::size_t size = 0;
    for (const auto i : kept)
      size += size_of(instants[i]);
    if (size <= room)
      return kept;
  }
  return {instants.size() - 1};
}

Json box_of(const Eigen::AlignedBox3d& box) {
  const auto corner = [](const Eigen::Vector3d& point) { return Json{point.x(), point.y(), point.z()}; };
  return {corner(box.min()), corner(box.max())};
}

Json cells_of(const mesh::Mesh& mesh) {
  auto cells = Json::object();
  for (const auto& block : mesh.blocks)
    if (const auto& shape = cell::topology(block.type); shape.dimension == mesh.dimension)
      cells[std::string(shape.name)] = block.cell_count();
  return cells;
}

Json layouts_of(const std::vector<results::FieldLayout>& fields, std::uint16_t levels) {
  auto layouts = Json::array();
  for (const auto& field : fields)
    layouts.push_back({{"name", field.name},
                       {"components", field.components},
                       {"levels", field.name == displacement ? finest_levels : levels}});
  return layouts;
}

/// The coordinates of the drawn nodes about the centre of the box, first all x.
std::vector<float> points_of(const mesh::Mesh& mesh, const ViewMesh& view, const Eigen::Vector3d& centre) {
  std::vector<float> points;
  for (int axis = 0; axis < 3; ++axis)
    for (const auto node : view.nodes)
      points.push_back(static_cast<float>(mesh.points[static_cast<std::size_t>(node)][axis] - centre[axis]));
  return points;
}

/// Numbers of nodes as the mesh has them: N90.
std::vector<std::uint32_t> numbers_of(const mesh::Mesh& mesh, const ViewMesh& view) {
  std::vector<std::uint32_t> numbers;
  for (const auto node : view.nodes)
    numbers.push_back(static_cast<std::uint32_t>(mesh.node_numbers[static_cast<std::size_t>(node)]));
  return numbers;
}

std::vector<Blob> mesh_blobs(const mesh::Mesh& mesh, const ViewMesh& view, const Eigen::Vector3d& centre,
                             const std::string& prefix) {
  const std::vector<std::uint32_t> bodies(view.bodies.begin(), view.bodies.end());
  const auto points = points_of(mesh, view, centre);
  const auto numbers = numbers_of(mesh, view);
  using Whole = std::span<const std::uint32_t>;
  return {{prefix + "points", packed(std::span<const float>(points))},
          {prefix + "corners", packed(Whole(view.corners))},
          {prefix + "ends", packed(Whole(view.ends))},
          {prefix + "bodies", packed(Whole(bodies))},
          {prefix + "numbers", packed(Whole(numbers))}};
}

Json description_of(const results::StoredFields& fields, const ViewMesh& view,
                    const Eigen::AlignedBox3d& box) {
  const auto& mesh = fields.mesh;
  const Eigen::Vector3d centre = box.center();
  Json names = Json::array();
  if (!mesh.node_names.empty())
    for (const auto node : view.nodes)
      names.push_back(mesh.node_names[static_cast<std::size_t>(node)]);
  return {{"dimension", mesh.dimension},
          {"nodes", mesh.node_count()},
          {"cells", cells_of(mesh)},
          {"bodies", view.body_count},
          {"drawn_nodes", view.nodes.size()},
          {"drawn_faces", view.face_count},
          {"box", box_of(box)},
          {"centre", {centre.x(), centre.y(), centre.z()}},
          {"names", names}};
}

} // namespace

ViewData::ViewData() : kept_(std::make_shared<nlohmann::ordered_json>()), description(*kept_) {}

ViewData view_data(const results::StoredFields& fields, const std::string& prefix, std::size_t room) {
  const auto view = view_mesh(fields.mesh);
  Eigen::AlignedBox3d box;
  for (const auto& point : fields.mesh.points)
    box.extend(point);
  ViewData data;
  data.description = description_of(fields, view, box);
  data.blobs = mesh_blobs(fields.mesh, view, box.center(), prefix);
  data.stored_instants = fields.instants.size();
  for (const auto& blob : data.blobs)
    room -= std::min(room, blob.text.size());

  Packer packer(fields, view);
  const auto levels = levels_for(packer, fields.instants.size(), room);
  std::vector<PackedInstant> instants;
  for (std::size_t i = 0; i < fields.instants.size(); ++i)
    instants.push_back(packer.instant(i, levels));
  const auto kept = instants_that_fit(instants, room);

  data.shown_instants = kept.size();
  auto& description = data.description;
  description["stored_instants"] = data.stored_instants;
  description["instants"] = Json::array();
  description["fields"] = layouts_of(fields.fields, levels);
  description["ranges"] = std::vector<Json>(fields.fields.size(), Json::array());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    description["instants"].push_back(fields.instants[kept[k]]);
    for (std::size_t f = 0; f < fields.fields.size(); ++f) {
      auto& packed_field = instants[kept[k]][f];
      description["ranges"][f].push_back(packed_field.ranges);
      data.blobs.push_back({fmt::format("{}f{}i{}", prefix, f, k), std::move(packed_field.text)});
    }
  }
  const auto contact_nodes = packer.contact_nodes();
  data.blobs.push_back({prefix + "contact", packed(std::span<const std::uint32_t>(contact_nodes))});
  return data;
}

} // namespace rubato::report
