// Where the panels are: a layout for planning, for runs and for review; their sizes, and which are hidden, are kept by the
// browser. On a small screen the panels stand one below the other.

import { $, h } from "./dom";

type Name = "plan" | "run" | "review";
interface Cell { panel: string; width: number }
interface Row { height: number; cells: Cell[] }

const panels: Record<string, string> = { editor: "Program", map: "Map", now: "Now", vehicles: "Vehicles", timeline: "Timeline", log: "Log", readings: "Readings" };

const row = (height: number, ...cells: [string, number][]): Row => ({ height, cells: cells.map(([panel, width]) => ({ panel, width })) });
const usual: Record<Name, Row[]> = {
  plan: [row(6, ["editor", 10], ["map", 10], ["now", 8]), row(5, ["timeline", 10], ["vehicles", 10], ["log", 8])],
  run: [row(8, ["map", 20], ["now", 8]), row(5, ["timeline", 10], ["vehicles", 10], ["log", 8])],
  review: [row(6, ["timeline", 15], ["readings", 11]), row(5, ["editor", 8], ["map", 9], ["now", 4], ["log", 5])],
};
const least = 0.12;  // of the two panels that a bar is between

interface Kept { layout?: Name; sizes?: Record<string, number>; hidden?: Record<string, string[]>; order?: Record<string, string[]> }

function read(): Kept {
  try { const found = JSON.parse(localStorage.getItem("layout") ?? "{}"); return found && typeof found === "object" ? found : {}; } catch { return {}; }
}

export class Layout {
  private kept = read();
  private main = document.querySelector("main")!;
  private bars = h("div", { id: "bars" });

  constructor(private changed: () => void) {
    this.main.append(this.bars);
    $("layout").addEventListener("change", () => this.choose($<HTMLSelectElement>("layout").value as Name));
    $("layout-usual").addEventListener("click", () => { this.kept = { layout: this.name }; this.save(); });
    for (const panel of Object.keys(panels)) $(panel + "-panel").prepend(this.handle(panel));
    this.apply();
  }

  get name(): Name {
    const kept = this.kept.layout;
    return kept && kept in usual ? kept : window.innerWidth <= 480 ? "run" : "plan";
  }

  private choose(name: Name) { this.kept.layout = name; this.save(); }

  private save() {
    try { localStorage.setItem("layout", JSON.stringify(this.kept)); } catch { /* it is not kept, then */ }
    this.apply();
    this.changed();
  }

  private weight(key: string, otherwise: number) {
    const kept = this.kept.sizes?.[`${this.name} ${key}`];
    return typeof kept === "number" && kept > 0 && kept < 1000 ? kept : otherwise;
  }

  // The rows, with their panels where they were moved to.
  private placed(): Row[] {
    const cells = usual[this.name].flatMap((r) => r.cells), kept = this.kept.order?.[this.name];
    const isOrder = Array.isArray(kept) && kept.length === cells.length && new Set(kept).size === kept.length && kept.every((p) => p in panels);
    const order = isOrder ? kept : cells.map((c) => c.panel);
    let i = 0;
    return usual[this.name].map((r) => ({ ...r, cells: r.cells.map((c) => ({ ...c, panel: order[i++] })) }));
  }

  // Two panels exchange their places.
  private exchange(a: string, b: string) {
    const order = this.placed().flatMap((r) => r.cells.map((c) => c.panel));
    const other = (p: string) => (p === a ? b : p === b ? a : p);
    this.kept.order = { ...this.kept.order, [this.name]: order.map(other) };
    this.save();
  }

