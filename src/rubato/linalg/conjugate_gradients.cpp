// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/conjugate_gradients.hpp"

#include "rubato/core/error.hpp"
#include "rubato/linalg/petsc_module.hpp"

#include <fmt/format.h>

namespace rubato::linalg {
namespace {

MakeConjugateGradients* found_function() {
  try {
    return reinterpret_cast<MakeConjugateGradients*>(petsc_function(make_conjugate_gradients_name));
  } catch (const ModuleMissing& error) {
    throw InputError(
        {fault_at("solver", fmt::format("found iterative, which needs PETSc: {}; expected auto, or "
                                        "a rubato that is built with it (make deps build PETSC=1)",
                                        error.what()))});
  }
}

} // namespace

std::unique_ptr<ConjugateGradients> make_conjugate_gradients(bool of_all_ranks) {
  std::unique_ptr<ConjugateGradients> made;
  found_function()(made, of_all_ranks);
  return made;
}

bool has_conjugate_gradients() {
  try {
    make_conjugate_gradients();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

} // namespace rubato::linalg
