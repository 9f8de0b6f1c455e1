// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of the report that are text and tables.
"use strict";
(function (R) {
  const { element, number } = R;

  /** A column for each run, with its name where there are two. */
  function eachRun(place, show) {
    const columns = R.data.runs.map((run, i) => {
      const column = element("div");
      if (R.key(i)) column.append(element("h3", { text: R.keyed(i, run.summary.run) }));
      show(column, run, i);
      return column;
    });
    place.append(element("div", { class: "columns" }, ...columns));
  }

  function badge(text, good) {
    return element("span", { class: `badge ${good === undefined ? "" : good ? "good" : "bad"}`, text });
  }

  R.showHead = function () {
    const [first] = R.data.runs;
    document.getElementById("title").textContent = first.study.title || first.summary.run;
    document.getElementById("runs").append(...R.data.runs.map((run, i) => {
      const { summary } = run, checks = summary.checks || [], failed = checks.filter((check) => !check.holds).length;
      return element("div", {}, R.key(i) ? element("span", { class: "run-key", text: R.key(i) }) : null,
        `run ${summary.run} in ${run.folder} `, badge(summary.status.replaceAll("_", " "), summary.status === "complete"), " ",
        checks.length ? badge(failed ? `${failed} of ${checks.length} checks fail` : `${checks.length} checks pass`, failed === 0) : "",
        run.study.units ? ` units: ${run.study.units}` : "");
    }));
  };

  R.showChecks = (place) => eachRun(place, (column, { summary }) => {
    const checks = summary.checks || [];
    if (checks.length === 0) return column.append(element("p", { text: "The deck has no checks, or the run did not come to their evaluation." }));
    column.append(R.table(["quantity", "at#", "reference#", "value#", "deviation#", "tolerance#", "", "source"], checks.map((check) => [
      check.quantity, number(check.at), check.run ? `run ${check.run}` : number(check.reference, 10), number(check.value, 10), number(check.deviation, 3),
      `${number(check.tolerance, 3)} ${check.kind === "absolute" ? "abs." : "rel."}`, badge(check.holds ? "passes" : "fails", check.holds),
      [check.source.replaceAll("_", " "), check.note, check.where, check.failure].filter(Boolean).join("; ")])));
  });

  function unmetText(unmet) {
    return (unmet || []).map((one) => [one.criterion, one.zone && `zone ${one.zone}`, one.node,
      one.value !== undefined && `${number(one.value, 3)} (allowed ${number(one.allowed, 3)})`].filter(Boolean).join(" ")).join("; ");
  }

  function convergenceCharts(place) {
    const runs = R.data.runs.filter((run) => run.attempts.end.length > 0);
    const accepted = (run, key) => run.attempts[key].map((value, i) => (run.attempts.accepted[i] ? value : null));
    const series = (key, unit, change = (value) => value) => runs.map((run, i) => ({
      x: run.attempts.end, y: accepted(run, key).map((value) => (value === null ? null : change(value))),
      label: R.keyed(R.data.runs.indexOf(run), key.replaceAll("_", " ")), unit, points: true, colour: i }));
    const lengths = runs.map((run, i) => ({ x: run.attempts.end, unit: "time", points: true, colour: i,
      y: run.attempts.end.map((end, k) => (run.attempts.accepted[k] ? end - run.attempts.begin[k] : null)),
      label: R.keyed(R.data.runs.indexOf(run), "length of the step") }));
    const kinds = [["Iterations of the accepted steps", series("iterations", "iterations"), {}],
      ["Residual of the last iterate", series("residual", "relative residual", (value) => (value > 0 ? value : null)), { logarithmic: true }],
      ["Lengths of the steps", lengths, {}]];
    const charts = element("div", { class: "charts" });
    place.append(charts);
    for (const [title, lines, options] of kinds) {
      if (lines.every((line) => line.y.every((value) => value === null))) continue;
      const area = element("div");
      charts.append(area);
      R.charts.push({ kind: "convergence", title, chart: R.chart(area, title, lines, { height: 220, ...options }) });
    }
  }

  R.showConvergence = function (place) {
    eachRun(place, (column, { summary, attempts }) => {
      column.append(element("p", { text: `${summary.steps} steps, ${summary.iterations} iterations, ${summary.cuts} cuts; processor time: set-up ` +
        `${number(summary.setup_seconds, 3)} s, time loop ${number(summary.loop_seconds, 3)} s. ${attempts.count} attempts are in steps.jsonl.` }));
      if (attempts.failed.length === 0) return column.append(element("p", { text: "Every attempt at a step was accepted." }));
      column.append(element("h3", { text: "Attempts that were not accepted" }), element("div", { class: "scroll" },
        R.table(["from#", "to#", "cut#", "outcome", "iterations#", "residual#", "criteria that are not met"], attempts.failed.map((one) => [
          number(one.begin), number(one.end), one.cut_level, one.outcome, one.iterations, number(one.residual, 3), unmetText(one.unmet)]))));
    });
    convergenceCharts(place);
  };

  R.showWarnings = (place) => eachRun(place, (column, { summary, warnings }) => {
    const problem = (text) => column.append(element("p", { class: "problem", text }));
    if (summary.status === "running") problem("run.json says that the run is going on. If no program runs, it was killed; --resume continues it.");
    else if (summary.status !== "complete") problem(`${summary.status.replaceAll("_", " ")}: ${summary.reason}`);
    for (const text of summary.failure?.advice ?? []) column.append(element("p", { class: "note", text: `What may help: ${text}` }));
    for (const check of summary.checks || []) if (!check.holds) problem(`The check of ${check.quantity} at ${number(check.at)} fails.`);
    for (const text of warnings) column.append(element("p", { class: "note", text }));
    if (!column.querySelector(".problem, .note")) column.append(element("p", { text: "None." }));
    const own = summary.plausibility ?? [];
    if (own.length > 0)
      column.append(element("h3", { text: `Checks of the run itself: ${own.filter((one) => one.passes).length} of ${own.length} passed` }),
        element("div", { class: "scroll" }, R.table(["check", "value#", "limit#", "passes", "at#", "where"],
          own.map((one) => [one.check.replaceAll("_", " "), number(one.value, 3), number(one.limit, 3), one.passes ? "yes" : "no", number(one.t), one.where]))));
  });

  R.showStudy = (place) => eachRun(place, (column, run) => {
    column.append(R.table(["", ""], run.topics.map((topic) => [topic.name,
      element("div", {}, ...topic.sentences.map((text) => element("p", { text })))])));
    const echo = element("pre", { text: JSON.stringify(run.study, null, 2) });
    column.append(element("details", {}, element("summary", { text: "The whole study with every default" }), echo));
  });

  R.showMesh = (place) => eachRun(place, (column, { summary, view }) => {
    const rows = [["nodes", number(summary.nodes)], ["unknowns", number(summary.unknowns)]];
    if (view) {
      const [low, high] = view.box;
      rows.push(["cells", Object.entries(view.cells).map(([type, count]) => `${count} ${type}`).join(", ")],
        ["bodies", number(view.bodies)],
        ["from", `(${low.slice(0, view.dimension).map((value) => number(value)).join(", ")})`],
        ["to", `(${high.slice(0, view.dimension).map((value) => number(value)).join(", ")})`],
        ["drawn", `${view.drawn_faces} ${view.dimension === 2 ? "cells" : "faces of the skin"} with ${view.drawn_nodes} nodes`]);
    }
    for (const side of summary.contact_sides ?? [])
      rows.push([`contact ${side.zone}`, `slave ${side.slave} (${side.slave_faces} faces), master ${side.master} (${side.master_faces}), because ${side.because}`]);
    column.append(R.table(["", ""], rows));
  });

  R.showVersions = (place) => eachRun(place, (column, { summary, tolerances }) => {
    column.append(R.table(["", ""], [["run by", `rubato ${summary.rubato}`], ["report by", `rubato ${R.data.rubato}`],
      ["view", `three.js ${THREE.REVISION} (MIT licence)`], ["curves", `uPlot ${R.data.uplot} (MIT licence)`],
      ["memory of factors", summary.factor_bytes ? `${number(summary.factor_bytes / 1e6, 3)} MB` : "–"]]));
    column.append(element("details", {}, element("summary", { text: "Tolerances of the program" }),
      R.table(["", "#"], Object.entries(tolerances).map(([name, value]) => [name.replaceAll("_", " "), number(value)]))));
  });
})(window.rubato);
