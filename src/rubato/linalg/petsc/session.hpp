// SPDX-License-Identifier: LGPL-3.0-or-later
/// PETSc and MPI of this process: started once, ended with it.
#pragma once

#include <mutex>
#include <petscsys.h>

namespace rubato::linalg::petsc {

/// Throws what an error of PETSc stands for: std::bad_alloc, else std::runtime_error.
void check(PetscErrorCode code);

/// Starts MPI and PETSc where that has not happened yet; both end with the process, whoever did not start
/// MPI leaves it to whom that did.
void start();

/// PETSc is used by one thread at a time.
std::mutex& in_use();

} // namespace rubato::linalg::petsc
