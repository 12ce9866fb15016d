// Plots of one reading of all vehicles, or of one: over time, or along the tracks; of two runs where there are two.

import * as L from "leaflet";
import { $, h, svg } from "./dom";
import { distance } from "./measure";
import { type Run, type Sample, type Vehicle, clock } from "./model";
import { type Quantity, brief, quantities } from "./quantities";
import { upTo } from "./tape";
import type { Spot } from "./tracks";

interface Line { name: string; id: string; tint: string; second: boolean; points: { x: number; value: number; sample: Sample }[] }

const left = 52, right = 26, top = 8, bottom = 22;
const times = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 43200, 86400];

// 1, 2 or 5 of a power of ten, so that there are [n] of them at most.
export function niceStep(range: number, n: number): number {
  const raw = Math.max(range, 1e-9) / n, power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5].find((k) => k * power >= raw) ?? 10);
}

const latLng = (s: Sample) => L.latLng(s.latitude, s.longitude);

// The values of a vehicle by time, or by the way that it has gone.
export function along(v: Vehicle, quantity: Quantity, track: boolean): Line["points"] {
  const points: Line["points"] = [];
  let gone = 0;
  v.samples.forEach((s, i) => {
    if (i) gone += latLng(v.samples[i - 1]).distanceTo(latLng(s));
    const value = quantity.of(s);
    if (typeof value === "number") points.push({ x: track ? gone : s.time, value, sample: s });
  });
  return points;
}

// In each column of pixels the least and the greatest value remain.
function thinned(points: Line["points"], length: number, wide: number): Line["points"] {
  if (points.length <= 3 * wide) return points;
  const found: Line["points"] = [];
  for (let i = 0; i < points.length;) {
    const column = Math.floor((points[i].x / length) * wide);
    let low = points[i], high = points[i];
    for (; i < points.length && Math.floor((points[i].x / length) * wide) === column; i++) {
      if (points[i].value < low.value) low = points[i];
      if (points[i].value > high.value) high = points[i];
    }
    found.push(...(low === high ? [low] : low.x <= high.x ? [low, high] : [high, low]));
  }
  return found;
}

export class Readings {
  private el = $("readings");
  private says = $("reading-at");
  private key = "";
  private lines: Line[] = [];
  private length = 1;
  private at: number | null = null;  // where the pointer is

  constructor(private tint: (run: Run, id: string) => string, private events: { changed: () => void; seek: (time: number) => void; mark: (spots: Spot[]) => void }) {
    for (const id of ["reading", "reading-of", "reading-axis", "reading-map"]) $(id).addEventListener("change", () => { this.at = null; events.changed(); });
    this.el.addEventListener("pointermove", (e) => this.point((e as PointerEvent).clientX));
    this.el.addEventListener("pointerleave", () => this.leave());
    this.el.addEventListener("click", () => this.go());
    this.el.addEventListener("keydown", (e) => {
      const by = { ArrowLeft: -0.02, ArrowRight: 0.02 }[e.key];
      if (by !== undefined) { e.preventDefault(); this.at = Math.max(0, Math.min(this.length, (this.at ?? 0) + by * this.length)); this.draw(); }
      else if (e.key === "Enter") this.go();
      else if (e.key === "Escape") this.leave();
    });
    this.el.addEventListener("blur", () => this.leave());
  }

  private get track() { return $<HTMLSelectElement>("reading-axis").value === "track"; }

  private chosen(runs: Run[]): { quantity: Quantity | undefined; all: Quantity[] } {
    const all = quantities(runs.flatMap((r) => [...r.vehicles.values()]));
    return { quantity: all.find((q) => q.name === $<HTMLSelectElement>("reading").value) ?? all[0], all };
  }

  private offer(id: string, options: [string, string][]) {
    const select = $<HTMLSelectElement>(id), before = select.value;
    if ([...select.options].map((o) => o.value).join("\n") === options.map(([value]) => value).join("\n")) return;
    select.replaceChildren(...options.map(([value, text]) => h("option", { value }, text)));
    if (options.some(([value]) => value === before)) select.value = before;
  }

  // The reading that the map is to show along the tracks, and of which vehicles.
  show(run: Run, second: Run | null): { quantity: Quantity | null; vehicles: Vehicle[] } {
    const runs = second ? [run, second] : [run], isHidden = $("readings-panel").hidden;
    const ids = [...new Set(runs.flatMap((r) => [...r.vehicles.keys()]))];
    const onMap = $<HTMLInputElement>("reading-map").checked && !isHidden;
    const size = `${this.el.clientWidth} ${this.el.clientHeight}`;
    const key = isHidden ? "" : JSON.stringify([size, ["reading", "reading-of", "reading-axis"].map((id) => $<HTMLSelectElement>(id).value),
      runs.map((r) => [...r.vehicles.values()].map((v) => [v.id, v.samples.length, v.samples[v.samples.length - 1]?.time]))]);
    if (isHidden) return { quantity: null, vehicles: [] };
    const { quantity, all } = this.chosen(runs), of = $<HTMLSelectElement>("reading-of").value;
    const vehicles = runs.flatMap((r) => [...r.vehicles.values()].filter((v) => !ids.includes(of) || v.id === of));
    if (key !== this.key) {
      this.key = key;
      this.offer("reading", all.map((q) => [q.name, q.unit ? `${q.name}, ${q.unit}` : q.name]));
      this.offer("reading-of", [["", "all vehicles"], ...ids.map((id): [string, string] => [id, id])]);
      this.lines = quantity ? runs.flatMap((r) => [...r.vehicles.values()].filter((v) => vehicles.includes(v)).map((v) => ({ id: v.id,
        name: r === second ? v.id + " (second)" : v.id, tint: this.tint(run, v.id), second: r === second, points: along(v, quantity, this.track) })))
        .filter((l) => l.points.length > 0) : [];
      this.draw(quantity);
    }
    return { quantity: onMap && quantity ? quantity : null, vehicles };
  }

