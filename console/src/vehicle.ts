// The panel of one vehicle: what it last reported, its task, the commands that the program takes for it, and small plots
// of what it reported before.

import { $, h, svg } from "./dom";
import { colour, courseOf } from "./map";
import { type Run, type Sample, type Vehicle, clock, trouble } from "./model";
import { brief, quantities } from "./quantities";
import type { Progress } from "./api";

// Percent of an hour, by a line through the samples of the last ten minutes; null: they are too few, or too close.
export function trend(samples: Sample[]): number | null {
  const last = samples[samples.length - 1];
  const points = samples.filter((s) => s.battery !== null && last.time - s.time <= 600);
  if (points.length < 3 || last.time - points[0].time < 30) return null;
  const mean = (f: (s: Sample) => number) => points.reduce((sum, s) => sum + f(s), 0) / points.length;
  const t = mean((s) => s.time), b = mean((s) => s.battery!);
  const spread = mean((s) => (s.time - t) ** 2);
  return spread === 0 ? null : (mean((s) => (s.time - t) * (s.battery! - b)) / spread) * 3600 * 100;
}

// The quantities that it has reported, each with its values over time.
export function series(v: Vehicle): { name: string; unit: string; points: { time: number; value: number }[] }[] {
  return quantities([v]).map(({ name, unit, of }) => ({ name, unit,
    points: v.samples.flatMap((s) => { const value = of(s); return typeof value === "number" ? [{ time: s.time, value }] : []; }) }));
}

// The inputs of the run whose values are vehicles; none if it takes none now. On real vehicles a command is pressed twice.
export interface Commands { keys: string[]; twice: boolean }

const width = 120, height = 28;

export function plot(points: { time: number; value: number }[], tint: string, name: string): SVGElement {
  const values = points.map((p) => p.value), least = Math.min(...values), most = Math.max(...values);
  const from = points[0].time, length = Math.max(points[points.length - 1].time - from, 1e-9), range = most - least || 1;
  const at = points.map((p) => `${(((p.time - from) / length) * width).toFixed(1)},${(height - 2 - ((p.value - least) / range) * (height - 4)).toFixed(1)}`);
  const line = svg("polyline", { points: at.join(" "), fill: "none", stroke: tint, "stroke-width": 1.5 });
  return svg("svg", { class: "plot", viewBox: `0 0 ${width} ${height}`, width, height, role: "img",
    "aria-label": `${name}: from ${brief(least)} to ${brief(most)}` }, line, svg("title", {}, `${brief(least)} to ${brief(most)}`));
}

export class VehiclePanel {
  private id: string | null = null;
  private key = "";
  private el = $("vehicle");
  private pressed = false;  // a button that is drawn again between press and release is not clicked
  private armed: { vehicle: string; command: string } | null = null;  // pressed once
  private disarm = 0;

  constructor(private changed: () => void, private command: (key: string, vehicle: string) => void) {
    this.el.addEventListener("pointerdown", () => { this.pressed = true; });
    for (const event of ["pointerup", "pointercancel"]) window.addEventListener(event, () => { this.pressed = false; });
    this.el.addEventListener("keydown", (e) => { if (e.key === "Escape") this.close(); });
  }

  open(id: string) { this.id = id; this.key = ""; }

  private close() {
    this.id = null;
    this.el.hidden = true;
    this.changed();
  }

  show(run: Run, progress: Progress[], commands: Commands) {
    const v = this.id === null ? undefined : run.vehicles.get(this.id);
    this.el.hidden = v === undefined;
    if (!v) return;
    const age = run.moves ? run.time - v.heard : 0, mine = progress.find((p) => p.vehicle === v.id) ?? null;
    // Drawn again once a second at most by the time alone.
    if (this.armed?.vehicle !== v.id) this.armed = null;
    const key = JSON.stringify([commands, this.armed, v.id, v.samples.length, v.samples[v.samples.length - 1], v.tasks.length, v.tasks[v.tasks.length - 1], Math.floor(run.time), run.waiting, mine]);
    if (key === this.key || this.pressed) return;
    this.key = key;
    const tint = colour([...run.vehicles.keys()].indexOf(v.id)), s = v.samples[v.samples.length - 1];
    const dot = h("span", { class: "dot" });
    dot.style.background = tint;
    const focused = this.el.contains(document.activeElement), before = document.activeElement?.id;
    const close = h("button", { "aria-label": `close ${v.id}`, click: () => this.close() }, "✕");
    this.el.replaceChildren(h("div", { class: "head" }, dot, h("b", { id: "vehicle-title" }, v.id), ` ${v.kind} `, close),
      h("dl", {}, ...this.facts(run, v, s, age).flatMap(([name, text]) => [h("dt", {}, name), h("dd", {}, text)])),
      this.task(run, v, mine),
      run.bound.has(v.id) && commands.keys.length ? this.commands(v, commands) : "",
      h("table", { class: "plots" }, h("tbody", {}, ...series(v).map(({ name, unit, points }) => h("tr", {}, h("th", { scope: "row" }, name),
        h("td", {}, plot(points, tint, name)), h("td", { class: "number" }, `${brief(points[points.length - 1].value)} ${unit}`))))));
    if (focused) (before?.startsWith("command-") ? document.getElementById(before) ?? close : close).focus();
  }

