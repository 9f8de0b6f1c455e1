// SPDX-License-Identifier: LGPL-3.0-or-later
/// Ctrl-C and the polite request to end (SIGTERM).
#pragma once

namespace rubato::app {

/// From here on the first such signal only asks the run to stop after its step; a second one kills.
void catch_interrupts();

/// Whether a signal has come.
bool is_interrupted();

} // namespace rubato::app
