// SPDX-License-Identifier: LGPL-3.0-or-later
// One run in a canvas: the deformed faces with a field, edges of faces, contact status, the picked node.
"use strict";
(function (R) {
  const vertexShader = `
    attribute float value;
    varying vec3 place;
    varying float shown;
    void main() {
      vec4 seen = modelViewMatrix * vec4(position, 1.0);
      place = seen.xyz;
      shown = value;
      gl_Position = projectionMatrix * seen;
    }`;
  // Faces are lit from where one looks, each by its own normal. What has no value is grey.
  const fragmentShader = `
    uniform sampler2D colours;
    uniform float least;
    uniform float largest;
    uniform float shading;
    uniform bool plain;
    varying vec3 place;
    varying float shown;
    void main() {
      vec3 colour = vec3(0.78, 0.80, 0.82);
      if (!plain && abs(shown) < 1e37) {
        float part = largest > least ? clamp((shown - least) / (largest - least), 0.0, 1.0) : 0.5;
        colour = texture2D(colours, vec2((part * 255.0 + 0.5) / 256.0, 0.5)).rgb;
      }
      vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
      float light = mix(1.0, 0.45 + 0.55 * abs(normal.z), shading);
      gl_FragColor = vec4(colour * light, 1.0);
    }`;
  const pointVertexShader = `
    attribute vec3 tint;
    uniform float size;
    varying vec3 colour;
    void main() {
      colour = tint;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_PointSize = size;
    }`;
  const pointFragmentShader = `
    varying vec3 colour;
    uniform bool ring;
    void main() {
      float radius = length(gl_PointCoord - 0.5);
      if (radius > 0.5 || (ring && radius < 0.3)) discard;
      gl_FragColor = vec4(radius > 0.38 && !ring ? colour * 0.5 : colour, 1.0);
    }`;

  /** Viridis (M. Zucker's polynomials of the table of S. van der Walt and N. Smith), 256 colours of RGBA. */
  function colourTable() {
    const c = [
      [0.2777273272234177, 0.005407344544966578, 0.3340998053353061],
      [0.1050930431085774, 1.404613529898575, 1.384590162594685],
      [-0.3308618287255563, 0.214847559468213, 0.09509516302823659],
      [-4.634230498983486, -5.799100973351585, -19.33244095627987],
      [6.228269936347081, 14.17993336680509, 56.69055260068105],
      [4.776384997670288, -13.74514537774601, -65.35303263337234],
      [-5.435455855934631, 4.645852612178535, 26.3124352495832],
    ];
    const table = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; ++i) {
      const x = i / 255;
      for (let channel = 0; channel < 3; ++channel) {
        let value = 0;
        for (let power = 6; power >= 0; --power) value = value * x + c[power][channel];
        table[4 * i + channel] = Math.round(255 * Math.min(1, Math.max(0, value)));
      }
      table[4 * i + 3] = 255;
    }
    return table;
  }
  R.colourTable = colourTable();

  R.statusColours = [[0.49, 0.58, 0.67], [0.1, 0.6, 0.31], [0.84, 0.19, 0.12]]; // open, sticks, slips
  R.statusWords = ["open", "sticks", "slips"];

  /** How a picture is simplified while it turns, when it is slow: fewer pixels, no edges, fewer faces. */
  const levels = [
    { pixels: 1, edges: true, coarse: false },
    { pixels: 1, edges: false, coarse: false },
    { pixels: 0.6, edges: false, coarse: false },
    { pixels: 0.6, edges: false, coarse: true },
    { pixels: 0.35, edges: false, coarse: true },
  ];
  const slowFrame = 70, fastFrame = 25; // ms
  const eyeDistance = 3; // from the middle, in radii of the body: it does not change what is seen

  /** Whether no graphics card draws: then every pixel counts. */
  function isDrawnInSoftware(gl) {
    let name = gl.getParameter(gl.RENDERER);
    if (/webkit/i.test(name)) {
      const info = gl.getExtension("WEBGL_debug_renderer_info");
      name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
    }
    return /swiftshader|llvmpipe|software|basic render/i.test(name);
  }

  class Picture {
    constructor(run, container, shape) {
      this.run = run;
      this.view = run.view;
      this.shape = shape;
      this.count = this.view.drawn_nodes;
      this.flat = this.view.dimension === 2;
      this.positions = Float32Array.from(shape.base);
      this.values = new Float32Array(this.count);
      this.hidden = new Set();
      this.turning = false;
      this.dirty = true;
      this.canvas = R.element("canvas", {
        class: "bodies", tabindex: "0", role: "img",
        "aria-label": "The deformed body. Drag to turn, wheel to zoom, right button to move, click to pick a node. " +
          "Arrow keys turn, + and - zoom.",
      });
      container.append(this.canvas);
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: false, preserveDrawingBuffer: true });
      this.renderer.setClearColor(0xf6f7f8);
      // Lines are smooth by drawing more pixels than are shown, not by the canvas: that could not be changed later.
      this.finest = isDrawnInSoftware(this.renderer.getContext()) ? window.devicePixelRatio : Math.max(2, window.devicePixelRatio);
      this.renderer.info.autoReset = true;
      this.scene = new THREE.Scene();
      this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -10, 10);
      this.buildBodies();
      this.buildMarkers();
      this.controls = new THREE.TrackballControls(this.camera, this.canvas);
      Object.assign(this.controls, { staticMoving: true, rotateSpeed: 3, zoomSpeed: 5, noRotate: this.flat,
        keys: ["", "", ""] });
      if (this.flat) this.controls.mouseButtons.LEFT = 2; // moves
      new ResizeObserver(() => this.resize()).observe(container);
      this.resize();
      this.lookAlong(this.flat ? "z" : "iso");
    }

    buildBodies() {
      const geometry = new THREE.BufferGeometry();
      this.positionAttribute = new THREE.BufferAttribute(this.positions, 3);
      this.valueAttribute = new THREE.BufferAttribute(this.values, 1);
      geometry.setAttribute("position", this.positionAttribute);
      geometry.setAttribute("value", this.valueAttribute);
      const texture = new THREE.DataTexture(R.colourTable, 256, 1);
      texture.needsUpdate = true;
      this.material = new THREE.ShaderMaterial({
        vertexShader, fragmentShader, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
        uniforms: { colours: { value: texture }, least: { value: 0 }, largest: { value: 1 },
          shading: { value: this.flat ? 0 : 1 }, plain: { value: false } },
      });
      this.faces = new THREE.Mesh(geometry, this.material);
      this.faces.frustumCulled = false;
      this.fullIndex = new THREE.BufferAttribute(this.shape.corners, 1);
      geometry.setIndex(this.fullIndex);
      const lines = new THREE.BufferGeometry();
      lines.setAttribute("position", this.positionAttribute);
      lines.setIndex(new THREE.BufferAttribute(this.shape.ends, 1));
      this.edges = new THREE.LineSegments(lines, new THREE.ShaderMaterial({
        vertexShader: "void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
        fragmentShader: "void main() { gl_FragColor = vec4(0.16, 0.19, 0.22, 1.0); }",
      }));
      this.edges.frustumCulled = false;
      this.showEdges = this.count < 30000;
      this.scene.add(this.faces, this.edges);
    }

    points(count, size, ring) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
      geometry.setAttribute("tint", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
      const points = new THREE.Points(geometry, new THREE.ShaderMaterial({
        vertexShader: pointVertexShader, fragmentShader: pointFragmentShader, depthTest: false,
        uniforms: { size: { value: size }, ring: { value: ring } },
      }));
      points.userData.size = size; // in pixels of the screen
      points.frustumCulled = false;
      points.visible = false;
      this.scene.add(points);
      return points;
    }

    buildMarkers() {
      const count = this.shape.contact.length;
      this.status = this.points(count, count > 2000 ? 4 : count > 300 ? 6 : 9, false);
      this.picked = this.points(1, 18, true);
      this.picked.renderOrder = 2;
      this.status.renderOrder = 1;
      this.picked.geometry.attributes.tint.array.set([0.85, 0.0, 0.55]);
      this.pickedNode = -1;
    }

    /** Moves the nodes by `scale` times the displacement: an array of components, each an array of nodes. */
    deform(components, scale) {
      const { base } = this.shape;
      for (let i = 0, at = 0; i < this.count; ++i)
        for (let axis = 0; axis < 3; ++axis, ++at)
          this.positions[at] = base[at] + (axis < components.length && components[axis] ? scale * components[axis][i] : 0);
      this.positionAttribute.needsUpdate = true;
      this.placeMarkers();
      this.dirty = true;
    }

    /** Colours the nodes; null draws plain bodies. */
    colour(values, least, largest) {
      const uniforms = this.material.uniforms;
      uniforms.plain.value = values === null;
      if (values !== null) {
        for (let i = 0; i < this.count; ++i) this.values[i] = Number.isNaN(values[i]) ? 3e38 : values[i];
        this.valueAttribute.needsUpdate = true;
        uniforms.least.value = least;
        uniforms.largest.value = largest;
      }
      this.dirty = true;
    }

    /** `statuses`: of every node 0 open, 1 sticks, 2 slips; null hides the marks. */
    showStatus(statuses) {
      this.status.visible = statuses !== null && this.shape.contact.length > 0;
      if (statuses !== null) {
        const tint = this.status.geometry.attributes.tint;
        this.shape.contact.forEach((node, i) => tint.array.set(R.statusColours[Math.round(statuses[node])] || [0, 0, 0], 3 * i));
        tint.needsUpdate = true;
      }
      this.dirty = true;
    }

    placeMarkers() {
      const place = (points, nodes) => {
        const attribute = points.geometry.attributes.position;
        nodes.forEach((node, i) => attribute.array.set(this.positions.subarray(3 * node, 3 * node + 3), 3 * i));
        attribute.needsUpdate = true;
      };
      place(this.status, this.shape.contact);
      if (this.pickedNode >= 0) place(this.picked, [this.pickedNode]);
    }

    mark(node) {
      this.pickedNode = node;
      this.picked.visible = node >= 0;
      this.placeMarkers();
      this.dirty = true;
    }

    /** Shows or hides one body. */
    showBody(body, shown) {
      if (shown) this.hidden.delete(body);
      else this.hidden.add(body);
      const kept = (indices, width) => {
        if (this.hidden.size === 0) return indices;
        const some = [];
        for (let i = 0; i < indices.length; i += width)
          if (!this.hidden.has(this.shape.bodies[indices[i]])) for (let k = 0; k < width; ++k) some.push(indices[i + k]);
        return Uint32Array.from(some);
      };
      this.fullIndex = new THREE.BufferAttribute(kept(this.shape.corners, 3), 1);
      this.coarseIndex = undefined;
      this.faces.geometry.setIndex(this.fullIndex);
      this.edges.geometry.setIndex(new THREE.BufferAttribute(kept(this.shape.ends, 2), 1));
      this.dirty = true;
    }

    /** Fewer triangles on the same nodes: of the nodes in each cell of a grid one stands for all. */
    coarse() {
      if (this.coarseIndex) return this.coarseIndex;
      const { base, bodies } = this.shape, index = this.fullIndex.array;
      const grid = 60, [low, high] = this.view.box, middle = this.view.centre;
      const size = Math.max(...high.map((value, axis) => value - low[axis])) / grid || 1;
      const stand = new Map(), standFor = new Uint32Array(this.count), places = grid + 1;
      for (let i = 0; i < this.count; ++i) {
        let cell = bodies[i];
        for (let axis = 0; axis < 3; ++axis) cell = cell * places + Math.round((base[3 * i + axis] + middle[axis] - low[axis]) / size);
        if (!stand.has(cell)) stand.set(cell, i);
        standFor[i] = stand.get(cell);
      }
      const seen = new Map(), corners = []; // by two corners the third ones
      for (let i = 0; i < index.length; i += 3) {
        const three = [standFor[index[i]], standFor[index[i + 1]], standFor[index[i + 2]]];
        const [a, b, c] = three.slice().sort((x, y) => x - y);
        if (a === b || b === c) continue;
        const key = a * this.count + b, thirds = seen.get(key);
        if (thirds?.includes(c)) continue;
        if (thirds) thirds.push(c);
        else seen.set(key, [c]);
        corners.push(...three);
      }
      this.coarseIndex = new THREE.BufferAttribute(Uint32Array.from(corners), 1);
      return this.coarseIndex;
    }

    radius() {
      const [low, high] = this.view.box;
      return 0.5 * Math.hypot(...high.map((value, axis) => value - low[axis])) || 1;
    }

    resize() {
      const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
      if (!width || !height) return;
      this.size = { width, height };
      this.applySize(1);
      this.setFrustum();
      this.controls.handleResize();
      // Of three's factors those that make the body follow the pointer (TrackballControls, _panCamera).
      this.controls.panSpeed = this.size.width / (eyeDistance * this.radius());
      this.dirty = true;
    }

    applySize(pixels) {
      const ratio = pixels === 1 ? this.finest : pixels;
      this.renderer.setPixelRatio(ratio);
      for (const points of [this.status, this.picked]) points.material.uniforms.size.value = points.userData.size * ratio;
      this.renderer.setSize(this.size.width, this.size.height, false);
    }

    /** Half of the height that the view shows at zoom 1, such that the whole body is seen. */
    setFrustum() {
      const aspect = this.size.width / this.size.height, radius = this.radius();
      let half = radius / Math.min(1, aspect);
      if (this.flat) {
        const [low, high] = this.view.box;
        half = Math.max((high[1] - low[1]) / 2, (high[0] - low[0]) / 2 / aspect) * 1.25 || radius;
      }
      Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half,
        near: -100 * radius, far: 200 * radius });
      this.camera.updateProjectionMatrix();
    }

    /** Looks against axis x, y or z, or from a corner, at the whole body. */
    lookAlong(axis) {
      const from = { x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1], iso: [0.35, 0.4, 0.847] }[axis];
      const up = { x: [0, 0, 1], y: [0, 0, 1], z: [0, 1, 0], iso: [0, 1, 0] }[axis];
      this.controls.target.set(0, 0, 0);
      this.camera.position.set(...from.map((value) => eyeDistance * this.radius() * value));
      this.camera.up.set(...up);
      this.camera.zoom = 1;
      this.camera.lookAt(0, 0, 0);
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.dirty = true;
    }

    /** Takes over where another picture looks from, both bodies at the same size on the screen. */
    follow(other) {
      const ratio = this.radius() / other.radius();
      this.camera.position.copy(other.camera.position).multiplyScalar(ratio);
      this.camera.up.copy(other.camera.up);
      this.controls.target.copy(other.controls.target).multiplyScalar(ratio);
      this.camera.zoom = other.camera.zoom;
      this.camera.quaternion.copy(other.camera.quaternion);
      this.camera.updateProjectionMatrix();
      this.dirty = true;
    }

    /** Turns about the screen's axes, in radians, or zooms. */
    turn(right, up) {
      if (this.flat) return;
      const offset = this.camera.position.clone().sub(this.controls.target);
      const x = new THREE.Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion);
      const y = new THREE.Vector3(0, 1, 0).applyQuaternion(this.camera.quaternion);
      const spin = new THREE.Quaternion().setFromAxisAngle(y, -right)
        .multiply(new THREE.Quaternion().setFromAxisAngle(x, up));
      this.camera.position.copy(this.controls.target).add(offset.applyQuaternion(spin));
      this.camera.up.applyQuaternion(spin);
      this.camera.lookAt(this.controls.target);
      this.dirty = true;
    }

    zoomBy(factor) {
      this.camera.zoom *= factor;
      this.camera.updateProjectionMatrix();
      this.dirty = true;
    }

    /** Draws when there is something new. `elapsed`: ms since the frame before. */
    frame(elapsed) {
      const now = performance.now();
      if (this.turning && this.settledAt !== undefined && now > this.settledAt) this.turning = false, (this.dirty = true);
      if (!this.dirty) return;
      this.dirty = false;
      if (this.turning) this.adapt(elapsed);
      this.render();
    }

    /** The picture moves: it may be simplified until it has stood still for a while. */
    moves() {
      if (this.level === undefined) this.measure();
      if (!this.turning) this.framesSinceChange = 0;
      this.turning = true;
      this.settledAt = performance.now() + 250;
      this.dirty = true;
    }

    /** Draws once and waits for it; a picture that takes long starts simplified when it turns. */
    measure() {
      const gl = this.renderer.getContext(), start = performance.now();
      this.render();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      const taken = performance.now() - start;
      this.level = taken > 3 * slowFrame ? 3 : taken > slowFrame ? 1 : 0;
      if (this.level === 3) this.coarse();
      return taken;
    }

    adapt(elapsed) {
      if (++this.framesSinceChange < 3) return;
      this.mean = this.framesSinceChange === 3 ? elapsed : 0.7 * this.mean + 0.3 * elapsed;
      if (this.framesSinceChange < 5) return;
      if (this.mean > slowFrame && this.level + 1 < levels.length) ++this.level, (this.framesSinceChange = 0);
      else if (this.mean < fastFrame && this.level > 0 && this.framesSinceChange > 60) --this.level, (this.framesSinceChange = 0);
    }

    render() {
      const level = this.turning ? levels[this.level] : levels[0];
      if (level !== this.drawn) {
        this.applySize(level.pixels);
        this.faces.geometry.setIndex(level.coarse ? this.coarse() : this.fullIndex);
        this.drawn = level;
      }
      this.edges.visible = this.showEdges && level.edges;
      this.renderer.render(this.scene, this.camera);
    }

    /** Where a node is seen: x and y in pixels from the upper left, depth growing away. */
    screenOf(node) {
      const place = new THREE.Vector3(...this.positions.subarray(3 * node, 3 * node + 3)).project(this.camera);
      return { x: (place.x + 1) / 2 * this.size.width, y: (1 - place.y) / 2 * this.size.height, depth: place.z };
    }

    /** The node nearest to a place on the canvas, of the foremost face there; −1 beside the body. */
    nodeAt(x, y) {
      this.camera.updateMatrixWorld();
      const matrix = new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse).elements;
      const seen = new Float32Array(3 * this.count);
      for (let i = 0; i < 3 * this.count; i += 3) {
        const [a, b, c] = [this.positions[i], this.positions[i + 1], this.positions[i + 2]];
        seen[i] = ((matrix[0] * a + matrix[4] * b + matrix[8] * c + matrix[12] + 1) / 2) * this.size.width;
        seen[i + 1] = ((1 - (matrix[1] * a + matrix[5] * b + matrix[9] * c + matrix[13])) / 2) * this.size.height;
        seen[i + 2] = matrix[2] * a + matrix[6] * b + matrix[10] * c + matrix[14];
      }
      const index = this.fullIndex.array;
      let best = -1, bestDepth = Infinity;
      for (let i = 0; i < index.length; i += 3) {
        const depth = depthIn(seen, index[i], index[i + 1], index[i + 2], x, y);
        if (depth < bestDepth) (bestDepth = depth), (best = i);
      }
      if (best < 0) return this.nodeNear(seen, x, y);
      const distance = (node) => Math.hypot(seen[3 * node] - x, seen[3 * node + 1] - y);
      return [index[best], index[best + 1], index[best + 2]].reduce((a, b) => (distance(a) <= distance(b) ? a : b));
    }

    /** A click just beside the body means the node on its border. */
    nodeNear(seen, x, y) {
      let best = -1, nearest = 8;
      for (let i = 0; i < this.count; ++i) {
        const distance = Math.hypot(seen[3 * i] - x, seen[3 * i + 1] - y);
        if (distance < nearest && !this.hidden.has(this.shape.bodies[i])) (nearest = distance), (best = i);
      }
      return best;
    }
  }

  /** The depth of a triangle at a place, Infinity beside it. */
  function depthIn(seen, a, b, c, x, y) {
    const ax = seen[3 * a] - x, ay = seen[3 * a + 1] - y, bx = seen[3 * b] - x, by = seen[3 * b + 1] - y;
    const cx = seen[3 * c] - x, cy = seen[3 * c + 1] - y;
    const u = bx * cy - cx * by, v = cx * ay - ax * cy, w = ax * by - bx * ay;
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) return Infinity;
    const sum = u + v + w;
    return sum === 0 ? Infinity : (u * seen[3 * a + 2] + v * seen[3 * b + 2] + w * seen[3 * c + 2]) / sum;
  }

  R.Picture = Picture;
})(window.rubato);
