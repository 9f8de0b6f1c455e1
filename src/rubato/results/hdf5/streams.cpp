// SPDX-License-Identifier: LGPL-3.0-or-later
// The streams of HDF5 in the module. The build renames stdout and stderr in the static library to these
// names.
#include <cstdio>

extern "C" {
extern std::FILE* const rubato_hdf5_stdout;
extern std::FILE* const rubato_hdf5_stderr;
std::FILE* const rubato_hdf5_stdout = stdout;
std::FILE* const rubato_hdf5_stderr = stderr;
}
