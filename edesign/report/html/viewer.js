/* The motion of frames in the report: reads the JSON of each `.viewer`, asks the network for nothing. */
"use strict";
(() => {
  const SVG = "http://www.w3.org/2000/svg";
  const short = value => String(Math.round(value * 1000) / 1000);
  const PUSH = [31, 95, 168], PULL = [192, 57, 43], REST = [205, 209, 216]; // colors of dampers by their force
  const TUNED = "#7b3f98";
  /* Signs of supports below a column base at 0, 0; h is half of their size. */
  const bar = (h, y) => `M${short(-1.5 * h)} ${short(y)}H${short(1.5 * h)}`;
  const SIGNS = {
    fixed: h => [-1, 0, 1].reduce((d, i) => `${d}M${short((i + 0.5) * h)} 0L${short((i - 0.3) * h)} ${short(0.7 * h)}`, bar(h, 0)),
    pinned: h => `M0 0L${short(h)} ${short(1.4 * h)}H${short(-h)}Z${bar(h, 1.4 * h)}`,
    roller: h => `M0 0a${short(0.6 * h)} ${short(0.6 * h)} 0 0 1 0 ${short(1.2 * h)}a${short(0.6 * h)} ${short(0.6 * h)} 0 0 1 0 `
      + `${short(-1.2 * h)}Z${bar(h, 1.2 * h)}`,
    springs: h => `M0 0V${short(0.3 * h)}L${short(0.6 * h)} ${short(0.5 * h)}L${short(-0.6 * h)} ${short(0.9 * h)}`
      + `L${short(0.6 * h)} ${short(1.3 * h)}L0 ${short(1.5 * h)}V${short(1.5 * h)}${bar(h, 1.5 * h)}`,
    footing: h => `M${short(-1.5 * h)} 0H${short(1.5 * h)}V${short(h)}H${short(-1.5 * h)}Z`,
  };
  const isWide = ([x0, y0, x1, y1]) => x1 - x0 > 2.5 * (y1 - y0);
  const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5];
  const SHOWN = 4; // variants at first; the others wait for their switch
  const IN_STEPS = 500; // ms between pictures for readers who want less motion
  const reduced = window.matchMedia("(prefers-reduced-motion: reduce)");

  const node = (parent, name, attributes = {}, text = "") => {
    const made = name.startsWith("svg:")
      ? document.createElementNS(SVG, name.slice(4)) : document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== "") made.textContent = text;
    parent.append(made);
    return made;
  };
  const signed = (value, digits) => value.toFixed(digits).replace("-", "\u2212");
  const path = points => points.map((p, i) => `${i ? "L" : "M"}${short(p[0])} ${short(p[1])}`).join("");
  const mixed = (from, to, share) => `rgb(${from.map((c, i) => Math.round(c + share * (to[i] - c))).join(",")})`;

  /* The differences that series are packed as: whole numbers, low bytes before high bytes, deflated. */
  async function unpack(text) {
    const packed = Uint8Array.from(atob(text), character => character.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const count = bytes.length / 2;
    return Int16Array.from({ length: count }, (_, i) => bytes[i] | (bytes[count + i] << 8));
  }

  /* For where some series of equal length are, a function of picture and series that gives the value. */
  const reader = steps => ({ at, n, w, q }) => {
    const whole = new Int32Array(n * w);
    for (let i = 0; i < whole.length; i++) whole[i] = (i % n ? whole[i - 1] : 0) + steps[at + i];
    return (k, i = 0) => whole[i * n + k] * q;
  };

  /* ---- a variant: its frame, and the texts below it ---- */
  class Frame {
    constructor(box, about, read, scene) {
      Object.assign(this, { about, scene });
      for (const name of ["floors", "drift", "drift_max", "drift_min", "ux", "uy", "rz", "rotation", "force", "strokes"]) {
        this[name] = about[name] ? read(about[name]) : null;
      }
      this.storeys = about.drift.w;
      this.figure = node(box, "figure", { class: "moving", "data-analysis": about.analysis });
      if (about.title) node(this.figure, "figcaption", {}, about.title).style.color = about.color;
      this.svg = node(this.figure, "svg:svg", { role: "img" });
      this.label = node(this.svg, "svg:title", {}, `Elevation of the frame ${about.title}, deformed`);
      this.said = node(this.figure, "p", { class: "said" });
      this.ground = node(this.svg, "svg:path", { stroke: "#111", fill: "none" });
      this.unmoved = node(this.svg, "svg:path", { stroke: "#c9ced6", fill: "none" });
      this.base = node(this.svg, "svg:path", { stroke: "#5a5f66", fill: "none" });
      this.signs = about.supports.map(([kind, at]) =>
        node(this.svg, "svg:path", { stroke: "#5a5f66", fill: "#fff", "data-support": kind, "data-node": at }));
      this.springs = node(this.svg, "svg:path", { stroke: "#5a5f66", fill: "none" });
      this.braces = node(this.svg, "svg:path", { stroke: "#5a5f66", fill: "none" });
      this.members = node(this.svg, "svg:path", { stroke: about.color, fill: "none" });
      this.bodies = about.dampers.map(damper =>
        node(this.svg, "svg:path", { fill: "none", "stroke-linecap": "round", "data-damper": damper.name }));
      this.middles = this.bodies.map((_, i) => about.dampers[i].wide ? null : node(this.svg, "svg:circle", { stroke: "#111" }));
      this.masses = about.masses.map(([name]) => node(this.svg, "svg:rect", { fill: TUNED, "data-mass": name }));
      this.rings = about.ends.map(([member, end]) =>
        node(this.svg, "svg:circle", { "data-end": `${about.members[member][0]} ${end ? "end" : "start"}` }));
      this.strongest = 1e-9;
      if (this.force) {
        for (let i = 0; i < about.force.w; i++) {
          for (let k = 0; k < scene.n; k++) this.strongest = Math.max(this.strongest, Math.abs(this.force(k, i)));
        }
      }
      const xs = about.nodes.map(p => p[0]), ys = about.nodes.map(p => p[1]);
      this.box = [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
      this.largest = about.reach;
    }

    /* Room for the largest displacement; y goes up, so that it changes its sign. */
    fit(scale, largest, bottom) {
      const [x0, y0, x1, y1] = this.box, size = Math.max(x1 - x0, y1 - y0), edge = 0.04 * size;
      const aside = scale * largest + edge;
      const ground = this.about.ground, beyond = (this.about.base.length ? 5 : 1.6) * edge;
      this.svg.setAttribute("viewBox", [x0 - aside, -y1 - 2 * edge, x1 - x0 + 2 * aside, y1 - bottom + 3.5 * edge]
        .map(short).join(" "));
      this.unit = size / (isWide(this.box) ? 900 : 300); // about a pixel of a wide frame, which has a line of its own
      const widths = [[this.members, 2.4], [this.unmoved, 1], [this.braces, 1], [this.ground, 1.2], [this.base, 4],
        [this.springs, 1]];
      for (const [element, width] of widths) element.setAttribute("stroke-width", short(width * this.unit * 100) / 100);
      this.unmoved.setAttribute("stroke-dasharray", `${3 * this.unit} ${3 * this.unit}`);
      this.unmoved.setAttribute("d", this.about.members.map(([, a, b]) =>
        path([a, b].map(i => [this.about.nodes[i][0], -this.about.nodes[i][1]]))).join(""));
      this.ground.setAttribute("d", path([-1, 1].map(side => [(side < 0 ? x0 : x1) + side * beyond, -ground])));
      this.bodies.forEach((body, i) => body.setAttribute("stroke-width", (this.about.dampers[i].wide ? 0.6 : 4) * this.unit));
      const { sign: side } = this.about;
      this.masses.forEach(mass => { mass.setAttribute("width", side); mass.setAttribute("height", side); });
      this.signs.forEach(sign => {
        sign.setAttribute("stroke-width", 0.8 * this.unit);
        sign.setAttribute("d", SIGNS[sign.dataset.support](0.5 * side));
      });
    }

    /* Supports of the column bases, and tuned masses on the floors, which move beside them. */
    drawOthers(k, scale, share, at, moved, hung) {
      const next = Math.min(k + 1, this.scene.n - 1), { base, masses, supports } = this.about;
      this.base.setAttribute("d", path(base.map(i => [at[i][0], -at[i][1]])));
      supports.forEach(([kind, i], n) => {
        const turned = kind === "fixed" || kind === "footing" ? -scale * moved[i][2] * 180 / Math.PI : 0;
        this.signs[n].setAttribute("transform",
          `translate(${short(at[i][0])} ${short(-at[i][1])}) rotate(${short(turned)})`);
      });
      const size = this.about.sign, links = [];
      masses.forEach(([, point], i) => {
        const [x, y] = hung(point), now = this.strokes(k, i), stroke = now + share * (this.strokes(next, i) - now);
        const looks = { x: short(x + scale * stroke - size / 2), y: short(-y - size) };
        for (const [key, value] of Object.entries(looks)) this.masses[i].setAttribute(key, value);
        this.masses[i].dataset.stroke = stroke;
        links.push([[x, -y], [x, -y - size / 2], [x + scale * stroke, -y - size / 2]]);
      });
      this.springs.setAttribute("d", links.map(path).join(""));
    }

    /* Displacements and rotation of a node. */
    motion(k, i) {
      if (this.ux) return [this.ux(k, i), this.uy(k, i), this.rz(k, i)];
      const [below, share] = this.about.shares[i];
      return [(1 - share) * this.floors(k, below) + share * this.floors(k, below + 1), 0, 0];
    }

    /* A picture, or in between: a share of the way to the next, on which nodes go straight. */
    draw(k, scale, share = 0) {
      const next = Math.min(k + 1, this.scene.n - 1);
      const moved = this.about.nodes.map((_, i) => {
        const now = this.motion(k, i);
        return share ? this.motion(next, i).map((to, c) => now[c] + share * (to - now[c])) : now;
      });
      const at = this.about.nodes.map(([x, y], i) => [x + scale * moved[i][0], y + scale * moved[i][1]]);
      const curves = this.about.members.map(([name, a, b]) => this.curve(name, a, b, at, moved, scale));
      this.members.setAttribute("d", curves.map(([p, q, r, s]) =>
        `M${short(p[0])} ${short(-p[1])}C${[q, r, s].map(c => `${short(c[0])} ${short(-c[1])}`).join(" ")}`).join(""));
      const hung = ([x, y, a, b, share]) => a < 0 ? [x, y] : [0, 1].map(i =>
        [x, y][i] + scale * ((1 - share) * moved[a][i] + share * moved[b][i]));
      const points = (from, to, span = [0, 1]) => {
        const [p, q] = [hung(from), hung(to)];
        return span.map(s => [p[0] + s * (q[0] - p[0]), -p[1] - s * (q[1] - p[1])]);
      };
      const line = (from, to) => path(points(from, to));
      this.braces.setAttribute("d", this.about.dampers.map(one => one.braces.map(b => line(...b)).join("")).join(""));
      this.about.dampers.forEach((one, i) => {
        const force = this.force ? this.force(k, i) : 0, strength = Math.abs(force) / this.strongest;
        const ends = points(...one.body, one.span), color = mixed(REST, force < 0 ? PUSH : PULL, Math.min(1, strength));
        if (this.force) this.bodies[i].dataset.force = force;
        if (one.wide) { // an isolator shears between ground and base
          const half = one.wide / 2, corners = [[0, -half], [0, half], [1, half], [1, -half]];
          const sheared = path(corners.map(([end, aside]) => [ends[end][0] + aside, ends[end][1]]));
          const looks = { d: `${sheared}Z`, fill: color, stroke: "#111" };
          for (const [key, value] of Object.entries(looks)) this.bodies[i].setAttribute(key, value);
          return;
        }
        this.bodies[i].setAttribute("d", path(ends));
        this.bodies[i].setAttribute("stroke", color);
        const middle = { cx: short((ends[0][0] + ends[1][0]) / 2), cy: short((ends[0][1] + ends[1][1]) / 2),
          r: 4 * this.unit, fill: color, "stroke-width": 0.6 * this.unit };
        for (const [key, value] of Object.entries(middle)) this.middles[i].setAttribute(key, value);
      });
      this.drawOthers(k, scale, share, at, moved, hung);
      const hinges = this.hinges(k, curves);
      this.print(k, hinges);
    }

    /* Ends of a cubic through both ends with the slopes of the nodes, and the two points between that steer it. */
    curve(name, a, b, at, moved, scale) {
      const [p, s] = [at[a], at[b]], [from, to] = [this.about.nodes[a], this.about.nodes[b]];
      const dx = to[0] - from[0], dy = to[1] - from[1], brace = name.startsWith("D_");
      const slope = i => brace ? [s[0] - p[0], s[1] - p[1]]
        : [dx - scale * moved[i][2] * dy, dy + scale * moved[i][2] * dx];
      const [first, last] = [slope(a), slope(b)];
      return [p, [p[0] + first[0] / 3, p[1] + first[1] / 3], [s[0] - last[0] / 3, s[1] - last[1] / 3], s];
    }

    /* Hinges as circles near their ends; without histories of rotations as rings. Returns how many there are. */
    hinges(k, curves) {
      let count = 0;
      this.about.ends.forEach(([member, end], i) => {
        const rotation = this.rotation ? this.rotation(k, i) : this.about.largest[i];
        const rank = this.about.limits[i].filter(limit => rotation >= limit).length;
        const ring = this.rings[i];
        ring.style.display = rank ? "" : "none";
        ring.dataset.rotation = rotation;
        if (!rank) return;
        count += 1;
        const [p, q, r, s] = end ? [...curves[member]].reverse() : curves[member];
        const t = 0.09, w = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3];
        const place = [0, 1].map(c => w[0] * p[c] + w[1] * q[c] + w[2] * r[c] + w[3] * s[c]);
        const color = this.scene.classes[rank - 1][1];
        const looks = { cx: short(place[0]), cy: short(-place[1]), r: (2.2 + 0.9 * rank) * this.unit,
          fill: this.rotation ? color : "none", stroke: this.rotation ? "#111" : color,
          "stroke-width": (this.rotation ? 0.6 : 1.6) * this.unit };
        for (const [key, value] of Object.entries(looks)) ring.setAttribute(key, value);
      });
      return count;
    }

    print(k, hinges) {
      let worst = 0;
      for (let i = 1; i < this.storeys; i++) {
        if (Math.abs(this.drift(k, i)) > Math.abs(this.drift(k, worst))) worst = i;
      }
      const roof = this.floors(k, this.about.floors.w - 1);
      Object.assign(this.figure.dataset, { roof, hinges, drift: this.drift(k, worst), storey: worst + 1 });
      const parts = [`roof ${signed(1e3 * roof, 1)} mm`,
        `drift ${signed(100 * this.drift(k, worst), 2)} % in storey ${worst + 1}`];
      if (this.rotation) parts.push(`${hinges} hinges so far`);
      else if (this.rings.length) parts.push(`${hinges} ends yield`);
      this.said.textContent = parts.join(" · ");
    }
  }

  /* ---- axes of a small diagram: a frame with the ends of its scales ---- */
  class Diagram {
    constructor(box, title, width, height) {
      Object.assign(this, { width, height });
      this.figure = node(box, "figure", { class: "diagram" });
      this.head = node(this.figure, "figcaption");
      node(this.head, "span", {}, title);
      this.svg = node(this.figure, "svg:svg", { viewBox: `0 0 ${width} ${height}`, role: "img" });
      node(this.svg, "svg:title", {}, title);
      this.layer = node(this.svg, "svg:g");
    }

    span(x0, x1, y0, y1, xs, ys, left = 8) {
      this.layer.replaceChildren();
      const [right, top, bottom] = [this.width - 8, 16, this.height - 20];
      this.x = v => left + (v - x0) / (x1 - x0 || 1) * (right - left);
      this.y = v => bottom - (v - y0) / (y1 - y0 || 1) * (bottom - top);
      node(this.layer, "svg:path", { d: `M${left} ${top}H${right}V${bottom}H${left}Z`, fill: "none", stroke: "#d7dce3" });
      for (const zero of [x0 < 0 && `M${short(this.x(0))} ${top}V${bottom}`, y0 < 0 && `M${left} ${short(this.y(0))}H${right}`]) {
        if (zero) node(this.layer, "svg:path", { d: zero, stroke: "#d7dce3" });
      }
      xs.forEach((text, i) => node(this.layer, "svg:text", { x: [left, right][i], y: this.height - 7,
        "text-anchor": ["start", "end"][i] }, text));
      ys.forEach((text, i) => node(this.layer, "svg:text", { x: 8, y: 11 }, text));
    }

    line(looks) {
      return node(this.layer, "svg:path", { fill: "none", "stroke-width": 1.3, "stroke-linejoin": "round", ...looks });
    }
  }

  /* ---- the viewer of one record ---- */
  class Viewer {
    constructor(root, scene, steps, number) {
      Object.assign(this, { root, scene, number, k: scene.peak, speed: 1, scale: scene.scale, playing: false });
      const read = reader(steps);
      this.parts = scene.variants.map(() => []); // of each variant in the diagrams
      this.live = node(root, "div", { class: "live", role: "group", "aria-label": "Motion of the structure" });
      this.controls();
      const [x0, y0, x1, y1] = this.spread();
      const stage = node(this.live, "div", { class: isWide([x0, y0, x1, y1]) ? "stage wide"
        : x1 - x0 > y1 - y0 ? "stage" : "stage tall" });
      const frames = node(stage, "div", { class: "frames" });
      this.frames = scene.variants.map(about => this.moving(frames, about, read));
      this.legend(frames);
      const side = node(stage, "div", { class: "side" });
      this.profile(side);
      this.motion(side, read(scene.ground));
      this.loops(side, read);
      root.append(this.live, root.querySelector(".still"));
      root.classList.add("on");
      this.rescale();
      this.choose();
      this.live.addEventListener("keydown", event => this.key(event));
      document.addEventListener("visibilitychange", () => document.hidden && this.pause());
    }

    moving(box, about, read) {
      return new Frame(box, about, read, this.scene);
    }

    /* The corners of the first frame. */
    spread() {
      const [xs, ys] = [0, 1].map(i => this.scene.variants[0].nodes.map(place => place[i]));
      return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
    }

    controls() {
      const { scene, number } = this, bar = node(this.live, "div", { class: "controls" });
      this.button = node(bar, "button", { type: "button" }, "Play");
      this.button.addEventListener("click", () => this.playing ? this.pause() : this.play());
      this.slider = node(bar, "input", { type: "range", min: 0, max: scene.n - 1, step: 1, value: this.k,
        "aria-label": "time" });
      this.slider.addEventListener("input", () => { this.pause(); this.show(+this.slider.value); });
      this.clock = node(bar, "output", { class: "clock" });
      const choice = (label, values, now, words, chosen) => {
        const box = node(bar, "label", { for: `viewer-${number}-${label}` }, `${label} `);
        const list = node(box, "select", { id: `viewer-${number}-${label}` });
        for (const value of values) node(list, "option", { value }, words(value)).selected = value === now;
        list.addEventListener("change", () => chosen(+list.value));
        return list;
      };
      choice("speed", SPEEDS, this.speed, v => `× ${v}`, v => { this.speed = v; });
      choice("displacements", scene.scales, this.scale, v => `× ${v}`, v => { this.scale = v; this.rescale(); });
      if (scene.variants.length > 1) this.switches();
    }

    /* Which variants are shown; one always is. */
    switches() {
      const bar = node(this.live, "div", { class: "controls variants", role: "group", "aria-label": "variants shown" });
      this.boxes = this.scene.variants.map((about, i) => {
        const label = node(bar, "label"), box = node(label, "input", { type: "checkbox" });
        box.checked = i < SHOWN;
        box.addEventListener("change", () => {
          if (!this.boxes.some(one => one.checked)) box.checked = true;
          this.choose();
        });
        node(label, "span", {}, about.title).style.color = about.color;
        return box;
      });
    }

    choose() {
      this.frames.forEach((frame, i) => {
        frame.off = Boolean(this.boxes && !this.boxes[i].checked);
        for (const part of [frame.figure, ...this.parts[i]]) part.style.display = frame.off ? "none" : "";
      });
      this.show(this.k);
    }

    legend(box) {
      const list = node(box, "ul", { class: "legend" }), { frames, scene } = this;
      const dot = (color, text) => { node(node(list, "li"), "i").style.background = color; list.lastChild.append(text); };
      if (frames.some(f => f.rings.length)) for (const [name, color] of scene.classes) dot(color, `hinge ${name}`);
      if (frames.some(f => f.force)) {
        const most = (Math.max(...frames.map(f => f.force ? f.strongest : 0)) / 1e3).toPrecision(3);
        dot(mixed(PULL, PULL, 0), `${scene.variants.some(v => v.base.length) ? "isolator or " : ""}damper force > 0, to ${+most} kN`);
        dot(mixed(PUSH, PUSH, 0), "force < 0");
      }
      if (frames.some(f => f.masses.length)) dot(TUNED, "tuned mass");
    }

    profile(side, title = "Storey drift; pale: largest so far", frames = this.frames, scaled = frames) {
      const { scene } = this, storeys = Math.max(...frames.map(f => f.storeys));
      let most = 1e-6;
      for (const f of scaled) {
        for (let i = 0; i < f.storeys; i++) {
          most = Math.max(most, f.drift_max(scene.n - 1, i), -f.drift_min(scene.n - 1, i));
        }
      }
      const made = new Diagram(side, title, 300, 210);
      made.span(-most, most, 0, storeys, [`${signed(-100 * most, 2)} %`, `${(100 * most).toFixed(2)} %`], ["storey"], 26);
      const every = Math.ceil(storeys / 12);
      for (let i = 0; i < storeys; i += every) {
        node(made.layer, "svg:text", { x: 20, y: short(made.y(i + 0.5) + 4), "text-anchor": "end" }, i + 1);
      }
      const steps = (f, value) => path(Array.from({ length: f.storeys }, (_, i) =>
        [0, 1].map(up => [made.x(value(i)), made.y(i + up)])).flat());
      const lines = frames.map(f => [0, 1, 2].map(i =>
        made.line({ stroke: f.about.color, opacity: i < 2 ? 0.45 : 1, "stroke-width": i < 2 ? 1.2 : 2 })));
      lines.forEach((own, j) => this.parts[j].push(...own));
      this.drawProfile = k => frames.forEach((f, j) => [f.drift_min, f.drift_max, f.drift].forEach((of, i) =>
        lines[j][i].setAttribute("d", steps(f, storey => of(k, storey)))));
    }

    motion(side, ground, title = "Ground acceleration") {
      const { scene } = this, values = Array.from({ length: scene.n }, (_, k) => ground(k));
      const most = Math.max(1e-9, ...values.map(Math.abs)), end = (scene.n - 1) * scene.dt;
      const made = new Diagram(side, title, 300, 110);
      made.span(0, end, -most, most, ["0 s", `${end.toFixed(1)} s`], [`± ${most.toFixed(2)} m/s²`]);
      made.line({ stroke: "#8a8f98", "stroke-width": 0.8,
        d: path(values.map((v, k) => [made.x(k * scene.dt), made.y(v)])) });
      const cursor = made.line({ stroke: "#c0392b", "stroke-width": 1.5 });
      this.drawCursor = k => cursor.setAttribute("d", `M${short(made.x(k * scene.dt))} 16V${made.height - 20}`);
      made.svg.classList.add("scrub");
      const seek = event => {
        const box = made.svg.getBoundingClientRect();
        const share = ((event.clientX - box.left) / box.width * made.width - 8) / (made.width - 16);
        this.pause();
        this.show(Math.round(share * (scene.n - 1)));
      };
      made.svg.addEventListener("pointerdown", event => { made.svg.setPointerCapture(event.pointerId); seek(event); });
      made.svg.addEventListener("pointermove", event => event.buttons && seek(event));
    }

    loops(side, read) {
      const all = this.scene.variants.flatMap(about => about.loops.map(loop => ({ about, loop })));
      const device = ({ loop }) => /^(damper|isolator) /.test(loop.label);
      all.sort((a, b) => device(b) - device(a));
      this.drawLoop = () => {};
      if (!all.length) return;
      const made = new Diagram(side, "Loop", 300, 210), id = `viewer-${this.number}-loop`;
      made.head.replaceChildren();
      const list = node(node(made.head, "label", { for: id }, "Loop of "), "select", { id });
      all.forEach(({ about, loop }, i) =>
        node(list, "option", { value: i }, [loop.label, about.title].filter(Boolean).join(", ")));
      const chosen = () => {
        const { about, loop } = all[+list.value], [x, y] = [read(loop.x), read(loop.y)], n = loop.x.n;
        let [far, high] = [1e-9, 1e-9];
        for (let k = 0; k < n; k++) { far = Math.max(far, Math.abs(x(k))); high = Math.max(high, Math.abs(y(k))); }
        const [xs, ys] = loop.axes;
        made.span(-far, far, -high, high, [`± ${loop.ends[0]}`, xs], [`± ${loop.ends[1]} · ${ys}`]);
        const points = Array.from({ length: n }, (_, k) => [made.x(x(k)), made.y(y(k))]);
        made.line({ stroke: "#d7dce3", "stroke-width": 0.8, d: path(points) });
        const past = made.line({ stroke: about.color, "stroke-width": 1.1 });
        const point = node(made.layer, "svg:circle", { r: 4, fill: about.color, stroke: "#fff" });
        this.drawLoop = k => {
          const now = Math.min(k * this.scene.finer, n - 1); // loops have points between the pictures
          past.setAttribute("d", path(points.slice(0, now + 1)));
          point.setAttribute("cx", short(points[now][0]));
          point.setAttribute("cy", short(points[now][1]));
          Object.assign(point.dataset, { x: x(now), y: y(now) });
        };
        this.drawLoop(this.k);
      };
      list.addEventListener("change", chosen);
      chosen();
    }

    rescale() {
      const largest = Math.max(...this.frames.map(f => f.largest));
      const bottom = Math.min(...this.frames.map(f => f.about.ground)); // so that the frames stand at one level
      this.frames.forEach(f => f.fit(this.scale, largest, bottom));
      this.show(this.k);
    }

    show(k) {
      this.k = Math.max(0, Math.min(this.scene.n - 1, k));
      const time = this.scene.start + this.k * this.scene.dt;
      this.frames.forEach(f => f.off || f.draw(this.k, this.scale));
      this.drawProfile(this.k);
      this.drawCursor(this.k);
      this.drawLoop(this.k);
      this.slider.value = this.k;
      this.slider.setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
      this.clock.textContent = `${time.toFixed(2)} s`;
      Object.assign(this.root.dataset, { picture: this.k, time });
    }

    play() {
      if (this.k >= this.scene.n - 1) this.show(0);
      this.playing = true;
      this.button.textContent = "Pause";
      let last = null, behind = 0;
      const step = now => {
        if (!this.playing) return;
        const wait = reduced.matches ? IN_STEPS : 1e3 * this.scene.dt / this.speed;
        behind += last === null ? 0 : now - last;
        last = now;
        const on = Math.floor(behind / wait);
        if (on) {
          behind -= on * wait;
          this.show(this.k + (reduced.matches ? 1 : on));
          if (this.k >= this.scene.n - 1) return this.pause();
        }
        if (!reduced.matches) this.frames.forEach(f => f.off || f.draw(this.k, this.scale, behind / wait));
        requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
    }

    pause() {
      if (!this.playing) return;
      this.playing = false;
      this.button.textContent = "Play";
      this.show(this.k);
    }

    key(event) {
      if (event.altKey || event.ctrlKey || event.metaKey || event.target.matches("select, [type=checkbox]")) return;
      const second = Math.max(1, Math.round(1 / this.scene.dt));
      const moves = { ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1, PageDown: -second, PageUp: second,
        Home: -this.scene.n, End: this.scene.n };
      if (event.key === " " && event.target !== this.button) this.playing ? this.pause() : this.play();
      else if (event.key in moves) { this.pause(); this.show(this.k + moves[event.key]); }
      else return;
      event.preventDefault();
    }
  }

  document.querySelectorAll(".viewer").forEach(async (root, number) => {
    try {
      const scene = JSON.parse(root.querySelector("script").textContent);
      const tools = { node, path, short, signed, mixed, Diagram, Viewer, PUSH, PULL, REST, TUNED };
      const Chosen = scene.space ? viewerOfBuildings(tools) : Viewer;
      new Chosen(root, scene, await unpack(scene.data), number);
    } catch (error) { // an old browser: the still stays
      root.querySelector(".live")?.remove();
      root.classList.remove("on");
      root.dataset.failed = String(error);
    }
  });
})();
