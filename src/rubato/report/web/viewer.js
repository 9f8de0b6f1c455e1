// SPDX-License-Identifier: LGPL-3.0-or-later
// The view with its controls: instant, field, range of colours, deformation, bodies, contact status, nodes.
"use strict";
(function (R) {
  const { element } = R;

  class Viewer {
    constructor(place, runs) {
      this.place = place;
      this.runs = runs;
      this.instants = [...new Set(runs.flatMap((run) => run.view.instants))].sort((a, b) => a - b);
      this.state = { instant: this.instants.length - 1, scale: 1, range: "all", status: true, edges: true, together: true };
      this.node = null;
      this.updates = Promise.resolve();
    }

    async build() {
      this.shapes = await Promise.all(this.runs.map(R.shapeOf));
      R.marks.shapes = performance.now();
      const pictures = element("div", { class: "pictures" });
      this.panes = this.runs.map((run, i) => this.pane(pictures, run, i));
      this.nodePanel = element("div", { class: "node-panel" });
      this.place.append(
        element("div", {}, pictures, this.timeRow(), this.nodePanel),
        element("div", { class: "controls" }, this.fieldControls(), this.shapeControls(), this.contactControls(),
          this.bodyControls(), this.lookControls(), this.nodeControls()));
      this.panes.forEach((pane, i) => this.start(pane, i));
      R.marks.canvas = performance.now();
      this.choose("von_mises", "displacement");
      await this.update();
      R.marks.drawn = performance.now();
      let before = performance.now();
      const frame = (now) => {
        const elapsed = now - before;
        before = now;
        for (const pane of this.panes) pane.picture.controls.update(), pane.picture.frame(elapsed);
        window.requestAnimationFrame(frame);
      };
      window.requestAnimationFrame(frame);
    }

    pane(pictures, run, i) {
      const bar = { canvas: element("canvas", { width: "1", height: "256" }), ticks: element("div", { class: "ticks" }),
        what: element("div", { class: "what" }) };
      const caption = element("div", { class: "caption" });
      const axes = element("canvas", { class: "axes", width: "128", height: "128" });
      const box = element("div", { class: "picture" });
      pictures.append(box);
      return { run, box, bar, caption, axes, i };
    }

    /** The canvas can be made when its container has its size. */
    start(pane, i) {
      pane.picture = new R.Picture(pane.run, pane.box, this.shapes[i]);
      pane.box.append(pane.caption, element("div", { class: "bar" }, pane.bar.what, pane.bar.ticks, pane.bar.canvas), pane.axes);
      const context = pane.bar.canvas.getContext("2d"), image = context.createImageData(1, 256);
      for (let y = 0; y < 256; ++y) image.data.set(R.colourTable.subarray(4 * (255 - y), 4 * (256 - y)), 4 * y);
      context.putImageData(image, 0, 0);
      const { picture } = pane;
      picture.controls.addEventListener("change", () => this.moved(pane));
      picture.canvas.addEventListener("keydown", (event) => this.key(pane, event));
      let down = null;
      picture.canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
      picture.canvas.addEventListener("pointerup", (event) => {
        if (!down || event.button !== 0 || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
        const corner = picture.canvas.getBoundingClientRect();
        this.pick(pane, picture.nodeAt(event.clientX - corner.left, event.clientY - corner.top));
      });
    }

    moved(pane) {
      pane.picture.moves();
      this.drawAxes(pane);
      if (!this.state.together) return;
      for (const other of this.panes)
        if (other !== pane) other.picture.follow(pane.picture), other.picture.moves(), this.drawAxes(other);
    }

    key(pane, event) {
      const step = 0.1, turns = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
      if (turns[event.key]) pane.picture.turn(...turns[event.key]);
      else if (event.key === "+" || event.key === "=") pane.picture.zoomBy(1.15);
      else if (event.key === "-") pane.picture.zoomBy(1 / 1.15);
      else return;
      event.preventDefault();
      this.moved(pane);
    }

    timeRow() {
      const last = this.instants.length - 1;
      this.slider = element("input", { type: "range", min: 0, max: last, step: 1, value: last, "aria-label": "Instant",
        oninput: () => this.set({ instant: Number(this.slider.value) }) });
      this.timeText = element("output", { class: "number" });
      this.playing = null;
      const play = element("button", { text: "Play", onclick: () => this.play(play) });
      return element("div", { class: "time" }, play, this.slider, this.timeText);
    }

    play(button) {
      const stop = () => (clearInterval(this.playing), (this.playing = null), (button.textContent = "Play"));
      if (this.playing) return stop();
      button.textContent = "Stop";
      if (this.state.instant === this.instants.length - 1) this.step(0);
      this.playing = setInterval(() => {
        if (this.busy) return;
        if (this.state.instant === this.instants.length - 1) stop();
        else this.step(this.state.instant + 1);
      }, 120);
    }

    step(instant) {
      this.slider.value = instant;
      this.set({ instant });
    }

    fieldNames() {
      return [...new Set(this.runs.flatMap((run) => run.view.fields.map((field) => field.name)))];
    }

    fieldControls() {
      this.fieldSelect = element("select", { "aria-label": "Field", onchange: () => this.choose(this.fieldSelect.value) },
        ...this.fieldNames().map((name) => element("option", { value: name, text: name.replaceAll("_", " ") })),
        element("option", { value: "", text: "none" }));
      this.componentSelect = element("select", { "aria-label": "Component", onchange: () => this.set({ component: this.componentSelect.value }) });
      this.rangeSelect = element("select", { "aria-label": "Range of colours", onchange: () => this.set({ range: this.rangeSelect.value }) },
        element("option", { value: "all", text: "of all instants" }), element("option", { value: "one", text: "of this instant" }),
        element("option", { value: "own", text: "as given" }));
      const bound = (label) => element("input", { type: "number", step: "any", "aria-label": label,
        onchange: () => ((this.rangeSelect.value = "own"), this.set({ range: "own" })) });
      this.low = bound("Least value of the colours");
      this.high = bound("Largest value of the colours");
      return group("Field", this.fieldSelect, this.componentSelect,
        element("label", {}, "Range", this.rangeSelect), element("div", { class: "row" }, this.low, "to", this.high));
    }

    shapeControls() {
      const automatic = R.automaticScale(this.runs);
      this.scaleInput = element("input", { type: "number", step: "any", value: 1, "aria-label": "Scale of the displacement",
        onchange: () => this.set({ scale: Number(this.scaleInput.value) || 0 }) });
      const to = (scale) => () => ((this.scaleInput.value = scale), this.set({ scale }));
      const buttons = element("div", { class: "row" }, element("button", { text: "0", onclick: to(0) }), element("button", { text: "1", onclick: to(1) }),
        element("button", { text: `Automatic (${R.number(automatic)})`, onclick: to(automatic) }));
      const edges = element("input", { type: "checkbox", onchange: () => this.set({ edges: edges.checked }) });
      edges.checked = this.runs.every((run) => run.view.drawn_nodes < 30000);
      this.state.edges = edges.checked;
      return group("Deformation", element("label", {}, "Scale", this.scaleInput), buttons, element("label", {}, edges, "Edges of cells"));
    }

    contactControls() {
      if (!this.runs.some((run) => R.fieldIndex(run, "contact_status") >= 0)) return null;
      const box = element("input", { type: "checkbox", onchange: () => this.set({ status: box.checked }) });
      box.checked = true;
      const colours = R.statusColours.map((rgb) => `rgb(${rgb.map((part) => Math.round(255 * part)).join()})`);
      const legend = R.statusWords.map((word, i) => element("label", {}, element("span", { class: "dot", style: `background:${colours[i]}` }), word));
      return group("Contact status", element("label", {}, box, "At slave nodes, seen through bodies"), ...legend);
    }

    bodyControls() {
      const most = Math.max(...this.runs.map((run) => run.view.bodies));
      if (most < 2 || most > 12) return null;
      const boxes = [...Array(most).keys()].map((body) => {
        const box = element("input", { type: "checkbox", onchange: () => this.panes.forEach((pane) => pane.picture.showBody(body, box.checked)) });
        box.checked = true;
        return element("label", {}, box, `body ${body + 1}`);
      });
      return group("Bodies", ...boxes);
    }

    lookControls() {
      const look = (axis) => () => this.panes.forEach((pane) => (pane.picture.lookAlong(axis), this.drawAxes(pane)));
      const flat = this.runs.every((run) => run.view.dimension === 2);
      const button = (axis, text) => element("button", { text, onclick: look(axis) });
      const buttons = flat ? [button("z", "Reset")]
        : [button("iso", "Reset"), button("x", "along x"), button("y", "along y"), button("z", "along z")];
      const together = element("input", { type: "checkbox", onchange: () => (this.state.together = together.checked) });
      together.checked = true;
      return group("Look", element("div", { class: "row" }, ...buttons),
        this.runs.length > 1 ? element("label", {}, together, "Both move together") : null);
    }

    nodeControls() {
      const input = element("input", { type: "text", placeholder: "N1", "aria-label": "Node" });
      const message = element("span", { class: "soft" });
      const show = () => {
        const node = R.nodeNamed(this.runs[0], this.shapes[0], input.value.trim());
        message.textContent = node < 0 ? `No node ${input.value} is drawn: it is unknown or inside of the body.` : "";
        if (node >= 0) this.pick(this.panes[0], node);
      };
      input.addEventListener("keydown", (event) => event.key === "Enter" && show());
      return group("Node", element("div", { class: "row" }, input, element("button", { text: "Show", onclick: show })), message,
        element("p", { class: "soft", text: "Or click on one in the view." }));
    }

    /** Chooses the first of these fields that there is, with its first component. */
    choose(...names) {
      const name = names.find((word) => word === "" || this.fieldNames().includes(word)) ?? this.fieldNames()[0];
      this.fieldSelect.value = name;
      const run = this.runs.find((candidate) => R.fieldIndex(candidate, name) >= 0);
      const choices = run ? R.choicesOf(run.view.fields[R.fieldIndex(run, name)]) : [];
      this.componentSelect.replaceChildren(...choices.map((choice) => element("option", choice)));
      this.componentSelect.hidden = choices.length < 2;
      return this.set({ field: name, component: choices.length ? choices[0].value : "0" });
    }

    set(changes) {
      Object.assign(this.state, changes);
      return this.update();
    }

    /** One after another; of several that wait, the last one does for all. */
    update() {
      const wanted = (this.wanted = {});
      this.updates = this.updates.then(async () => {
        if (wanted !== this.wanted) return;
        this.busy = true;
        try {
          await this.draw();
        } finally {
          this.busy = false;
        }
      });
      return this.updates;
    }

    time() {
      return this.instants[this.state.instant];
    }

    component() {
      return this.state.component === "magnitude" ? "magnitude" : Number(this.state.component);
    }

    async draw() {
      this.timeText.textContent = `t = ${R.number(this.time())}`;
      const shown = await Promise.all(this.panes.map((pane) => this.valuesFor(pane)));
      const range = this.range(shown);
      shown.forEach(({ instant, displacement, values, status }, i) => {
        const { picture, run, caption } = this.panes[i];
        if (displacement) picture.deform(displacement, this.state.scale);
        picture.showEdges = this.state.edges;
        picture.colour(values, ...range);
        picture.showStatus(this.state.status ? status : null);
        caption.textContent = R.keyed(i, `${run.summary.run}, t = ${R.number(run.view.instants[instant])}` +
          (this.state.scale === 1 ? "" : `, deformation × ${R.number(this.state.scale)}`));
        this.drawBar(this.panes[i], values, range);
        this.drawAxes(this.panes[i]);
      });
      await this.drawNode();
    }

    async valuesFor({ run }) {
      const instant = R.instantAt(run, this.time());
      const field = R.fieldIndex(run, this.state.field), moved = R.fieldIndex(run, "displacement");
      const status = R.fieldIndex(run, "contact_status");
      const categorical = this.state.field === "contact_status";
      return {
        run, instant, field,
        displacement: moved < 0 ? null : await R.componentsOf(run, moved, instant),
        values: field < 0 || categorical ? null : await R.shownValues(run, field, this.component(), instant),
        status: status < 0 ? null : (await R.componentsOf(run, status, instant))[0],
      };
    }

    range(shown) {
      if (this.state.range === "own") return [Number(this.low.value), Number(this.high.value)];
      let [least, largest] = [Infinity, -Infinity];
      for (const { run, field, values } of shown) {
        if (!values) continue;
        const [low, high] = this.state.range === "one" ? R.rangeOf(run, field, this.component(), [], values)
          : R.rangeOf(run, field, this.component(), run.view.instants.keys());
        (least = Math.min(least, low)), (largest = Math.max(largest, high));
      }
      if (least > largest) [least, largest] = [0, 0];
      this.low.value = Number(least.toPrecision(6));
      this.high.value = Number(largest.toPrecision(6));
      return [least, largest];
    }

    drawBar({ bar, box }, values, [least, largest]) {
      box.querySelector(".bar").hidden = !values;
      const field = this.state.field.replaceAll("_", " ");
      const part = this.componentSelect.selectedOptions[0]?.textContent ?? "";
      bar.what.textContent = R.withUnit(part === "value" || part === "" ? field : `${field}, ${part}`, R.fieldUnit(this.state.field));
      const ticks = 6;
      bar.ticks.replaceChildren(...[...Array(ticks).keys()].map((i) =>
        element("span", { text: R.number(largest - ((largest - least) * i) / (ticks - 1), 4) })));
    }

    drawAxes({ axes, picture }) {
      const context = axes.getContext("2d"), names = picture.flat ? "xy" : "xyz", colours = ["#b3261e", "#1a7f43", "#1f5f99"];
      context.clearRect(0, 0, 128, 128);
      context.lineWidth = 4;
      context.font = "24px sans-serif";
      [...names].forEach((name, axis) => {
        const direction = new THREE.Vector3().setComponent(axis, 1).applyQuaternion(picture.camera.quaternion.clone().invert());
        context.strokeStyle = context.fillStyle = colours[axis];
        context.beginPath();
        context.moveTo(50, 78);
        context.lineTo(50 + 40 * direction.x, 78 - 40 * direction.y);
        context.stroke();
        context.fillText(name, 44 + 54 * direction.x, 86 - 54 * direction.y);
      });
    }

    async pick(pane, node) {
      this.node = node < 0 ? null : { pane, node };
      for (const other of this.panes) other.picture.mark(other === pane ? node : -1);
      await this.update();
    }

    async drawNode() {
      if (!this.node) return this.nodePanel.replaceChildren();
      const { pane, node } = this.node, { run, i } = pane, shape = this.shapes[i];
      const size = pane.picture.radius(); // coordinates are kept in single precision
      const rounded = (value) => (Math.abs(value) < 1e-6 * size ? 0 : value);
      const instant = R.instantAt(run, this.time());
      const name = R.nodeName(run, shape, node), place = [0, 1, 2].slice(0, run.view.dimension)
        .map((axis) => R.number(rounded(shape.base[3 * node + axis] + run.view.centre[axis])));
      const rows = await R.valuesAtNode(run, node, instant);
      const table = R.table(["field", "value#", "± #", "unit"], rows.map((row) => [
        row.component ? `${row.field.replaceAll("_", " ")}, ${row.component}` : row.field.replaceAll("_", " "),
        row.field === "contact_status" ? R.statusWords[Math.round(row.value)] ?? "–" : R.number(row.value),
        row.field === "contact_status" ? "" : R.number(row.off, 2), row.unit]));
      this.nodeValues = rows;
      const values = element("div", {}, element("h3", { text: R.keyed(i, `Node ${name} (${place.join(", ")}), t = ${R.number(run.view.instants[instant])}`) }), table);
      const history = element("div");
      this.nodePanel.replaceChildren(values, history);
      await this.drawHistory(history, run, node, name);
    }

    async drawHistory(place, run, node, name) {
      const field = R.fieldIndex(run, this.state.field);
      if (field < 0) return;
      const values = await R.historyOfNode(run, node, field, this.state.component);
      const part = this.componentSelect.selectedOptions[0]?.textContent ?? "";
      const label = part === "value" ? this.state.field : `${this.state.field}.${part}`;
      this.nodeChart = R.chart(place, `History of ${name}`, [{ x: run.view.instants, y: values, label, unit: R.fieldUnit(this.state.field) }], { height: 240 });
    }
  }

  function group(title, ...children) {
    return R.element("fieldset", {}, R.element("legend", { text: title }), ...children);
  }

  /** The view of all runs that have fields; a sentence for those that have none. */
  R.showView = async function (place) {
    const runs = R.data.runs.filter((run) => run.view);
    R.data.runs.forEach((run, i) => {
      if (!run.view) place.before(element("p", { class: "note", text: R.keyed(i, run.no_view) }));
    });
    if (runs.length === 0) return place.classList.add("plain");
    R.viewer = new Viewer(place, runs);
    try {
      await R.viewer.build();
    } catch (error) {
      place.classList.add("plain");
      place.replaceChildren(element("p", { class: "problem", text: `The view cannot be drawn: ${error.message}. It needs WebGL 2 and DecompressionStream: Chromium 80 or Firefox 113, or later.` }));
      throw error;
    }
  };
})(window.rubato);
