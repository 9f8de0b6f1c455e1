// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/vtkhdf.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/results/hdf5_handle.hpp"
#include "rubato/results/hdf5_library.hpp"
#include "rubato/results/vtk_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace rubato::results {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view root = "VTKHDF";

template <class T> hid_t hdf5_type() {
  if constexpr (std::is_same_v<T, double>)
    return *hdf5().native_double;
  else if constexpr (std::is_same_v<T, std::int64_t>)
    return *hdf5().native_int64;
  else
    return *hdf5().native_uint8;
}

/// An open file with datasets that grow by rows.
class VtkHdfFile {
public:
  VtkHdfFile(const fs::path& path, hid_t id) : path_(path), file_(id, hdf5().file_close) {
    if (!file_.good())
      throw InputError(fmt::format(
          "file '{}' cannot be written: is there such a folder, and may you write into it?", path.string()));
  }

  /// Puts rows at the end of the dataset of that name, which is made when it is not there, after its first
  /// `start` rows; those that come later are gone then.
  template <class T>
  void put_rows(const std::string& name, std::size_t columns, hsize_t start, std::span<const T> values) {
    const hsize_t rows = values.size() / columns;
    const Hdf5Handle dataset(opened(fmt::format("{}/{}", root, name), columns, hdf5_type<T>(), rows),
                             hdf5().dataset_close);
    const std::array<hsize_t, 2> extent{start + rows, columns};
    check(hdf5().dataset_set_extent(dataset.id(), extent.data()));
    if (values.empty())
      return;
    const std::array<hsize_t, 2> first{start, 0};
    const std::array<hsize_t, 2> count{rows, columns};
    const Hdf5Handle space(hdf5().dataset_get_space(dataset.id()), hdf5().space_close);
    check(hdf5().space_select_hyperslab(space.id(), H5S_SELECT_SET, first.data(), nullptr, count.data(),
                                        nullptr));
    const Hdf5Handle memory(hdf5().space_create_simple(columns == 1 ? 1 : 2, count.data(), nullptr),
                            hdf5().space_close);
    check(hdf5().dataset_write(dataset.id(), hdf5_type<T>(), memory.id(), space.id(), H5P_DEFAULT,
                               values.data()));
  }

  template <class T> void put_row(const std::string& name, hsize_t start, T value) {
    put_rows(name, 1, start, std::span<const T>(&value, 1));
  }

