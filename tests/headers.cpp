// SPDX-License-Identifier: LGPL-3.0-or-later
/// Compiles the headers that all tests share once.
