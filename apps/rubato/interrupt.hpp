// SPDX-License-Identifier: LGPL-3.0-or-later
/// Ctrl-C (SIGINT) and the polite request to end (SIGTERM).
#pragma once

#include <functional>
#include <stop_token>

namespace rubato::app {

/// Does `work` and returns what it returns; exceptions pass. The first of these signals only asks for a stop
/// by the token; the second one kills the program at once.
///
/// The work is done in a thread of its own while the first thread waits for signals: METIS catches SIGTERM
/// while it orders a matrix and would leave by a long jump, so no handler may ever see one.
int run_interruptibly(const std::function<int(const std::stop_token&)>& work);

} // namespace rubato::app