  void make_group(const std::string& name) {
    const Hdf5Handle group(
        hdf5().group_create(file_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        hdf5().group_close);
    check(group.good() ? 0 : -1);
  }

  void put(const std::string& object, const char* attribute, std::string_view text) {
    const Hdf5Handle type(hdf5().type_copy(*hdf5().c_string), hdf5().type_close);
    hdf5().type_set_size(type.id(), text.size());
    hdf5().type_set_strpad(type.id(), H5T_STR_NULLPAD);
    const Hdf5Handle space(hdf5().space_create(H5S_SCALAR), hdf5().space_close);
    put(object, attribute, type.id(), space.id(), text.data());
  }

  void put(const std::string& object, const char* attribute, std::span<const std::int64_t> values) {
    const hsize_t count = values.size();
    const Hdf5Handle space(values.size() == 1 ? hdf5().space_create(H5S_SCALAR)
                                              : hdf5().space_create_simple(1, &count, nullptr),
                           hdf5().space_close);
    put(object, attribute, *hdf5().native_int64, space.id(), values.data());
  }

  std::int64_t number(const std::string& object, const char* attribute) const {
    const Hdf5Handle found(
        hdf5().attribute_open_by_name(file_.id(), object.c_str(), attribute, H5P_DEFAULT, H5P_DEFAULT),
        hdf5().attribute_close);
    std::int64_t value = 0;
    check(found.good() ? hdf5().attribute_read(found.id(), *hdf5().native_int64, &value) : -1);
    return value;
  }

  void flush() { check(hdf5().file_flush(file_.id(), H5F_SCOPE_GLOBAL)); }

private:
  void check(herr_t result) const {
    if (result < 0)
      throw WriteError(path_);
  }

  void put(const std::string& object, const char* attribute, hid_t type, hid_t space, const void* value) {
    if (hdf5().attribute_exists_by_name(file_.id(), object.c_str(), attribute, H5P_DEFAULT) > 0)
      check(hdf5().attribute_delete_by_name(file_.id(), object.c_str(), attribute, H5P_DEFAULT));
    const Hdf5Handle made(hdf5().attribute_create_by_name(file_.id(), object.c_str(), attribute, type, space,
                                                          H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          hdf5().attribute_close);
    check(made.good() ? hdf5().attribute_write(made.id(), type, value) : -1);
  }

  /// Chunks of one instant, compressed byte by byte of the numbers (shuffle), which suits numbers best.
  hid_t opened(const std::string& name, std::size_t columns, hid_t type, hsize_t rows) {
    if (hdf5().link_exists(file_.id(), name.c_str(), H5P_DEFAULT) > 0)
      return hdf5().dataset_open(file_.id(), name.c_str(), H5P_DEFAULT);
    constexpr hsize_t most_rows = 1U << 15;
    constexpr hsize_t least_rows = 64; // of what gets one number an instant
    constexpr unsigned fastest = 1;
    const std::array<hsize_t, 2> empty{0, columns};
    const std::array<hsize_t, 2> limit{H5S_UNLIMITED, columns};
    const std::array<hsize_t, 2> chunk{std::clamp(rows, least_rows, most_rows), columns};
    const Hdf5Handle space(hdf5().space_create_simple(columns == 1 ? 1 : 2, empty.data(), limit.data()),
                           hdf5().space_close);
    const Hdf5Handle creation(hdf5().properties_create(*hdf5().dataset_creation), hdf5().properties_close);
    hdf5().properties_set_chunk(creation.id(), columns == 1 ? 1 : 2, chunk.data());
    hdf5().properties_set_shuffle(creation.id());
    hdf5().properties_set_deflate(creation.id(), fastest);
    hdf5().properties_set_obj_track_times(creation.id(), false); // the same content, the same bytes
    const auto made = hdf5().dataset_create(file_.id(), name.c_str(), type, space.id(), H5P_DEFAULT,
                                            creation.id(), H5P_DEFAULT);
    check(made < 0 ? -1 : 0);
    return made;
  }

  fs::path path_;
  Hdf5Handle file_;
};

hid_t created(const fs::path& path) {
  hdf5().error_set_auto(H5E_DEFAULT, nullptr, nullptr); // what goes wrong is told by exceptions
  return hdf5().file_create(path.c_str(), Hdf5Access::truncate, H5P_DEFAULT, H5P_DEFAULT);
}

hid_t reopened(const fs::path& path) {
  hdf5().error_set_auto(H5E_DEFAULT, nullptr, nullptr);
  return hdf5().file_open(path.c_str(), Hdf5Access::read_and_write, H5P_DEFAULT);
}

template <class T> std::span<const T> seen(const std::vector<T>& values) {
  return values;
}

void write_cells(VtkHdfFile& file, const mesh::VtkCells& cells) {
  const std::vector<std::int64_t> connectivity(cells.connectivity.begin(), cells.connectivity.end());
  std::vector<std::int64_t> offsets{0};
  offsets.insert(offsets.end(), cells.ends.begin(), cells.ends.end());
  file.put_row("NumberOfCells", 0, static_cast<std::int64_t>(cells.types.size()));
  file.put_row("NumberOfConnectivityIds", 0, static_cast<std::int64_t>(connectivity.size()));
  file.put_rows("Connectivity", 1, 0, seen(connectivity));
  file.put_rows("Offsets", 1, 0, seen(offsets));
  file.put_rows("Types", 1, 0, seen(cells.types));
}

/// Arrays that are the same at every instant: each step finds them at row 0.
struct Constants {
  std::vector<std::string> of_points;
  std::vector<std::string> of_cells;
};

Constants constants_of(const mesh::Mesh& mesh) {
  const auto cells = mesh::vtk_cells(mesh, mesh::VtuCells::of_highest_dimension);
  const auto groups = mesh::vtk_groups(mesh, cells);
  Constants constants;
  for (const auto& group : groups.of_points)
    constants.of_points.push_back(group.name);
  for (const auto& group : groups.of_cells)
    constants.of_cells.push_back(group.name);
  if (mesh.node_numbers.size() == mesh.points.size())
    constants.of_points.emplace_back("node_number");
  if (!cells.numbers.empty())
    constants.of_cells.emplace_back("cell_number");
  return constants;
}

void write_constants(VtkHdfFile& file, const mesh::Mesh& mesh, const mesh::VtkCells& cells) {
  const auto groups = mesh::vtk_groups(mesh, cells);
  for (const auto& group : groups.of_points)
    file.put_rows("PointData/" + group.name, 1, 0, seen(group.members));
  for (const auto& group : groups.of_cells)
    file.put_rows("CellData/" + group.name, 1, 0, seen(group.members));
  if (mesh.node_numbers.size() == mesh.points.size())
    file.put_rows("PointData/node_number", 1, 0, seen(mesh.node_numbers));
  if (!cells.numbers.empty())
    file.put_rows("CellData/cell_number", 1, 0, seen(cells.numbers));
}

/// Where an instant finds mesh and arrays.
void put_step(VtkHdfFile& file, const mesh::Mesh& mesh, VtkHdfInstant instant) {
  constexpr std::int64_t first = 0;
  const auto row = static_cast<hsize_t>(instant.number);
  file.put_row("Steps/Values", row, instant.time);
  file.put_row("Steps/NumberOfParts", row, std::int64_t{1});
  for (const auto* name : {"PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"})
    file.put_row(fmt::format("Steps/{}", name), row, first);
  const auto constants = constants_of(mesh);
  for (const auto& name : constants.of_points)
    file.put_row("Steps/PointDataOffsets/" + name, row, first);
  for (const auto& name : constants.of_cells)
    file.put_row("Steps/CellDataOffsets/" + name, row, first);
}

} // namespace

void start_vtkhdf(const fs::path& path, const mesh::Mesh& mesh) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const std::string group(root);
  VtkHdfFile file(path, created(path));
  file.make_group(group);
  for (const auto* name : {"PointData", "CellData", "FieldData", "Steps", "Steps/PointDataOffsets",
                           "Steps/CellDataOffsets", "Steps/FieldDataOffsets"})
    file.make_group(fmt::format("{}/{}", root, name));
  file.put(group, "Version", std::array<std::int64_t, 2>{2, 0});
  file.put(group, "Type", "UnstructuredGrid");
  file.put(group + "/Steps", "NSteps", std::array<std::int64_t, 1>{0});
  const auto cells = mesh::vtk_cells(mesh, mesh::VtuCells::of_highest_dimension);
  file.put_row("NumberOfPoints", 0, std::int64_t{mesh.node_count()});
  const auto* const coordinates = mesh.points.empty() ? nullptr : mesh.points.front().data();
  file.put_rows("Points", 3, 0, std::span(coordinates, 3 * mesh.points.size()));
  write_cells(file, cells);
  write_constants(file, mesh, cells);
  file.flush();
}

