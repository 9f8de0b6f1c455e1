// SPDX-License-Identifier: LGPL-3.0-or-later
// Fills the page: the view first, then what is below it.
"use strict";
(async function (R) {
  R.marks.main = performance.now();
  R.showHead();
  const drawn = R.showView(document.getElementById("view-body"));
  const parts = { curves: R.showCurves, checks: R.showChecks, convergence: R.showConvergence, warnings: R.showWarnings,
    study: R.showStudy, mesh: R.showMesh, versions: R.showVersions };
  for (const [name, show] of Object.entries(parts)) show(document.getElementById(`${name}-body`));
  R.marks.text = performance.now();
  await drawn;
  R.marks.view = performance.now();
  await new Promise((done) => window.requestAnimationFrame(() => window.requestAnimationFrame(done)));
  R.openedAfter = performance.now(); // ms since the page was asked for
  R.ready = true;
})(window.rubato);
