/* The motion of whole buildings, in perspective: stands before viewer.js in pages that show one, and takes its tools. */
"use strict";
const viewerOfBuildings = ({ node, path, short, signed, mixed, Diagram, Viewer, PUSH, PULL, REST, TUNED }) => {
  const DEGREE = Math.PI / 180, AXES = ["x", "y"];
  const FAR = 4, PARALLEL = 1e4; // from the eye to the middle of the building, in its larger half side
  const STEP = 5, NEARER = 1.15, NEAREST = 8; // degrees and factor of a key; the largest factor
  const PARTS = 6; // of a member that bends
  const AT_END = 0.3; // of the length of a member, in the color of the hinge at its end
  const VIEWS = { corner: [30, 18, FAR], "along x": [0, 0, PARALLEL], "along y": [90, 0, PARALLEL], plan: [0, 90, PARALLEL] };
  const HELP = "turns by drag and arrow keys, nearer by pinch, plus and minus; 0, 1, 2, 3: the views of the list";

  const plus = (p, q, share = 1) => [p[0] + share * q[0], p[1] + share * q[1], p[2] + share * q[2]];
  const minus = (p, q) => plus(p, q, -1);
  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const between = (p, q, share) => plus(p, minus(q, p), share);

  /* The eye: x to the right and y away from it at a turn of 0, z up. All buildings of a scene are seen by one. */
  class Eye {
    constructor() {
      this.seen = []; // called when it moves
      this.set(...VIEWS.corner);
    }

    set(turn, tilt, far, near = 1) {
      Object.assign(this, { far, turn: ((turn + 180) % 360 + 360) % 360 - 180, tilt: Math.max(-20, Math.min(90, tilt)),
        near: Math.max(1 / NEAREST, Math.min(NEAREST, near)) });
      this.seen.forEach(draw => draw());
    }

    move(turn, tilt, nearer = 1) {
      this.set(this.turn + turn, this.tilt + tilt, this.far, this.near * nearer);
    }

    /* The function that gives where a point is drawn, in px from the middle and down, and how far it is from the eye, m. */
    projection(middle, half, width, height) {
      const [a, e] = [this.turn * DEGREE, this.tilt * DEGREE], [sa, ca, se, ce] = [Math.sin(a), Math.cos(a), Math.sin(e), Math.cos(e)];
      const right = [ca, sa, 0], up = [-se * sa, se * ca, ce], towards = [ce * sa, -ce * ca, se];
      const wide = Math.hypot(half[0], half[1]), far = this.far * Math.max(wide, half[2]);
      const high = Math.max(...[[1, 1], [1, -1], [-1, 1], [-1, -1]].map(([s, t]) => // of the cylinder around it, at a distance of 1
        Math.abs(t * half[2] * ce - s * wide * se) / (far - s * wide * ce - t * half[2] * se)));
      this.away = far;
      const px = this.near * Math.min(width / 2 * Math.sqrt(far * far - wide * wide) / wide, height / 2 / high);
      return p => {
        const d = minus(p, middle), depth = far - dot(d, towards), scale = px / depth;
        return [width / 2 + scale * dot(d, right), height / 2 - scale * dot(d, up), depth];
      };
    }
  }

  /* ---- a variant: its building on a canvas, and the texts below it ---- */
  class Building {
    constructor(box, about, read, scene, eye) {
      Object.assign(this, { about, scene, eye, rings: about.ends, last: [0, 1, 0], fingers: new Map() });
      for (const name of ["floors", "drift", "drift_max", "drift_min", "uz", "rx", "ry", "ux", "uy", "rz", "rotation", "force",
        "deformation", "strokes"]) this[name] = about[name] ? read(about[name]) : null;
      this.bodies = about.bodies.map(({ nodes, at, moved, turn }) => ({ nodes, at, moved: read(moved), turn: read(turn) }));
      this.storeys = about.drift.w / 2;
      this.worked = this.deformation || this.force;
      this.most = 1e-9;
      const worked = about.deformation || about.force;
      for (let i = 0; worked && i < worked.w; i++) {
        for (let k = 0; k < scene.n; k++) this.most = Math.max(this.most, Math.abs(this.worked(k, i)));
      }
      this.figure = node(box, "figure", { class: "moving", "data-analysis": about.analysis });
      if (about.title) node(this.figure, "figcaption", {}, about.title).style.color = about.color;
      this.canvas = node(this.figure, "canvas", { tabindex: 0, role: "application",
        "aria-label": `The building ${about.title}, deformed; ${HELP}`, title: HELP });
      this.said = node(this.figure, "p", { class: "said" });
      const corner = side => [0, 1, 2].map(c => side(...about.nodes.map(p => p[c])));
      [this.low, this.high] = [corner(Math.min), corner(Math.max)];
      this.largest = about.reach;
      const free = new Set(about.hinged.map(([member, end]) => 2 * member + end));
      this.hinged = about.members.map((_, i) => [free.has(2 * i), free.has(2 * i + 1)]);
      this.layer = z => about.levels.findIndex(level => level > z - 1e-3);
      this.order = about.members.map(([, a, b]) => { // storey by storey: columns and braces, the slab, the beams on it
        const [low, high] = [about.nodes[a][2], about.nodes[b][2]];
        return 3 * this.layer(Math.max(low, high)) + (Math.abs(high - low) < 1e-3 ? 2 : 0);
      });
      this.each = Math.ceil(about.slabs.length / 12); // of the floors, one has its number written
      this.ends = about.members.map(() => [-1, -1]);
      about.ends.forEach(([member, end], i) => { this.ends[member][end] = i; });
      eye.seen.push(() => this.draw(...this.last));
      new ResizeObserver(() => this.draw(...this.last)).observe(this.canvas);
      this.listen();
    }

    /* Drag, pinch and keys. A finger that moves up or down first scrolls the page. */
    listen() {
      const { canvas, eye, fingers } = this;
      const spread = () => { const [a, b] = [...fingers.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
      canvas.addEventListener("pointerdown", event => {
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, [event.clientX, event.clientY]);
      });
      canvas.addEventListener("pointermove", event => {
        const from = fingers.get(event.pointerId), to = [event.clientX, event.clientY];
        if (!from) return;
        const before = fingers.size === 2 ? spread() : 1;
        fingers.set(event.pointerId, to);
        const nearer = fingers.size === 2 ? spread() / (before || 1) : 1, each = 0.4 / fingers.size;
        eye.move(-each * (to[0] - from[0]), each * (to[1] - from[1]), nearer);
      });
      for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => fingers.delete(event.pointerId));
      canvas.addEventListener("wheel", event => {
        if (!event.ctrlKey) return; // the page scrolls
        event.preventDefault();
        eye.move(0, 0, Math.exp(-0.01 * event.deltaY));
      }, { passive: false });
      canvas.addEventListener("dblclick", () => eye.set(...VIEWS.corner));
      canvas.addEventListener("keydown", event => {
        if (event.altKey || event.ctrlKey || event.metaKey) return;
        const moves = { ArrowLeft: [STEP, 0], ArrowRight: [-STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP],
          "+": [0, 0, NEARER], "=": [0, 0, NEARER], "-": [0, 0, 1 / NEARER] };
        const view = Object.values(VIEWS)[event.key];
        if (event.key in moves) eye.move(...moves[event.key]);
        else if (view) eye.set(...view);
        else return;
        event.preventDefault();
        event.stopPropagation();
      });
    }

    along(d) {
      const of = name => (k, i) => this[name](k, 2 * i + d);
      return { about: this.about, storeys: this.storeys, drift: of("drift"), drift_max: of("drift_max"), drift_min: of("drift_min") };
    }

    /* Room for the largest displacement. */
    fit(scale, largest) {
      const aside = this.aside = scale * largest;
      this.middle = between(this.low, this.high, 0.5);
      this.half = [0, 1, 2].map(c => (this.high[c] - this.low[c]) / 2 + (c < 2 ? aside : 0));
      this.room = 1 + 0.06 * Math.max(...this.half); // m around it, for the names of lines
      const wide = Math.hypot(this.half[0], this.half[1]), shape = wide / (this.half[2] + 0.35 * wide);
      this.canvas.style.aspectRatio = Math.max(0.75, Math.min(1.7, shape)).toFixed(3);
    }

    /* Displacement and rotation of every node: of a level that is rigid in plan by its motion, of others by their own. */
    motion(k) {
      const moved = this.about.nodes.map((_, i) => [0, 0, this.uz(k, i), this.rx(k, i), this.ry(k, i), 0]);
      for (const { nodes, at, moved: way, turn } of this.bodies) {
        const [ux, uy, rz] = [way(k, 0), way(k, 1), turn(k)];
        for (const i of nodes) {
          const [x, y] = this.about.nodes[i];
          [moved[i][0], moved[i][1], moved[i][5]] = [ux - rz * (y - at[1]), uy + rz * (x - at[0]), rz];
        }
      }
      this.about.loose.forEach((i, n) => [moved[i][0], moved[i][1], moved[i][5]] = [this.ux(k, n), this.uy(k, n), this.rz(k, n)]);
      return moved;
    }

    /* Points of a member: a cubic through both ends with the slopes of the nodes, straight between hinges. */
    curve(number, at, moved, scale) {
      const [, a, b] = this.about.members[number], [p, s] = [at[a], at[b]], free = this.hinged[number];
      if (free[0] && free[1]) return [p, s];
      const axis = minus(this.about.nodes[b], this.about.nodes[a]), chord = minus(s, p);
      const slopes = [a, b].map(i => plus(axis, cross(moved[i].slice(3), axis), scale));
      for (const end of [0, 1]) if (free[end]) slopes[end] = [0, 1, 2].map(c => 1.5 * chord[c] - 0.5 * slopes[1 - end][c]);
      return Array.from({ length: PARTS + 1 }, (_, i) => {
        const t = i / PARTS, w = [t * (1 - t) ** 2, t * t * (3 - 2 * t), t * t * (t - 1)];
        return [0, 1, 2].map(c => p[c] + w[0] * slopes[0][c] + w[1] * chord[c] + w[2] * slopes[1][c]);
      });
    }

    /* A picture, or in between: a share of the way to the next, on which nodes go straight. */
    draw(k, scale, share = 0) {
      this.last = [k, scale, share];
      if (this.off) return;
      const { canvas, about } = this, width = canvas.clientWidth, height = canvas.clientHeight;
      const moved = this.motion(k), next = Math.min(k + 1, this.scene.n - 1);
      if (share) this.motion(next).forEach((to, i) => to.forEach((value, c) => moved[i][c] += share * (value - moved[i][c])));
      const ranks = this.ranks(k);
      this.print(k, ranks.filter(rank => rank).length);
      if (!width || !this.half) return;
      const sharp = window.devicePixelRatio || 1;
      if (canvas.width !== Math.round(width * sharp)) canvas.width = Math.round(width * sharp);
      if (canvas.height !== Math.round(height * sharp)) canvas.height = Math.round(height * sharp);
      const pen = canvas.getContext("2d", { alpha: false }), colors = this.colors();
      pen.setTransform(sharp, 0, 0, sharp, 0, 0);
      Object.assign(pen, { fillStyle: colors.paper, globalAlpha: 1 });
      pen.fillRect(0, 0, width, height);
      Object.assign(pen, { lineCap: "round", lineJoin: "round", font: `12px ${getComputedStyle(canvas).fontFamily}`,
        textAlign: "center", textBaseline: "middle" });
      const half = this.half.map(side => side + this.room);
      const see = this.see = this.eye.projection(this.middle, half, width, height);
      const at = about.nodes.map((p, i) => plus(p, moved[i], scale));
      canvas.at = at.map(see); // px
      Object.assign(canvas.dataset, { turn: this.eye.turn, tilt: this.eye.tilt, near: this.eye.near, away: this.eye.away });
      this.drawGround(pen, see, colors);
      const depths = canvas.at.map(p => p[2]), near = Math.min(...depths), deep = Math.max(...depths) - near || 1;
      const faded = depth => 1 - 0.62 * Math.max(0, Math.min(1, (depth - near) / deep)); // the farther, the paler
      canvas.lines = about.members.map((_, i) => this.curve(i, at, moved, scale).map(see));
      const parts = canvas.lines.map((points, i) => {
        const depth = (points[0][2] + points[points.length - 1][2]) / 2;
        return { layer: this.order[i], depth, draw: () => this.drawMember(pen, i, points, faded(depth), ranks, colors) };
      });
      about.slabs.forEach((panels, floor) => parts.push({ layer: 3 * (floor + 1) + 1, depth: 0, draw: () => {
        pen.beginPath();
        for (const panel of panels) {
          panel.forEach((i, n) => pen[n ? "lineTo" : "moveTo"](canvas.at[i][0], canvas.at[i][1]));
          pen.closePath();
        }
        Object.assign(pen, { fillStyle: colors.paper, globalAlpha: 0.32 });
        pen.fill();
        Object.assign(pen, { fillStyle: about.color, globalAlpha: 0.07 });
        pen.fill();
      } }));
      const hung = ([x, y, z, a, b, part]) => a < 0 ? [x, y, z]
        : plus([x, y, z], between(moved[a].slice(0, 3), moved[b].slice(0, 3), part), scale);
      about.dampers.forEach((one, i) => {
        const [from, to] = one.body.map(hung), depth = see(between(from, to, 0.5))[2];
        parts.push({ layer: 3 * this.layer(Math.max(one.body[0][2], one.body[1][2])), depth, draw: () =>
          this.drawDamper(pen, i, k, one.braces.map(ends => ends.map(end => see(hung(end)))),
            one.span.map(s => see(between(from, to, s))), faded(depth), colors) });
      });
      about.masses.forEach(([name, point, c], i) => {
        const foot = hung(point), stroke = this.strokes(k, i) + share * (this.strokes(next, i) - this.strokes(k, i));
        const place = see(plus(foot, [0, 1, 2].map(d => d === c ? stroke : 0), scale));
        this.figure.dataset[`stroke${i}`] = stroke;
        parts.push({ layer: 3 * this.layer(point[2]) + 2, depth: place[2] - 1e-3, draw: () => {
          const [x, y] = place, [x0, y0] = see(foot);
          this.stroke(pen, [[x0, y0], [x0, y0 - 6], [x, y - 6]], colors.soft, 1, faded(place[2]));
          Object.assign(pen, { fillStyle: TUNED, globalAlpha: faded(place[2]) });
          pen.fillRect(x - 6, y - 12, 12, 12);
        } });
      });
      const below = this.eye.tilt < 0 ? -1 : 1; // what is nearer to the eye comes last
      parts.sort((a, b) => below * (a.layer - b.layer) || b.depth - a.depth).forEach(part => part.draw());
      pen.globalAlpha = 1;
      this.drawNames(pen, see, colors);
    }

    colors() {
      const style = getComputedStyle(this.canvas), of = name => style.getPropertyValue(name).trim();
      return { ink: of("--ink") || "#1c2430", soft: of("--soft") || "#566173", line: of("--line") || "#d7dce3",
        paper: of("--paper") || "#fff" };
    }

    stroke(pen, points, color, width, alpha = 1) {
      pen.beginPath();
      points.forEach((p, i) => pen[i ? "lineTo" : "moveTo"](p[0], p[1]));
      Object.assign(pen, { strokeStyle: color, lineWidth: width, globalAlpha: alpha });
      pen.stroke();
    }

    /* The outline of the ground floor, and signs of the supports. */
    drawGround(pen, see, colors) {
      const [x0, y0, z] = this.low, [x1, y1] = this.high, e = this.room / 2;
      const around = [[x0 - e, y0 - e], [x1 + e, y0 - e], [x1 + e, y1 + e], [x0 - e, y1 + e]].map(([x, y]) => see([x, y, z]));
      this.stroke(pen, [...around, around[0]], colors.line, 1);
      Object.assign(pen, { fillStyle: colors.line, globalAlpha: 0.25 });
      pen.fill();
      for (const [, from, to] of this.about.grid) this.stroke(pen, [see(from), see(to)], colors.line, 0.8);
      for (const [kind, i] of this.about.supports) {
        const [x, y] = this.canvas.at[i], h = 3;
        pen.beginPath();
        if (kind === "fixed") pen.rect(x - h, y - h, 2 * h, 2 * h);
        else if (kind === "pinned") { pen.moveTo(x, y - 1); pen.lineTo(x + 1.4 * h, y + 2 * h); pen.lineTo(x - 1.4 * h, y + 2 * h); pen.closePath(); }
        else pen.arc(x, y + h, h, 0, 2 * Math.PI);
        Object.assign(pen, { fillStyle: colors.paper, strokeStyle: colors.soft, lineWidth: 1, globalAlpha: 1 });
        pen.fill();
        pen.stroke();
      }
    }

    drawMember(pen, number, points, alpha, ranks, colors) {
      const [name] = this.about.members[number], width = name[0] === "C" ? 1.8 : name[0] === "B" ? 1.3 : 1;
      this.stroke(pen, points, this.about.color, width, alpha);
      const last = points.length - 1;
      this.ends[number].forEach((i, end) => {
        const rank = i < 0 ? 0 : ranks[i];
        if (!rank) return;
        const way = end ? [...points].reverse() : points, color = this.scene.classes[rank - 1][1];
        const length = AT_END * last, whole = Math.floor(length), rest = length - whole;
        const part = way.slice(0, whole + 1);
        part.push([0, 1].map(c => way[whole][c] + rest * (way[whole + 1][c] - way[whole][c])));
        if (this.rotation) this.stroke(pen, part, colors.ink, 2.6 + 0.8 * rank, alpha);
        this.stroke(pen, part, color, (this.rotation ? 1.4 : 0.8) + 0.8 * rank, this.rotation ? 1 : alpha);
      });
    }

    drawDamper(pen, number, k, braces, ends, alpha, colors) {
      const value = this.worked ? this.worked(k, number) : 0, strength = Math.min(1, Math.abs(value) / this.most);
      const color = mixed(REST, value < 0 ? PUSH : PULL, strength);
      braces.forEach(line => this.stroke(pen, line, colors.soft, 1, alpha));
      this.stroke(pen, ends, colors.ink, 6, alpha);
      this.stroke(pen, ends, color, 4.4);
      pen.beginPath();
      pen.arc((ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2, 3.2 + 2.4 * strength, 0, 2 * Math.PI);
      Object.assign(pen, { fillStyle: color, strokeStyle: colors.ink, lineWidth: 0.8 });
      pen.fill();
      pen.stroke();
    }

    /* Names of the grid lines on the two sides of the ground that are nearer to the eye, and the three axes. */
    drawNames(pen, see, colors) {
      const says = (text, [x, y]) => {
        Object.assign(pen, { lineWidth: 3, strokeStyle: colors.paper, fillStyle: colors.ink });
        pen.strokeText(text, x, y);
        pen.fillText(text, x, y);
      };
      const { tilt } = this.eye, away = this.room + (tilt > 60 ? this.aside : 0), below = Math.abs(tilt) < 10 ? 14 : 0;
      for (const c of [0, 1]) {
        const places = this.about.grid.filter(([, from, to]) => from[c] === to[c]).map(([label, from, to]) => {
          const ends = [from, to].map((p, i) => see(plus(p, minus(p, i ? from : to), away / Math.hypot(...minus(to, from)))));
          const [x, y] = ends[0][2] - ends[1][2] < 1e-9 * ends[1][2] ? ends[0] : ends[1];
          return [label, [x, y + below]];
        });
        const gaps = places.slice(1).map(([, p], i) => Math.hypot(p[0] - places[i][1][0], p[1] - places[i][1][1]));
        if (Math.min(...gaps) > 8) places.forEach(place => says(...place)); // else they stand behind each other
      }
      this.about.slabs.forEach((panels, floor) => {
        const leftmost = panels.flat().map(i => this.canvas.at[i]).sort((a, b) => a[0] - b[0])[0];
        if (leftmost && Math.abs(this.eye.tilt) < 70 && floor % this.each === this.each - 1) says(floor + 1, [leftmost[0] - 14, leftmost[1]]);
      });
      const height = this.canvas.clientHeight, origin = see(this.middle), reach = 0.2 * Math.max(...this.half);
      const size = 26, longest = Math.max(...[0, 1, 2].map(c => this.arm(see, c, reach, origin)[2])) || 1;
      for (const [c, axis] of ["x", "y", "z"].entries()) {
        const [dx, dy, long] = this.arm(see, c, reach, origin), [x, y] = [34, height - 34];
        if (long < 0.05 * longest) continue; // towards the eye
        const tip = [x + size * dx / longest, y + size * dy / longest];
        this.stroke(pen, [[x, y], tip], colors.ink, 1.4);
        says(axis, [tip[0] + 9 * dx / long, tip[1] + 9 * dy / long]);
      }
    }

    arm(see, c, reach, origin) {
      const p = see(plus(this.middle, [0, 1, 2].map(i => i === c ? reach : 0)));
      return [p[0] - origin[0], p[1] - origin[1], Math.hypot(p[0] - origin[0], p[1] - origin[1])];
    }

    /* The class of each end that yields: 0, not yet. */
    ranks(k) {
      return this.about.limits.map((limits, i) => {
        const rotation = this.rotation ? this.rotation(k, i) : this.about.largest[i];
        return limits.filter(limit => rotation >= limit).length;
      });
    }

    print(k, hinges) {
      const roof = AXES.map((_, d) => this.floors(k, this.about.floors.w - 2 + d));
      let worst = 0;
      for (let i = 1; i < this.about.drift.w; i++) {
        if (Math.abs(this.drift(k, i)) > Math.abs(this.drift(k, worst))) worst = i;
      }
      const storey = (worst >> 1) + 1, axis = AXES[worst % 2], drift = this.drift(k, worst);
      Object.assign(this.figure.dataset, { x: roof[0], y: roof[1], hinges, drift, storey, axis });
      const parts = [`roof ${AXES.map((name, d) => `${name} ${signed(1e3 * roof[d], 1)}`).join(", ")} mm`,
        `drift ${signed(100 * drift, 2)} % along ${axis} in storey ${storey}`];
      if (this.rotation) parts.push(`${hinges} hinges so far`);
      else if (hinges) parts.push(`${hinges} ends yield`);
      this.said.textContent = parts.join(" \u00b7 ");
    }
  }

  /* ---- the viewer of one record ---- */
  return class extends Viewer {
    moving(box, about, read) {
      this.eye ??= new Eye();
      return new Building(box, about, read, this.scene, this.eye);
    }

    controls() {
      super.controls();
      this.live.setAttribute("aria-label", "Motion of the building");
      const bar = node(this.live, "div", { class: "controls views", role: "group", "aria-label": "view" });
      const button = (words, act) => node(bar, "button", { type: "button" }, words).addEventListener("click", act);
      for (const [name, view] of Object.entries(VIEWS)) button(name, () => this.eye.set(...view));
      for (const [words, name, turn, nearer] of [["\u21ba", "turn left", 15, 1], ["\u21bb", "turn right", -15, 1],
        ["+", "nearer", 0, NEARER], ["\u2212", "farther", 0, 1 / NEARER]]) {
        button(words, () => this.eye.move(turn, 0, nearer));
        bar.lastChild.setAttribute("aria-label", name);
      }
      node(bar, "span", { class: "said" }, "drag, pinch or arrow keys");
    }

    /* One building has the diagrams beside it, several have them below. */
    spread() {
      return [0, 0, this.scene.variants.length, 1];
    }

    legend(box) {
      const list = node(box, "ul", { class: "legend" }), { frames, scene } = this;
      const entry = (color, text, looks = "") => {
        node(node(list, "li"), "i").style.cssText = `background: ${color};${looks}`;
        list.lastChild.append(text);
      };
      const bar = "width: 1.3rem; height: .5rem; border-radius: .25rem";
      if (frames.some(f => f.rings.length)) for (const [name, color] of scene.classes) entry(color, `hinge ${name}`, bar);
      if (frames.some(f => f.about.masses.length)) entry(TUNED, "tuned mass");
      if (!frames.some(f => f.worked)) return;
      const strokes = frames.some(f => f.deformation), most = Math.max(...frames.map(f => f.worked ? f.most : 0));
      const largest = `${+(most * (strokes ? 1e3 : 1e-3)).toPrecision(3)} ${strokes ? "mm" : "kN"}`;
      entry(mixed(PULL, PULL, 0), `${strokes ? "stroke of the damper" : "damper force"} > 0, to ${largest}`);
      entry(mixed(PUSH, PUSH, 0), `${strokes ? "stroke" : "force"} < 0`);
    }

    /* What the plane viewer has once, along x and along y. */
    twice(draw, make) {
      const draws = AXES.map((axis, d) => { make(axis, d); return this[draw]; });
      this[draw] = k => draws.forEach(of => of(k));
    }

    profile(side) {
      const frames = AXES.map((_, d) => this.frames.map(f => f.along(d)));
      this.twice("drawProfile", (axis, d) =>
        super.profile(side, `Storey drift along ${axis}, pale: largest`, frames[d], frames.flat()));
    }

    motion(side, ground) {
      this.orbit(side);
      this.twice("drawCursor", (axis, d) => super.motion(side, k => ground(k, d), `Ground acceleration along ${axis}`));
    }

    /* The way of the roof in plan. */
    orbit(side) {
      const { frames, scene } = this, all = Array.from({ length: scene.n }, (_, k) => k);
      const ways = frames.map(f => all.map(k => AXES.map((_, d) => 1e3 * f.floors(k, f.about.floors.w - 2 + d))));
      const most = Math.max(1e-6, ...ways.flat(2).map(Math.abs));
      const made = new Diagram(side, "Roof in plan, x to the right", 300, 210), aside = most * 284 / 174;
      made.span(-aside, aside, -most, most, ["", ""], [`\u00b1 ${+most.toPrecision(3)} mm`]);
      const drawn = frames.map((f, j) => {
        const points = ways[j].map(([x, y]) => [made.x(x), made.y(y)]);
        const whole = made.line({ stroke: "#d7dce3", "stroke-width": 0.8, d: path(points) });
        const one = { points, past: made.line({ stroke: f.about.color, "stroke-width": 1.1 }),
          point: node(made.layer, "svg:circle", { r: 4, fill: f.about.color, stroke: "#fff" }) };
        this.parts[j].push(whole, one.past, one.point);
        return one;
      });
      const profile = this.drawProfile;
      this.drawProfile = k => {
        profile(k);
        for (const { points, past, point } of drawn) {
          past.setAttribute("d", path(points.slice(0, k + 1)));
          point.setAttribute("cx", short(points[k][0]));
          point.setAttribute("cy", short(points[k][1]));
        }
      };
    }
  };
};