void append_vtkhdf(const fs::path& path, const mesh::Mesh& mesh, VtkHdfInstant instant,
                   std::span<const NodalField> fields, std::span<const CellField> cell_fields, int digits) {
  const VtkArrays arrays(fields, cell_fields);
  std::uintmax_t bytes = 0;
  constexpr std::uintmax_t of_array = 1U << 14; // what HDF5 tells about it
  for (const auto& array : arrays.all())
    bytes += of_array + array.values.size_bytes();
  require_room(path, bytes);
  const auto steps = fmt::format("{}/Steps", root);
  VtkHdfFile file(path, reopened(path));
  for (const auto& array : arrays.all()) {
    const auto columns = static_cast<std::size_t>(array.components);
    const auto start = instant.number * static_cast<std::int64_t>(array.values.size() / columns);
    const std::string_view data = array.of_cells ? "CellData" : "PointData";
    file.put_row(fmt::format("Steps/{}Offsets/{}", data, array.name), static_cast<hsize_t>(instant.number),
                 start);
    file.put_rows(fmt::format("{}/{}", data, array.name), columns, static_cast<hsize_t>(start),
                  seen(mesh::with_digits(array.values, digits)));
  }
  put_step(file, mesh, instant);
  file.put(steps, "NSteps", std::array<std::int64_t, 1>{instant.number + 1});
  file.flush();
}

std::int64_t instants_in_vtkhdf(const fs::path& path) {
  hdf5().error_set_auto(H5E_DEFAULT, nullptr, nullptr);
  return VtkHdfFile(path, hdf5().file_open(path.c_str(), Hdf5Access::read, H5P_DEFAULT))
      .number(fmt::format("{}/Steps", root), "NSteps");
}

} // namespace rubato::results