  // Posts of this vehicle.
  private commands(v: Vehicle, { keys, twice }: Commands) {
    const press = (key: string) => () => {
      if (twice && this.armed?.command !== key) {
        this.armed = { vehicle: v.id, command: key };
        clearTimeout(this.disarm);
        this.disarm = window.setTimeout(() => { this.armed = null; this.changed(); }, 5000);
        return this.changed();
      }
      this.armed = null;
      this.command(key, v.id);
    };
    return h("div", { class: "commands", role: "group", "aria-label": `commands for ${v.id}` }, ...keys.map((key) =>
      h("button", { id: `command-${key}`, click: press(key) }, this.armed?.command === key ? `${key} ${v.id}: press again` : key)));
  }

  private facts(run: Run, v: Vehicle, s: Sample | undefined, age: number): [string, string][] {
    const facts: [string, string][] = [];
    const t = trouble(run, v);
    if (t.rank > 0) facts.push(["trouble", t.text]);
    if (run.moves) facts.push(["link", v.connected ? (age < 2 ? "heard now" : `heard ${clock(age)} ago`) : "none, last heard " + clock(age) + " ago"]);
    if (!s) return facts;
    if (s.battery !== null) {
      const drain = trend(v.samples);
      const left = drain !== null && drain < -0.05 ? `, ${drain.toFixed(1)} % an hour: empty in ${clock((s.battery * 100 / -drain) * 3600)}` : drain !== null && drain > 0.05 ? `, +${drain.toFixed(1)} % an hour` : "";
      facts.push(["battery", `${Math.round(s.battery * 100)} %${left}`]);
    }
    if (typeof s.depth === "number") facts.push(["depth", `${brief(s.depth)} m`]);
    if (typeof s.altitude === "number") facts.push(["altitude", `${brief(s.altitude)} m`]);
    if (typeof s.speed === "number") facts.push(["speed", `${brief(s.speed)} m/s`]);
    const course = courseOf(v);
    if (course !== null) facts.push(["course", `${((course % 360) + 360) % 360}°`]);
    facts.push(["position", `${s.latitude.toFixed(5)}, ${s.longitude.toFixed(5)}`]);
    if (v.payload.length) facts.push(["devices", v.payload.join(", ")]);
    return facts;
  }

  // What it runs and how far it is, or what the program waits for before it goes on.
  private task(run: Run, v: Vehicle, progress: Progress | null) {
    const task = v.tasks[v.tasks.length - 1];
    if (task && task.until === null) {
      const way = run.ways.get(v.id), points = way && way.plan === task.plan ? way.path.length : 0;
      const share = progress && progress.plan === task.plan ? progress.share : null;
      return h("div", { class: "of-vehicle" }, h("b", {}, task.plan), ` for ${clock(run.time - task.from)}`, points ? `, a way of ${points} points` : "",
        share === null ? null : h("progress", { max: 1, value: share, "aria-label": "progress" }), share === null ? "" : ` ${Math.round(share * 100)} %`,
        share !== null && progress!.remaining !== null ? `, ${clock(progress!.remaining)} left` : "");
    }
    const before = task ? `Last: ${task.plan}, ${task.how} at ${clock(task.until!)}${task.why ? ": " + task.why : ""}. ` : "";
    const waits = run.waiting.map((w) => w.what + (w.lacking ? ` (${w.lacking})` : "")).join("; ");
    return h("div", { class: "of-vehicle" }, before, run.bound.has(v.id) ? (waits ? `Bound. The program waits for ${waits}.` : "Bound, without a task.") : "Not bound.");
  }
}
