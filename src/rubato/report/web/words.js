// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers, units and small pieces of the page. The program knows no units: they are given as length, time, force.
"use strict";
(function (R) {
  /** A number as the page shows it: six digits unless told otherwise. */
  R.number = function (value, digits = 6) {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (typeof value !== "number") return String(value);
    if (value === 0) return "0";
    if (Number.isInteger(value) && Math.abs(value) < 1e6) return String(value);
    const text = value.toPrecision(digits);
    const [mantissa, exponent] = text.split("e");
    const short = mantissa.includes(".") ? mantissa.replace(/0+$/, "").replace(/\.$/, "") : mantissa;
    return exponent === undefined ? short : short + "e" + exponent.replace("+", "");
  };

  const fieldUnits = {
    displacement: "length", velocity: "length/time", acceleration: "length/time²", reaction: "force",
    stress: "force/length²", von_mises: "force/length²", tresca: "force/length²", mean_stress: "force/length²",
    principal_stress: "force/length²", contact_pressure: "force/length²", contact_gap: "length",
    contact_slip: "length", contact_cumulated_slip: "length", contact_friction_work: "force·length",
  };
  const resultantUnits = {
    in_contact: "points", sticking: "points", normal: "force", friction: "force",
    largest_pressure: "force/length²", smallest_gap: "length",
  };

  R.fieldUnit = (name) => fieldUnits[name] || "";
  /** The unit of a column of a table: its dimension in length, time and force. */
  R.columnUnit = function (run, table, column) {
    if (table.kind === "energy") return "force·length";
    if (table.kind === "resultants") return resultantUnits[column] || (column.startsWith("force") ? "force" : "");
    const probes = run.study.probes || {};
    const name = column in probes ? column : column.slice(0, column.lastIndexOf("."));
    return probes[name] ? R.fieldUnit(probes[name].field || "displacement") : "";
  };
  R.withUnit = (text, unit) => (unit ? `${text} [${unit}]` : text);

  /** An element: tag, properties (class, text, on…), children. */
  R.element = function (tag, properties = {}, ...children) {
    const node = document.createElement(tag);
    for (const [key, value] of Object.entries(properties)) {
      if (key === "class") node.className = value;
      else if (key === "text") node.textContent = value;
      else if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
      else if (value === true) node.setAttribute(key, "");
      else if (value !== false && value !== undefined) node.setAttribute(key, value);
    }
    node.append(...children.filter((child) => child !== null && child !== undefined));
    return node;
  };

  /** A table of texts; columns whose head ends with # hold numbers. */
  R.table = function (heads, rows) {
    const numeric = heads.map((head) => head.endsWith("#"));
    const cell = (tag, text, c) => R.element(tag, { class: numeric[c] ? "number" : "" },
      text instanceof Node ? text : String(text));
    return R.element("table", {},
      R.element("thead", {}, R.element("tr", {}, ...heads.map((head, c) => cell("th", head.replace(/#$/, ""), c)))),
      R.element("tbody", {}, ...rows.map((row) => R.element("tr", {}, ...row.map((text, c) => cell("td", text, c))))));
  };

  /** What tells two runs apart: A and B; nothing where there is one. */
  R.key = (index) => (R.data.runs.length > 1 ? "AB"[index] : "");
  R.keyed = (index, text) => (R.key(index) ? `${R.key(index)}: ${text}` : text);
})(window.rubato);
