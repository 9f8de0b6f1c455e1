// SPDX-License-Identifier: LGPL-3.0-or-later
/// The library that knows PETSc, MUMPS of several processes and MPI. It is loaded when a study asks for
/// conjugate gradients, or when several processes work on one run, and never else.
#pragma once

#include "rubato/core/ranks.hpp"

#include <stdexcept>
#include <string>

namespace rubato::linalg {

/// It was not built, cannot be loaded, or is that of another version; the text says which.
class ModuleMissing : public std::runtime_error {
public:
  explicit ModuleMissing(const std::string& why) : std::runtime_error(why) {}
};

/// A function that it exports in C linkage. Throws ModuleMissing.
void* petsc_function(const char* name);

/// Where `mpiexec` has started several processes: how many, as it says in their environment; else 1.
int started_ranks();
/// The place of this process among them, from 0 on.
int started_index();

/// Starts MPI among the processes of `mpiexec`. Throws InputError where the library is missing.
Ranks join_ranks();

/// What `join_ranks` calls. The number counts changes of Channel.
using MakeChannel = void(std::shared_ptr<Channel>& made);
inline constexpr const char* make_channel_name = "rubato_make_channel_2";

} // namespace rubato::linalg
