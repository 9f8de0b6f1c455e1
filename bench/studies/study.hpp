// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whole studies, what is measured of one, and how.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace rubato::bench {

/// A study of cases/sdnl140.
struct Study {
  std::string name;  ///< on the command line
  std::string title; ///< in the table
  std::string deck;  ///< its run evol1 is taken
  int refine = 1;
  double step = 1e-3;  ///< [s]
  double end = 0;      ///< [s]
  int full_steps = 0;  ///< of the full-refactorisation Newton, 0 for none
  bool quick = false;  ///< of the quick set
  bool fitted = false; ///< counts for the exponents
};

std::span<const Study> studies();

/// Seconds are of the processor.
struct Measurement {
  std::string title;
  bool fitted = false;
  int dofs = 0;         ///< unknowns
  int contact_dofs = 0; ///< those on contact surfaces
  int steps = 0;
  double active = 0;      ///< mean number of points in contact
  double iterations = 0;  ///< a step
  double setup = 0;       ///< [s] model, effective matrix and its factor
  double step = 0;        ///< [s] the loop with all it writes, a step
  double middle_step = 0; ///< [s] the median step
  double solve = 0;       ///< [s] forward and backward with a Cholesky factor of the same matrix
  double halves = 0;    ///< [s] the triangular solves of one condensed step: in halves, by way of the surface
  double memory = 0;    ///< [bytes] peak of set-up and loop
  double full_step = 0; ///< [s] mean of the first `full_steps`, each iteration a factorisation
  int full_steps = 0;
};

/// Runs the study in this process. Peak memory is that of the whole process, so one process measures one
/// study. Throws std::runtime_error when a run does not come to its end.
Measurement measure(const Study& study);

std::string to_json(const Measurement& measurement);
Measurement from_json(const std::string& text);

} // namespace rubato::bench
