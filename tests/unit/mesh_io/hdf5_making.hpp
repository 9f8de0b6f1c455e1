// SPDX-License-Identifier: LGPL-3.0-or-later
/// An HDF5 file made group by group, for MED files that MED's own library would not write.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <hdf5.h>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::test {

/// Every step must succeed. Paths begin at the root; groups on the way are made.
class Hdf5Making {
public:
  explicit Hdf5Making(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)),
        parents_(H5Pcreate(H5P_LINK_CREATE)) {
    EXPECT_GE(file_, 0);
    H5Pset_create_intermediate_group(parents_, 1);
  }
  ~Hdf5Making() {
    H5Pclose(parents_);
    EXPECT_GE(H5Fclose(file_), 0);
  }
  Hdf5Making(const Hdf5Making&) = delete;
  Hdf5Making& operator=(const Hdf5Making&) = delete;

  void group(const std::string& path) const {
    if (H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0)
      return;
    const auto made = H5Gcreate2(file_, path.c_str(), parents_, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(made, 0) << path;
    H5Gclose(made);
  }

  void attribute(const std::string& path, const char* name, int value) const {
    attribute(path, name, H5T_NATIVE_INT, &value);
  }
  void attribute(const std::string& path, const char* name, double value) const {
    attribute(path, name, H5T_NATIVE_DOUBLE, &value);
  }
  /// `text` filled with zeros to `width` letters and one more zero.
  void attribute(const std::string& path, const char* name, std::string text, std::size_t width) const {
    text.resize(width + 1, '\0');
    const auto type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, width + 1);
    attribute(path, name, type, text.data());
    H5Tclose(type);
  }

  void data(const std::string& path, const std::vector<double>& values) const {
    data(path, H5T_NATIVE_DOUBLE, values.size(), values.data());
  }
  void data(const std::string& path, const std::vector<int>& values) const {
    data(path, H5T_NATIVE_INT, values.size(), values.data());
  }
  void letters(const std::string& path, std::string_view text) const {
    data(path, H5T_NATIVE_CHAR, text.size(), text.data());
  }
  /// Rows of `width` letters each, an HDF5 array type a row.
  void rows_of_letters(const std::string& path, std::string_view text, hsize_t width) const {
    const auto row = H5Tarray_create2(H5T_NATIVE_SCHAR, 1, &width);
    data(path, row, text.size() / width, text.data());
    H5Tclose(row);
  }

private:
  void attribute(const std::string& path, const char* name, hid_t type, const void* value) const {
    const auto object = H5Oopen(file_, path.c_str(), H5P_DEFAULT);
    const auto one = H5Screate(H5S_SCALAR);
    const auto made = H5Acreate2(object, name, type, one, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(made, type, value), 0) << path << " " << name;
    H5Aclose(made);
    H5Sclose(one);
    H5Oclose(object);
  }

  void data(const std::string& path, hid_t type, hsize_t size, const void* values) const {
    const auto space = H5Screate_simple(1, &size, nullptr);
    const auto made = H5Dcreate2(file_, path.c_str(), type, space, parents_, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0) << path;
    H5Dclose(made);
    H5Sclose(space);
  }

  hid_t file_;
  hid_t parents_;
};

} // namespace rubato::test
