// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/petsc/session.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <new>
#include <stdexcept>
#include <string>

namespace rubato::linalg::petsc {
namespace {

/// A process that no mpiexec started is alone: Open MPI would start a daemon for others to join it. One that
/// mpiexec started would not find the others with this setting.
void stay_alone() {
  constexpr int keep_what_is_there = 0;
  if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMIX_RANK") != nullptr)
    return;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", keep_what_is_there);
}

/// Makes the symbols of MPI global. Plugins of Open MPI use them without being linked with its library, and
/// this module is loaded with local symbols.
void share_symbols_of_mpi() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&MPI_Init), &library) != 0)
    dlopen(library.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_GLOBAL);
}

/// Signals belong to the program, and nothing outside a deck changes its numbers. Errors come back as codes.
class Session {
public:
  Session() {
    stay_alone();
    share_symbols_of_mpi();
    check(PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr));
    check(PetscOptionsSetValue(nullptr, "-skip_petscrc", nullptr));
    check(PetscInitializeNoArguments());
    check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  }
  ~Session() {
    PetscPopErrorHandler();
    PetscFinalize();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

} // namespace

void check(PetscErrorCode code) {
  if (code == 0)
    return;
  if (code == PETSC_ERR_MEM)
    throw std::bad_alloc();
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error("PETSc: " +
                           (text == nullptr ? "error " + std::to_string(code) : std::string(text)));
}

void start() {
  static const Session session;
}

std::mutex& in_use() {
  static std::mutex mutex;
  return mutex;
}

} // namespace rubato::linalg::petsc
