// SPDX-License-Identifier: LGPL-3.0-or-later
// Curves over time, by uPlot; two runs on one chart: A in full lines, B dashed.
"use strict";
(function (R) {
  const { element } = R;
  const colours = ["#1f5f99", "#b3261e", "#1a7f43", "#8a5a00", "#6a3d9a", "#00798c", "#a0286e", "#4d4d4d"];
  R.charts = [];

  const shownValue = (_, value) => R.number(value);

  function axesOf(series, logarithmic) {
    const units = [...new Set(series.map((one) => one.unit))];
    return units.map((unit, i) => ({
      scale: unit || "none", side: i % 2 === 0 ? 3 : 1, size: 76, grid: { show: i === 0, stroke: "#e3e7ea" },
      label: unit || undefined, labelSize: unit ? 18 : 0,
      values: (_, ticks) => ticks.map((tick) => (tick === null || (logarithmic && !isPowerOfTen(tick)) ? "" : R.number(tick, 4))),
    }));
  }

  const isPowerOfTen = (value) => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9;

  /** Draws a chart. Each series: x, y, label, unit, and whether it is `dashed` or of `points` only. */
  R.chart = function (place, title, series, { height = 260, logarithmic = false } = {}) {
    place.replaceChildren();
    if (series.length === 0) {
      place.append(element("p", { class: "soft", text: "Nothing is chosen." }));
      return null;
    }
    const scales = { x: { time: false } };
    for (const one of series) scales[one.unit || "none"] = { distr: logarithmic ? 3 : 1 };
    const chart = new uPlot({
      title, width: Math.max(280, place.clientWidth), height,
      scales,
      cursor: { drag: { x: true, y: false } },
      axes: [{ grid: { stroke: "#e3e7ea" }, values: (_, ticks) => ticks.map((tick) => R.number(tick, 5)) }, ...axesOf(series, logarithmic)],
      series: [{ label: "t", value: shownValue }, ...series.map((one, i) => ({
        label: one.label, scale: one.unit || "none", stroke: colours[(one.colour ?? i) % colours.length], width: one.points ? 0.5 : 1.5,
        dash: one.dashed ? [6, 4] : undefined, spanGaps: true, value: shownValue, points: one.points ? { show: true, size: 5, fill: colours[(one.colour ?? i) % colours.length] } : { size: 4 },
      }))],
    }, joined(series), place);
    new ResizeObserver(() => place.clientWidth > 0 && place.clientWidth !== chart.width && chart.setSize({ width: place.clientWidth, height })).observe(place);
    return chart;
  };

  /** On the instants of all series together. */
  function joined(series) {
    return uPlot.join(series.map((one) => [one.x, one.y]));
  }

  /** The tables of that kind and zone in each run that has them. */
  function tablesLike(kind, zone) {
    return R.data.runs.map((run) => run.tables.find((table) => table.kind === kind && table.zone === zone));
  }

  const shownAtFirst = {
    resultants: ["normal", "friction"],
    energy: ["kinetic", "strain", "external_work", "friction"],
  };

  function chosenAtFirst(kind, columns, find) {
    if (kind !== "probes") return (shownAtFirst[kind] || []).filter((name) => columns.includes(name));
    const first = columns[0] ? find(columns[0]) : "";
    return columns.filter((name) => find(name) === first).slice(0, 3);
  }

  function chartOf(place, heading, kind, zone) {
    const tables = tablesLike(kind, zone);
    const columns = [...new Set(tables.flatMap((table) => (table ? table.columns.slice(1) : [])))];
    const unitOf = (column) => {
      const i = tables.findIndex((table) => table && table.columns.includes(column));
      return R.columnUnit(R.data.runs[i], tables[i], column);
    };
    const chosen = new Set(chosenAtFirst(kind, columns, unitOf));
    const area = element("div");
    const record = { kind, zone, columns, chart: null };
    record.choose = (names) => (chosen.clear(), names.forEach((name) => chosen.add(name)), draw());
    const draw = () => {
      const series = [...chosen].flatMap((column) => tables.map((table, i) => table && table.columns.includes(column) ? {
        x: table.values[0], y: table.values[table.columns.indexOf(column)], label: R.keyed(i, column), unit: unitOf(column),
        dashed: i === 1, colour: columns.indexOf(column) } : null).filter(Boolean));
      record.chart = R.chart(area, "", series);
    };
    const boxes = columns.map((column) => {
      const box = element("input", { type: "checkbox", onchange: () => (box.checked ? chosen.add(column) : chosen.delete(column), draw()) });
      box.checked = chosen.has(column);
      return element("label", {}, box, R.withUnit(column, unitOf(column)));
    });
    place.append(element("h3", { text: heading }), element("div", { class: "chart-row" }, element("div", { class: "choices" }, ...boxes), area));
    draw();
    R.charts.push(record);
  }

  R.showCurves = function (place) {
    const kinds = new Map();
    for (const run of R.data.runs) for (const table of run.tables) if (table.columns.length > 1) kinds.set(`${table.kind} ${table.zone ?? ""}`, table);
    for (const { kind, zone } of kinds.values())
      chartOf(place, { probes: "Probes", energy: "Energies", resultants: `Contact resultants of ${zone}` }[kind], kind, zone);
    if (kinds.size === 0) place.append(element("p", { text: "The run has no tables." }));
    place.append(element("p", { class: "soft", text: "Values are in the units of the deck; drag over a chart to enlarge a part, double click to see all." }));
  };
})(window.rubato);
