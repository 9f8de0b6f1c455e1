// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/hdf5_file.hpp"

#include "rubato/core/writing.hpp"
#include "rubato/results/hdf5_handle.hpp"
#include "rubato/results/hdf5_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <hdf5.h>
#include <stdexcept>
#include <type_traits>

namespace rubato::results {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>);

/// What goes wrong is told by exceptions; HDF5 would print it as well.
void keep_silent() {
  hdf5().error_set_auto(H5E_DEFAULT, nullptr, nullptr);
}

hid_t create(const std::filesystem::path& path, std::uint64_t user_block) {
  const Hdf5Handle properties(hdf5().properties_create(*hdf5().file_creation), hdf5().properties_close);
  hdf5().properties_set_userblock(properties.id(), user_block);
  return hdf5().file_create(path.c_str(), Hdf5Access::truncate, properties.id(), H5P_DEFAULT);
}

} // namespace

Hdf5File::Hdf5File(const std::filesystem::path& path, Access access, std::uint64_t user_block) : path_(path) {
  keep_silent();
  id_ = access == Access::create ? create(path, user_block)
                                 : hdf5().file_open(path.c_str(), Hdf5Access::read, H5P_DEFAULT);
  if (id_ < 0)
    fail(access == Access::create ? "cannot be written" : "cannot be opened as an HDF5 file");
}

Hdf5File::~Hdf5File() {
  if (id_ >= 0)
    hdf5().file_close(id_);
}

void Hdf5File::close() {
  const auto id = id_;
  id_ = -1;
  if (hdf5().file_close(id) < 0)
    throw WriteError(path_);
}

void Hdf5File::fail(const std::string& what) const {
  throw std::runtime_error(fmt::format("{}: {}", path_.string(), what));
}

void Hdf5File::write(const std::string& name, std::span<const double> values) {
  write_array(name, *hdf5().native_double, values.size(), values.data());
}

void Hdf5File::write(const std::string& name, std::span<const std::int64_t> values) {
  write_array(name, *hdf5().native_int64, values.size(), values.data());
}

void Hdf5File::write(const std::string& name, std::string_view text) {
  const Hdf5Handle type(hdf5().type_copy(*hdf5().c_string), hdf5().type_close);
  hdf5().type_set_size(type.id(), std::max<std::size_t>(text.size(), 1)); // HDF5 knows no empty texts
  hdf5().type_set_strpad(type.id(), H5T_STR_NULLPAD);
  write_array(name, type.id(), 1, text.empty() ? "" : text.data());
}

void Hdf5File::write_array(const std::string& name, std::int64_t type, std::uint64_t size,
                           const void* values) {
  const std::array<hsize_t, 1> extent{size};
  const Hdf5Handle space(hdf5().space_create_simple(1, extent.data(), nullptr), hdf5().space_close);
  const Hdf5Handle link(hdf5().properties_create(*hdf5().link_creation), hdf5().properties_close);
  hdf5().properties_set_create_intermediate_group(link.id(), 1);
  const Hdf5Handle creation(hdf5().properties_create(*hdf5().dataset_creation), hdf5().properties_close);
  hdf5().properties_set_obj_track_times(creation.id(), false); // the same content, the same bytes
  const Hdf5Handle data(
      hdf5().dataset_create(id_, name.c_str(), type, space.id(), link.id(), creation.id(), H5P_DEFAULT),
      hdf5().dataset_close);
  if (!data.good() ||
      (size > 0 && hdf5().dataset_write(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0))
    throw WriteError(path_);
}

std::uint64_t Hdf5File::size_of(std::int64_t data) const {
  const Hdf5Handle space(hdf5().dataset_get_space(data), hdf5().space_close);
  const auto size = hdf5().space_get_simple_extent_npoints(space.id());
  if (size < 0)
    fail("an array has no size");
  return static_cast<std::uint64_t>(size);
}

template <class T> std::vector<T> Hdf5File::array(const std::string& name, std::int64_t type) const {
  const Hdf5Handle data(hdf5().dataset_open(id_, name.c_str(), H5P_DEFAULT), hdf5().dataset_close);
  if (!data.good())
    fail(fmt::format("holds no '{}'", name));
  std::vector<T> values(size_of(data.id()));
  if (!values.empty() &&
      hdf5().dataset_read(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(fmt::format("'{}' cannot be read", name));
  return values;
}

bool Hdf5File::has(const std::string& name) const {
  return hdf5().link_exists(id_, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<double> Hdf5File::numbers(const std::string& name) const {
  return array<double>(name, *hdf5().native_double);
}

std::vector<std::int64_t> Hdf5File::integers(const std::string& name) const {
  return array<std::int64_t>(name, *hdf5().native_int64);
}

std::string Hdf5File::text(const std::string& name) const {
  const Hdf5Handle data(hdf5().dataset_open(id_, name.c_str(), H5P_DEFAULT), hdf5().dataset_close);
  if (!data.good())
    fail(fmt::format("holds no '{}'", name));
  const Hdf5Handle type(hdf5().dataset_get_type(data.id()), hdf5().type_close);
  std::string text(hdf5().type_get_size(type.id()), '\0');
  if (hdf5().dataset_read(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    fail(fmt::format("'{}' cannot be read", name));
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

} // namespace rubato::results