  private drawn: Quantity | undefined;
  private draw(quantity = this.drawn) {
    this.drawn = quantity;
    if (!quantity || !this.lines.length) {
      this.says.textContent = "";
      return this.el.replaceChildren(h("p", { class: "empty" }, "No vehicle has reported a reading yet."));
    }
    const wide = Math.max(240, this.el.clientWidth - 4), high = Math.max(110, this.el.clientHeight - 6), { lines } = this;
    let least = Infinity, most = -Infinity, length = 1;
    for (const { points } of lines) for (const p of points) { least = Math.min(least, p.value); most = Math.max(most, p.value); length = Math.max(length, p.x); }
    if (least === most) { least -= 0.5; most += 0.5; }
    this.length = length;
    const x = (at: number) => left + (at / length) * (wide - left - right);
    const y = (value: number) => high - bottom - ((value - least) / (most - least)) * (high - top - bottom);
    const parts: Node[] = [];
    const up = niceStep(most - least, Math.max(2, Math.floor((high - top - bottom) / 34))), digits = Math.max(0, Math.ceil(-Math.log10(up)));
    for (let value = Math.ceil(least / up) * up; value <= most + up * 1e-6; value += up)
      parts.push(svg("line", { x1: left, x2: wide - right, y1: y(value), y2: y(value), class: "tick" }),
        svg("text", { x: left - 6, y: y(value) + 4, class: "value" }, value.toFixed(digits)));
    const fits = Math.max(2, Math.floor((wide - left - right) / 70));
    const step = this.track ? niceStep(length, fits) : times.find((s) => length / s <= fits) ?? times[times.length - 1];
    for (let at = 0; at <= length; at += step)
      parts.push(svg("line", { x1: x(at), x2: x(at), y1: top, y2: high - bottom, class: "tick" }),
        svg("text", { x: x(at), y: high - 6, class: "time" }, this.track ? distance(at) : clock(at)));
    for (const l of lines) {
      const at = thinned(l.points, length, wide).map((p) => `${x(p.x).toFixed(1)},${y(p.value).toFixed(1)}`);
      parts.push(svg("polyline", { points: at.join(" "), class: "reading" + (l.second ? " second" : ""), stroke: l.tint, "data-vehicle": l.id }));
    }
    if (this.at !== null) parts.push(svg("line", { x1: x(this.at), x2: x(this.at), y1: top, y2: high - bottom, class: "now" }));
    const title = `${quantity.name} ${this.track ? "along the track" : "over time"}: from ${brief(least)} to ${brief(most)} ${quantity.unit}`.trim();
    this.el.replaceChildren(svg("svg", { width: wide, height: high, viewBox: `0 0 ${wide} ${high}`, role: "img", "aria-label": title }, ...parts));
    this.describe(quantity);
  }

  // Of each line the last value that is not behind the pointer.
  private under(): { line: Line; point: Line["points"][number] }[] {
    const { at } = this;
    if (at === null) return [];
    return this.lines.flatMap((line) => {
      const count = upTo(line.points.length, (i) => line.points[i].x, at);
      return count ? [{ line, point: line.points[count - 1] }] : [];
    });
  }

  private describe({ unit }: Quantity) {
    const found = this.under(), most = 6;
    const text = found.slice(0, most).map(({ line, point }) => `${line.name} ${brief(point.value)} ${unit}`.trim()).join(", ");
    this.says.textContent = this.at === null ? "" : `${this.track ? distance(this.at) : clock(this.at)}: ${text}${found.length > most ? `, and ${found.length - most} more` : ""}`;
    this.events.mark(found.map(({ line, point }) => ({ sample: point.sample, tint: line.tint })));
  }

  private point(clientX: number) {
    const box = this.el.querySelector("svg")?.getBoundingClientRect();
    if (!box) return;
    const share = (clientX - box.left - left) / (box.width - left - right);
    this.at = share < 0 || share > 1 ? null : share * this.length;
    this.draw();
  }

  private leave() {
    if (this.at === null) return;
    this.at = null;
    this.draw();
  }

  // The replay goes to the moment below the pointer.
  private go() {
    const found = this.under()[0];
    if (found) this.events.seek(found.point.sample.time);
  }
}