  // The nearest panel in this direction.
  private beside(panel: string, key: string): string | null {
    const middle = (p: string) => { const b = $(p + "-panel").getBoundingClientRect(); return { x: b.x + b.width / 2, y: b.y + b.height / 2 }; };
    const from = middle(panel);
    const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key]!;
    const others = Object.keys(panels).filter((p) => p !== panel && !$(p + "-panel").hidden).map((p) => {
      const to = middle(p), dx = to.x - from.x, dy = to.y - from.y, along = dx * x + dy * y, across = Math.abs(dx * y) + Math.abs(dy * x);
      return { p, along, far: along + 2 * across };
    }).filter((o) => o.along > 20).sort((o, q) => o.far - q.far);
    return others[0]?.p ?? null;
  }

  // At the head of each panel: dragged onto another one, or by the arrow keys, the two exchange their places.
  private handle(panel: string): HTMLElement {
    const under = (e: PointerEvent) => Object.keys(panels).find((p) => p !== panel && !$(p + "-panel").hidden
      && $(p + "-panel").contains(document.elementFromPoint(e.clientX, e.clientY))) ?? null;
    const mark = (target: string | null) => { for (const p of Object.keys(panels)) $(p + "-panel").classList.toggle("target", p === target); };
    return h("button", { class: "move", type: "button", title: "Drag it onto another panel, or press an arrow key: they exchange their places", "aria-label": `Move ${panels[panel]}`,
      keydown: (e: KeyboardEvent) => {
        if (!/^Arrow/.test(e.key)) return;
        e.preventDefault();
        const other = this.beside(panel, e.key);
        if (other) this.exchange(panel, other);
      },
      pointerdown: (e: PointerEvent) => {
        const el = e.currentTarget as HTMLElement;
        el.setPointerCapture(e.pointerId);
        const move = (at: PointerEvent) => mark(under(at));
        const end = (at: PointerEvent) => {
          el.removeEventListener("pointermove", move);
          el.removeEventListener("pointerup", end);
          el.removeEventListener("pointercancel", end);
          mark(null);
          const other = at.type === "pointerup" ? under(at) : null;
          if (other) this.exchange(panel, other);
        };
        el.addEventListener("pointermove", move);
        el.addEventListener("pointerup", end);
        el.addEventListener("pointercancel", end);
      } }, "⠿");
  }

  // A panel that this layout does not have can be shown in place of none: it gets a row of its own.
  private rows(): Row[] {
    const known = this.placed().flatMap((r) => r.cells.map((c) => c.panel));
    const isHidden = (panel: string) => this.hidden().includes(panel);
    const added = Object.keys(panels).filter((p) => !known.includes(p));
    return [...this.placed(), row(5, ...added.map((p): [string, number] => [p, 10]))]
      .map((r, i) => ({ height: this.weight(`row ${i}`, r.height),
        cells: r.cells.filter((c) => !isHidden(c.panel)).map((c) => ({ ...c, width: this.weight(c.panel, c.width) })), i }))
      .filter((r) => r.cells.length > 0);
  }

  private hidden(): string[] {
    const known = this.placed().flatMap((r) => r.cells.map((c) => c.panel));
    return this.kept.hidden?.[this.name] ?? Object.keys(panels).filter((p) => !known.includes(p));
  }

  private hide(panel: string, hides: boolean) {
    const others = this.hidden().filter((p) => p !== panel);
    this.kept.hidden = { ...this.kept.hidden, [this.name]: hides ? [...others, panel] : others };
    this.save();
  }

  private apply() {
    $<HTMLSelectElement>("layout").value = this.name;
    document.body.dataset.layout = this.name;
    const rows = this.rows() as (Row & { i: number })[];
    const bars: HTMLElement[] = [], total = rows.reduce((sum, r) => sum + r.height, 0);
    for (const panel of Object.keys(panels)) $(panel + "-panel").hidden = this.hidden().includes(panel);
    $("panels").replaceChildren(...Object.entries(panels).map(([panel, name]) => {
      const box = h("input", { type: "checkbox", checked: !this.hidden().includes(panel), change: (e: Event) => this.hide(panel, !(e.target as HTMLInputElement).checked) });
      return h("label", { class: "check" }, box, name);
    }));
    let top = 0;
    rows.forEach((r, n) => {
      const height = (r.height / total) * 100, wide = r.cells.reduce((sum, c) => sum + c.width, 0);
      let left = 0;
      r.cells.forEach((c, m) => {
        const width = (c.width / wide) * 100, style = $(c.panel + "-panel").style;
        for (const [name, value] of [["--x", left], ["--y", top], ["--w", width], ["--h", height]] as const) style.setProperty(name, value + "%");
        left += width;
        const next = r.cells[m + 1];
        if (next) bars.push(this.bar("vertical", { x: left, y: top, length: height }, [c.panel, next.panel], [c.width, next.width]));
      });
      top += height;
      const below = rows[n + 1];
      if (below) bars.push(this.bar("horizontal", { x: 0, y: top, length: 100 }, [`row ${r.i}`, `row ${below.i}`], [r.height, below.height]));
    });
    this.bars.replaceChildren(...bars);
  }

  // Between two panels or rows: moved by the pointer or by the arrow keys.
  private bar(way: "vertical" | "horizontal", at: { x: number; y: number; length: number }, names: [string, string], sizes: [number, number]) {
    const both = sizes[0] + sizes[1], share = sizes[0] / both, id = "bar-" + names[0].replace(" ", "-");
    const set = (wanted: number) => {
      const first = Math.min(1 - least, Math.max(least, wanted));
      const kept = { ...this.kept.sizes, [`${this.name} ${names[0]}`]: first * both, [`${this.name} ${names[1]}`]: (1 - first) * both };
      this.kept.sizes = kept;
      this.save();
      document.getElementById(id)?.focus();
    };
    const title = (name: string) => panels[name] ?? "panels above";
    const el = h("div", { id, class: "bar-" + way, role: "separator", tabindex: 0, "aria-orientation": way, "aria-valuenow": Math.round(share * 100),
      "aria-label": way === "vertical" ? `Width of ${title(names[0])}` : "Height of the panels above",
      keydown: (e: KeyboardEvent) => {
        const by = { ArrowLeft: -0.05, ArrowUp: -0.05, ArrowRight: 0.05, ArrowDown: 0.05 }[e.key];
        if (by === undefined) return;
        e.preventDefault();
        set(share + by);
      },
      pointerdown: (e: PointerEvent) => {
        e.preventDefault();
        const size = way === "vertical" ? this.main.clientWidth : this.main.clientHeight, before = way === "vertical" ? e.clientX : e.clientY;
        // The part of the page that the two take.
        const part = way === "vertical" ? this.extent(names[0]) + this.extent(names[1]) : (this.extent(names[0], true) + this.extent(names[1], true));
        const end = (up: PointerEvent) => {
          window.removeEventListener("pointerup", end);
          const moved = (way === "vertical" ? up.clientX : up.clientY) - before;
          if (moved) set(share + moved / (part * size / 100));
        };
        window.addEventListener("pointerup", end);
      } });
    el.style.left = at.x + "%";
    el.style.top = at.y + "%";
    el.style[way === "vertical" ? "height" : "width"] = at.length + "%";
    return el;
  }

  // In percent of the page: the width of a panel, or the height of a row.
  private extent(name: string, isRow = false): number {
    if (!isRow) return parseFloat($(name + "-panel").style.getPropertyValue("--w"));
    const rows = this.rows() as (Row & { i: number })[], total = rows.reduce((sum, r) => sum + r.height, 0);
    return ((rows.find((r) => `row ${r.i}` === name)?.height ?? 0) / total) * 100;
  }
}
