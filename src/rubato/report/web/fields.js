// SPDX-License-Identifier: LGPL-3.0-or-later
// The fields of one run: shape of the mesh, values at an instant, ranges, histories of a node.
"use strict";
(function (R) {
  /** Arrays of the mesh that is drawn. */
  R.shapeOf = async function (run) {
    const name = (what) => run.prefix + what;
    const [points, corners, ends, bodies, numbers, contact] = await Promise.all([
      R.arrayOnce(name("points"), Float32Array), R.arrayOnce(name("corners"), Uint32Array),
      R.arrayOnce(name("ends"), Uint32Array), R.arrayOnce(name("bodies"), Uint32Array),
      R.arrayOnce(name("numbers"), Uint32Array), R.arrayOnce(name("contact"), Uint32Array)]);
    const count = run.view.drawn_nodes, base = new Float32Array(3 * count);
    for (let axis = 0, at = 0; axis < 3; ++axis) for (let i = 0; i < count; ++i, ++at) base[3 * i + axis] = points[at];
    return { base, corners, ends, bodies, numbers, contact };
  };

  R.nodeName = (run, shape, node) => run.view.names[node] || "N" + shape.numbers[node];
  R.nodeNamed = function (run, shape, word) {
    const named = run.view.names.indexOf(word);
    return named >= 0 ? named : shape.numbers.indexOf(Number(word.replace(/^N/i, "")));
  };

  R.fieldIndex = (run, name) => (run.view ? run.view.fields.findIndex((field) => field.name === name) : -1);

  /** Index of the last instant that is not after t; the first one where all are. */
  R.instantAt = function (run, t) {
    const { instants } = run.view, slack = 1e-9 * Math.abs(instants[instants.length - 1] - instants[0]);
    let found = 0;
    instants.forEach((at, i) => (found = at <= t + slack ? i : found));
    return found;
  };

  const packedOf = (run, field, instant, once) =>
    (once ? R.arrayOnce : R.array)(`${run.prefix}f${field}i${instant}`, Uint16Array);

  /** All components of a field at an instant, a Float32Array of the nodes each. */
  R.componentsOf = async function (run, field, instant) {
    const numbers = await packedOf(run, field, instant);
    const ranges = run.view.ranges[field][instant];
    return ranges.map((range, c) => R.component(numbers, c, range, run.view.drawn_nodes));
  };

  /** What is shown of a field: a component, or the magnitude of a vector (component "magnitude"). */
  R.shownValues = async function (run, field, component, instant) {
    const components = await R.componentsOf(run, field, instant);
    if (component !== "magnitude") return components[component];
    return components[0].map((_, i) => Math.hypot(...components.map((values) => values[i])));
  };

  R.choicesOf = function (field) {
    const choices = field.components.map((name, c) => ({ value: String(c), text: name || "value" }));
    const isVector = ["displacement", "velocity", "acceleration"].includes(field.name);
    return isVector ? [{ value: "magnitude", text: "magnitude" }, ...choices] : choices;
  };

  /** Least and largest value of a component over all instants, from the ranges alone. */
  function rangeOfComponent(run, field, c, instants) {
    const levels = run.view.fields[field].levels;
    let least = Infinity, largest = -Infinity;
    for (const i of instants) {
      const [low, step] = run.view.ranges[field][i][c];
      least = Math.min(least, low);
      largest = Math.max(largest, low + step * levels);
    }
    return [least, largest];
  }

  /** The range of colours: over `instants`. Of a magnitude an upper bound from its components, 0 below, unless
      `values` at the one instant are given. */
  R.rangeOf = function (run, field, component, instants, values) {
    if (values) {
      let least = Infinity, largest = -Infinity;
      for (const value of values) if (!Number.isNaN(value)) (least = Math.min(least, value)), (largest = Math.max(largest, value));
      return least <= largest ? [least, largest] : [0, 0];
    }
    if (component !== "magnitude") return rangeOfComponent(run, field, component, instants);
    let largest = 0;
    for (const i of instants) {
      const squares = run.view.fields[field].components.map((_, c) =>
        Math.max(...rangeOfComponent(run, field, c, [i]).map(Math.abs)) ** 2);
      largest = Math.max(largest, Math.sqrt(squares.reduce((a, b) => a + b, 0)));
    }
    return [0, largest];
  };

  /** Every field at one node and instant: name, component, unit, value, by how much it may be off. */
  R.valuesAtNode = async function (run, node, instant) {
    const rows = [];
    for (const [f, field] of run.view.fields.entries()) {
      const numbers = await packedOf(run, f, instant, true);
      field.components.forEach((component, c) => {
        const range = run.view.ranges[f][instant][c];
        rows.push({ field: field.name, component, unit: R.fieldUnit(field.name),
          value: R.valueOf(numbers, c, range, run.view.drawn_nodes, node), off: range[1] / 2 });
      });
    }
    return rows;
  };

  /** A component, or the magnitude, at one node over the instants. */
  R.historyOfNode = async function (run, node, field, component) {
    const count = run.view.drawn_nodes;
    const values = [];
    for (let i = 0; i < run.view.instants.length; ++i) {
      const numbers = await packedOf(run, field, i, true);
      const at = (c) => R.valueOf(numbers, c, run.view.ranges[field][i][c], count, node);
      values.push(component === "magnitude" ? Math.hypot(...run.view.fields[field].components.map((_, c) => at(c))) : at(Number(component)));
    }
    return values;
  };

  /** A scale by which the largest displacement is seen as a tenth of the body, rounded to 1, 2 or 5. */
  R.automaticScale = function (runs) {
    let largest = 0, size = 0;
    for (const run of runs) {
      const field = R.fieldIndex(run, "displacement");
      if (field < 0) continue;
      largest = Math.max(largest, R.rangeOf(run, field, "magnitude", run.view.instants.keys())[1]);
      const [low, high] = run.view.box;
      size = Math.max(size, ...high.map((value, axis) => value - low[axis]));
    }
    if (!(largest > 0)) return 1;
    const wanted = (0.1 * size) / largest, power = 10 ** Math.floor(Math.log10(wanted));
    return power * [5, 2, 1].find((digit) => digit * power <= wanted * (1 + 1e-9));
  };
})(window.rubato);
