// SPDX-License-Identifier: LGPL-3.0-or-later
/// What bad input is answered with.
#pragma once

#include "rubato/core/error.hpp"

#include <string>

namespace rubato::test {

/// The text of the InputError that `call` throws; "nothing thrown" when it throws none.
template <class Call> std::string fault_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing thrown";
}

} // namespace rubato::test
