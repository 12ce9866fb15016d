// The state graph of a small program: states in rows by their distance from the start, a shortest path to the chosen one.

import { $, h, svg } from "./dom";

interface Graph { initial: number; states: number; labels: string[]; transitions: [number, number, number][]; texts: string[] }
interface Node { x: number; y: number; el: SVGElement }

const across = 46, down = 58, margin = 40;

// A part of the configuration in each line, without the folders of files.
const legible = (text: string) => text.replace(/\s+/g, " ").replace(/[^\s:]*\/(?=[^/\s]*:\d)/g, "").replaceAll("; ", "\n");

export class StateGraph {
  private dialog = $<HTMLDialogElement>("graph-dialog");
  private graph!: Graph;
  private nodes: Node[] = [];
  private edges: SVGElement[] = [];
  private into: number[] = [];  // of each state, the step by which a shortest path comes to it; -1 at the start
  private view = { x: 0, y: 0, width: 1, height: 1 };
  private size = { width: 1, height: 1 };
  private svg!: SVGElement;
  private matches: number[] = [];

  constructor() {
    const find = $<HTMLInputElement>("graph-find");
    find.addEventListener("input", () => this.find(find.value.trim().toLowerCase()));
    find.addEventListener("keydown", (e) => { if (e.key === "Enter") { e.preventDefault(); this.next(); } });
    $("graph-in").addEventListener("click", () => this.zoom(0.7));
    $("graph-out").addEventListener("click", () => this.zoom(1 / 0.7));
    $("graph-all").addEventListener("click", () => this.all());
    $("graph-close").addEventListener("click", () => this.dialog.close());
    this.dialog.addEventListener("keydown", (e) => { if (e.key === "Escape") this.dialog.close(); });
    const el = $("graph-picture");
    el.addEventListener("wheel", (e) => { e.preventDefault(); this.zoom(e.deltaY < 0 ? 0.85 : 1 / 0.85, e); }, { passive: false });
    let from: PointerEvent | null = null;
    el.addEventListener("pointerdown", (e) => (from = e));
    window.addEventListener("pointerup", () => (from = null));
    el.addEventListener("pointermove", (e) => {
      if (!from) return;
      const scale = this.view.width / el.clientWidth;
      this.view.x -= (e.clientX - from.clientX) * scale; this.view.y -= (e.clientY - from.clientY) * scale;
      from = e;
      this.apply();
    });
    el.addEventListener("keydown", (e) => {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
      if (e.key === "+") this.zoom(0.7); else if (e.key === "-") this.zoom(1 / 0.7);
      if (!by) return;
      e.preventDefault();
      this.view.x += (by[0] * this.view.width) / 8; this.view.y += (by[1] * this.view.height) / 8;
      this.apply();
    });
  }

  open(graph: Graph) {
    this.graph = { ...graph, texts: graph.texts.map(legible) };
    this.draw();
    if (!this.dialog.open) this.dialog.show();
    this.all();
    $<HTMLInputElement>("graph-find").value = "";
    this.find("");
    this.choose(graph.initial);
    $("graph-find").focus();
  }

  // {1 The layout}

  private layers(): number[][] {
    const { states, transitions, initial } = this.graph;
    const out: number[][] = Array.from({ length: states }, () => []);
    transitions.forEach(([s], i) => out[s].push(i));
    this.into = new Array(states).fill(-2);
    this.into[initial] = -1;
    const rows: number[][] = [];
    for (let row = [initial]; row.length;) {
      rows.push(row);
      const below: number[] = [];
      for (const s of row) for (const i of out[s]) {
        const target = transitions[i][2];
        if (this.into[target] === -2) { this.into[target] = i; below.push(target); }
      }
      row = below;
    }
    return rows;
  }

  // Each state stands below the middle of those that lead to it: fewer lines cross.
  private order(rows: number[][]): number[] {
    const place: number[] = new Array(this.graph.states).fill(0), depth: number[] = [];
    rows.forEach((row, y) => row.forEach((s, x) => { depth[s] = y; place[s] = x - (row.length - 1) / 2; }));
    const near: number[][] = Array.from({ length: this.graph.states }, () => []);
    for (const [s, , t] of this.graph.transitions) if (s !== t) { near[t].push(s); near[s].push(t); }
    for (let pass = 0; pass < 8; pass++)
      for (const row of pass % 2 === 0 ? rows : [...rows].reverse()) {
        const middle = new Map(row.map((s) => {
          const others = near[s].filter((t) => (pass % 2 === 0 ? depth[t] < depth[s] : depth[t] > depth[s]));
          return [s, others.length ? others.reduce((sum, t) => sum + place[t], 0) / others.length : place[s]];
        }));
        row.sort((a, b) => middle.get(a)! - middle.get(b)!);
        row.forEach((s, x) => { place[s] = x - (row.length - 1) / 2; });
      }
    return place;
  }

