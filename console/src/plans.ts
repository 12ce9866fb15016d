// The plans that a program gives to vehicles, and those that vehicles know: listed, looked at, drawn before they run.

import type { Json, Pair } from "./api";
import { $, h } from "./dom";
import { distance } from "./measure";
import { clock } from "./model";

export interface Sketch { from: Pair; maneuvers: { maneuver: string; points: Pair[] }[]; breaks?: { why: string; at: Pair | null } | null }

const degrees = (p: Pair) => p.map((x) => x.toFixed(5)).join(", ");
const time = (seconds: number | null) => (seconds === null ? "without end" : clock(seconds));
const speed = (v: number | null) => (v === null ? "" : `${Number(v.toFixed(1))} m/s`);

export class Plans {
  private found: Json = null;
  private note = "";
  private chosen = "";

  // [draw] puts a plan on the map, or takes it away.
  constructor(private draw: (sketch: Sketch | null) => void) { this.render(); }

  show(found: Json, note: string) {
    this.found = found;
    this.note = note;
    this.choose(found.plans.some((p: Json) => p.way && this.key(p) === this.chosen) ? this.chosen : "");
  }

  say(text: string) { this.found = null; this.note = text; this.choose(""); }

  // Another program: the plans are not of it.
  forget() { this.say(""); }

  // A run shows where vehicles go.
  undraw() { this.choose(""); }

  // A program may give different plans of one name.
  private key(p: Json) { return p.plan + " " + this.found.plans.indexOf(p); }

  private choose(key: string) {
    this.chosen = key;
    const plan = this.found?.plans.find((p: Json) => this.key(p) === key);
    this.draw(plan?.way ? { ...plan.way, breaks: plan.breaks } : null);
    this.render();
  }

  private render() {
    const focused = document.activeElement?.id;
    $("plans").replaceChildren(...this.parts());
    if (focused?.startsWith("plan-")) document.getElementById(focused)?.focus();
  }

  private parts(): Node[] {
    const { found } = this, parts: Node[] = this.note ? [h("p", { class: "hint" }, this.note)] : [];
    if (!found) return parts;
    if (found.unfinished)
      parts.push(h("p", { class: "trouble" }, `The run that the plans are taken from did not complete: ${found.unfinished}`));
    parts.push(h("h3", {}, "Given by the program"), found.plans.length ? h("ul", { class: "plans" }, ...found.plans.map((p: Json) => this.plan(p)))
      : h("p", { class: "empty" }, "None, in a run on the simulated fleet."));
    const known = found.vehicles.map((v: Json) => h("tr", {}, h("th", { scope: "row" }, v.vehicle), h("td", { class: "wraps" }, v.knows.join(", ") || "none")));
    parts.push(h("h3", {}, "Known to vehicles by name, as the fleet file says"), h("table", { class: "known" }, h("tbody", {}, ...known)));
    return parts;
  }

  private plan(p: Json): Node {
    const who = h("small", {}, ` for ${p.vehicles.join(", ")}`);
    if (!p.way) return h("li", {}, p.plan, who, h("small", {}, ": by name; vehicles know its way, the program does not say it"));
    const key = this.key(p), on = key === this.chosen;
    const length = `: ${distance(p.way.metres)}, ${time(p.way.seconds)}`;
    return h("li", {}, h("button", { id: "plan-" + key.replace(/\W/g, "-"), "aria-pressed": String(on), title: "Shows its maneuvers, and its way on the map",
      click: () => this.choose(on ? "" : key) }, p.plan), who, h("small", {}, length),
      p.breaks ? h("p", { class: "trouble" }, p.breaks.why) : null, on ? this.maneuvers(p.way) : null);
  }

  private maneuvers(way: Json): Node {
    const row = (m: Json) => {
      const last: Pair | undefined = m.points[m.points.length - 1];
      const to = !last ? "" : degrees(last) + (m.points.length > 1 ? ` (${m.points.length} points)` : "");
      return h("tr", {}, h("td", {}, m.maneuver), h("td", { class: "number" }, to), h("td", { class: "number" }, last ? speed(m.speed) : ""),
        h("td", { class: "number" }, m.stays === 0 ? "" : time(m.stays)));
    };
    return h("table", {}, h("thead", {}, h("tr", {}, ...["maneuver", "to", "speed", "stays"].map((t) => h("th", { scope: "col" }, t)))),
      h("tbody", {}, ...way.maneuvers.map(row)));
  }
}
