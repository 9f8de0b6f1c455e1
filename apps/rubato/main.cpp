// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/error.hpp"

int main() { return 0; }
