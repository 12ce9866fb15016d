// The table of vehicles, trouble first. Rows stay the same elements while their texts change: they can be pressed.

import { h } from "./dom";
import { colour } from "./map";
import { type Run, type Vehicle, clock, trouble } from "./model";

const columns = ["vehicle", "type", "task", "for", "battery", "last heard", "position"];
const numbers = new Set([3, 4, 5, 6]);

// Ages below two seconds would only flicker.
const ago = (seconds: number) => (seconds < 2 ? "now" : seconds < 120 ? `${Math.floor(seconds)} s ago` : `${clock(seconds)} ago`);

interface Row { el: HTMLElement; cells: HTMLElement[] }

export class VehicleTable {
  private rows = new Map<string, Row>();
  private body = h("tbody");
  private order = "";

  constructor(private el: HTMLElement, private select: (id: string) => void) { this.clear(); }

  private clear() {
    this.rows.clear();
    this.order = "";
    this.el.replaceChildren(h("p", { class: "empty" }, "No vehicle was heard of yet."));
  }

  show(run: Run, steps: boolean) {
    const all = [...run.vehicles.values()];
    if (!all.length) { if (this.rows.size) this.clear(); return; }
    const index = new Map(all.map((v, i) => [v.id, i]));
    const sorted = all.map((v) => ({ v, t: trouble(run, v) })).sort((a, b) => b.t.rank - a.t.rank || index.get(a.v.id)! - index.get(b.v.id)!);
    for (const id of [...this.rows.keys()]) if (!index.has(id)) { this.rows.get(id)!.el.remove(); this.rows.delete(id); this.order = ""; }
    for (const { v, t } of sorted) this.fill(run, v, t, index.get(v.id)!, steps);
    const order = sorted.map(({ v }) => v.id).join("\n");
    if (order === this.order) return;
    if (!this.order) this.el.replaceChildren(h("table", {},
      h("thead", {}, h("tr", {}, ...columns.map((c) => h("th", { scope: "col" }, c)))), this.body));
    this.order = order;
    this.body.replaceChildren(...sorted.map(({ v }) => this.rows.get(v.id)!.el));
  }

  private row(v: Vehicle, i: number): Row {
    const dot = h("span", { class: "dot" });
    dot.style.background = colour(i);
    const cells = columns.map((_, c) => h("td", numbers.has(c) ? { class: "number" } : {}));
    cells[0].append(h("button", { class: "link", click: () => this.select(v.id) }, dot, v.id));
    return { el: h("tr", {}, ...cells), cells };
  }

  private fill(run: Run, v: Vehicle, t: { rank: number; text: string }, i: number, steps: boolean) {
    let row = this.rows.get(v.id);
    if (!row) { row = this.row(v, i); this.rows.set(v.id, row); }
    const s = v.samples[v.samples.length - 1], task = v.tasks[v.tasks.length - 1];
    const runs = task && task.until === null;
    const says = [null, v.kind, t.rank > 0 ? t.text : runs ? task.plan : run.bound.has(v.id) ? "–" : "not bound",
      runs && !steps ? clock(run.time - task.from) : "",
      typeof s?.battery === "number" ? Math.round(s.battery * 100) + " %" : "",
      s && run.moves && !steps ? ago(run.time - v.heard) : "",
      s ? `${s.latitude.toFixed(5)}, ${s.longitude.toFixed(5)}` : ""];
    says.forEach((text, c) => { if (text !== null && row!.cells[c].textContent !== text) row!.cells[c].textContent = text; });
    const kind = t.rank > 0 ? "bad" : t.rank < 0 ? "idle" : "";
    if (row.el.className !== kind) row.el.className = kind;
  }
}
