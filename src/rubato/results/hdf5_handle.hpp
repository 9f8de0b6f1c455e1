// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: what HDF5 has opened.
#pragma once

#include <hdf5.h>

namespace rubato::results {

/// Closes what HDF5 opened.
class Hdf5Handle {
public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0)
      close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  hid_t id() const { return id_; }
  bool good() const { return id_ >= 0; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

} // namespace rubato::results