  private draw() {
    const { transitions, labels, texts } = this.graph, rows = this.layers(), place = this.order(rows);
    const widest = Math.max(...rows.map((r) => r.length));
    this.size = { width: widest * across + 2 * margin, height: (rows.length - 1) * down + 2 * margin };
    this.nodes = [];
    rows.forEach((row, y) => row.forEach((s) => {
      const x = this.size.width / 2 + place[s] * across;
      this.nodes[s] = { x, y: margin + y * down, el: svg("circle", { cx: x, cy: margin + y * down, r: 9, "data-state": s,
        click: () => this.choose(s) }, svg("title", {}, texts[s])) };
    }));
    const ends = new Set(transitions.map(([s]) => s));
    this.nodes.forEach((n, s) => { if (!ends.has(s)) n.el.classList.add("last"); });
    this.edges = transitions.map(([s, l, t], i) => {
      const a = this.nodes[s], b = this.nodes[t], bend = b.y > a.y ? 0 : 40 + (i % 3) * 12;
      const d = s === t ? `M${a.x + 6} ${a.y - 6}c22 -16 22 24 2 12`
        : `M${a.x} ${a.y}Q${(a.x + b.x) / 2 + bend} ${(a.y + b.y) / 2} ${b.x} ${b.y}`;
      return svg("path", { d, "marker-end": "url(#arrow)" }, svg("title", {}, labels[l]));
    });
    this.svg = svg("svg", { role: "img", "aria-label": `${this.graph.states} states, ${transitions.length} steps` },
      svg("defs", {}, svg("marker", { id: "arrow", viewBox: "0 0 8 8", refX: 17, refY: 4, markerWidth: 7, markerHeight: 7, markerUnits: "userSpaceOnUse", orient: "auto" },
        svg("path", { d: "M0 0L8 4L0 8Z" }))),
      svg("g", { class: "edges" }, ...this.edges), svg("g", { class: "states" }, ...this.nodes.map((n) => n.el)));
    $("graph-picture").replaceChildren(this.svg);
  }

  // {1 What is seen of it}

  private apply() { const v = this.view; this.svg.setAttribute("viewBox", `${v.x} ${v.y} ${v.width} ${v.height}`); }

  private all() {
    const el = $("graph-picture"), shape = el.clientHeight / Math.max(1, el.clientWidth);
    const width = Math.max(this.size.width, this.size.height / shape, 400), height = width * shape;
    this.view = { x: (this.size.width - width) / 2, y: (this.size.height - height) / 2, width, height };
    this.apply();
  }

  // About the pointer, or else the middle.
  private zoom(by: number, e?: WheelEvent) {
    const el = $("graph-picture").getBoundingClientRect(), v = this.view;
    const at = e ? { x: (e.clientX - el.left) / el.width, y: (e.clientY - el.top) / el.height } : { x: 0.5, y: 0.5 };
    v.x += v.width * at.x * (1 - by); v.y += v.height * at.y * (1 - by);
    v.width *= by; v.height *= by;
    this.apply();
  }

  private center(s: number) {
    const n = this.nodes[s], v = this.view;
    if (n.x > v.x && n.x < v.x + v.width && n.y > v.y && n.y < v.y + v.height) return;
    v.x = n.x - v.width / 2; v.y = n.y - v.height / 2;
    this.apply();
  }

  // {1 Search, and the way to a state}

  private find(text: string) {
    const { transitions, labels, texts } = this.graph;
    const found = new Set<number>();
    if (text) {
      transitions.forEach(([, l, t]) => { if (labels[l].toLowerCase().includes(text)) found.add(t); });
      texts.forEach((about, s) => { if (about.toLowerCase().includes(text)) found.add(s); });
    }
    this.matches = [...found].sort((a, b) => this.nodes[a].y - this.nodes[b].y);
    this.nodes.forEach((n, s) => n.el.classList.toggle("found", found.has(s)));
    $("graph-count").textContent = text ? `${found.size} states` : `${this.graph.states} states, ${transitions.length} steps`;
  }

  private next() {
    const first = this.matches.shift();
    if (first === undefined) return;
    this.matches.push(first);
    this.choose(first);
    this.center(first);
  }

  private choose(s: number) {
    const { transitions, labels, texts } = this.graph, way: number[] = [];
    for (let at = s; this.into[at] >= 0; at = transitions[this.into[at]][0]) way.unshift(this.into[at]);
    this.edges.forEach((el, i) => el.classList.toggle("way", way.includes(i)));
    this.nodes.forEach((n, t) => { n.el.classList.toggle("chosen", t === s); n.el.classList.toggle("way", way.some((i) => transitions[i][2] === t)); });
    const go = (t: number, text: string) => h("li", {}, h("button", { class: "link", click: () => { this.choose(t); this.center(t); } }, text));
    const after = transitions.filter(([from]) => from === s);
    $("graph-state").replaceChildren(
      h("h3", {}, `State ${s}`), h("pre", {}, texts[s]),
      h("h3", {}, "Shortest way to it"), way.length ? h("ol", {}, ...way.map((i) => go(transitions[i][2], labels[transitions[i][1]]))) : h("p", { class: "empty" }, "here all runs begin"),
      h("h3", {}, "What may come next"), after.length ? h("ul", {}, ...after.map(([, l, t]) => go(t, labels[l]))) : h("p", { class: "empty" }, "nothing"));
  }
}
