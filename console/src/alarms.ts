// Alarms of the run: trouble of a vehicle stays on the page until it is marked as seen, also when it has passed.

import { type Alarm, type Run, clock } from "./model";
import { $, h } from "./dom";
import { mark } from "./title";

const most = 4;  // lines
const grouped = 4;  // alarms with one text, from here on

export class Alarms {
  private run = "";
  private seen = new Set<number>();
  private shown = "";
  private el = $("alarms");

  constructor(private select: (vehicle: string) => void) {}

  show(run: string, of: Run) {
    if (run !== this.run) {
      this.run = run;
      this.seen = new Set(JSON.parse(sessionStorage.getItem("seen " + run) ?? "[]"));
    }
    const open = of.alarms.map((alarm, i) => ({ alarm, i })).filter(({ i }) => !this.seen.has(i));
    const shown = JSON.stringify(open);
    if (shown === this.shown) return;
    this.shown = shown;
    mark("alarms", open.length ? `▲ ${open.length}` : "");
    this.el.hidden = open.length === 0;
    const redraw = () => this.show(run, of);
    const item = ({ alarm, i }: { alarm: Alarm; i: number }) => h("li", {},
      h("button", { class: "link", click: () => this.select(alarm.vehicle) }, h("b", {}, alarm.vehicle), ` ${alarm.text} `,
        h("small", {}, `at ${clock(alarm.time)}${alarm.until === null ? "" : `, until ${clock(alarm.until)}`}`)),
      h("button", { "aria-label": `seen: ${alarm.vehicle} ${alarm.text}`, click: () => { this.see([i]); redraw(); } }, "Seen"));
    // Alarms with one text are one line: "40 vehicles: no link".
    const groups = new Map<string, typeof open>();
    for (const o of open) groups.set(o.alarm.text, [...(groups.get(o.alarm.text) ?? []), o]);
    const group = (all: typeof open) => {
      if (all.length < grouped) return all.slice().reverse().map(item);
      const ids = new Set(all.map(({ alarm }) => alarm.vehicle)), last = all[all.length - 1].alarm, go = all.filter(({ alarm }) => alarm.until === null).length;
      return [h("li", {}, h("span", { title: [...ids].join(", ") }, h("b", {}, `${ids.size} vehicles`), `: ${last.text} `,
        h("small", {}, `last at ${clock(last.time)}, ${go ? `${go} still` : "none any more"}`)),
        h("button", { "aria-label": `seen: ${ids.size} vehicles ${last.text}`, click: () => { this.see(all.map(({ i }) => i)); redraw(); } }, "Seen"))];
    };
    const latest = (all: typeof open) => all[all.length - 1].i;
    // The latest first.
    const lines = [...groups.values()].sort((a, b) => latest(b) - latest(a)).flatMap(group);
    this.el.replaceChildren(h("ul", {}, ...lines.slice(0, most)),
      lines.length > most ? h("span", {}, `and ${lines.length - most} more`) : "",
      open.length > 1 ? h("button", { click: () => { this.see(open.map(({ i }) => i)); redraw(); } }, "All seen") : "");
  }

  private see(which: number[]) {
    for (const i of which) this.seen.add(i);
    sessionStorage.setItem("seen " + this.run, JSON.stringify([...this.seen]));
  }
}
