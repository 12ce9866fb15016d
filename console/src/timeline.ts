// Tasks over time: a row for each vehicle, and one for the program. Events can be picked, by pressing
// it or by the arrow keys: then it is told in words, with its place in the program and on the map.

import type { Window } from "./outlook";
import { type Mark, type Run, type Task, type Vehicle, clock } from "./model";
import { h, svg } from "./dom";

// What was picked; vehicles are where they were then.
export interface Picked { key: string; time: number; vehicle: string | null; text: string; at?: string; step: number }

const row = 26, left = 118, top = 22;

const nice = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 43200, 86400];

const letter: Record<Mark["kind"], string> =
  { posted: "+", consumed: "−", said: "“", asked: "?", failed: "!", input: "»", note: "✎" };

// Of a task that runs, with the time that the fleet gives it.
function runs(window: Window | undefined, now: number): string {
  if (!window) return ", runs";
  const due = window.earliest === window.latest ? `at ${clock(window.latest)}` : `between ${clock(window.earliest)} and ${clock(window.latest)}`;
  return now > window.latest ? `, is late by ${clock(now - window.latest)}: due ${due}` : `, runs, due ${due}`;
}

const ofTask = (v: Vehicle, t: Task, i: number, steps: boolean, window?: Window, now = 0): Picked => ({ key: `${v.id} ${i}`, time: t.from, vehicle: v.id, at: t.at, step: t.step,
  text: `${v.id}: ${t.plan}, ${steps ? "step " + t.from : clock(t.from)}` +
    (t.until === null ? runs(window, now) : ` to ${steps ? t.until : clock(t.until)}, ${t.how}`) + (t.why ? `: ${t.why}` : "") });

const ofMark = (m: Mark, i: number, steps: boolean): Picked => ({ key: `program ${i}`, time: m.time, vehicle: null, at: m.at, step: m.step,
  text: `${steps ? "step " + m.time : clock(m.time)} ${m.kind}: ${m.text}` });

// All that can be picked, in its order.
export function happenings(run: Run, steps: boolean): Picked[] {
  const tasks = [...run.vehicles.values()].flatMap((v) => v.tasks.map((t, i) => ofTask(v, t, i, steps)));
  return [...tasks, ...run.marks.map((m, i) => ofMark(m, i, steps))].sort((a, b) => a.time - b.time || a.step - b.step);
}

export function timeline(el: HTMLElement, run: Run, steps: boolean, picked: string | null, pick: (p: Picked) => void, windows: Map<string, Window>) {
  const vehicles = [...run.vehicles.values()].filter((v) => v.tasks.length > 0 || run.bound.has(v.id));
  const windowOf = (v: Vehicle, t: Task) => (t.until === null && windows.get(v.id)?.plan === t.plan ? windows.get(v.id) : undefined);
  const due = vehicles.flatMap((v) => v.tasks.map((t) => windowOf(v, t)?.latest ?? 0));
  // What is due has at most as much room as what has been.
  const width = Math.max(320, el.clientWidth - 4), length = Math.max(run.time, 1, Math.min(2 * run.time, ...[Math.max(0, ...due)]));
  const x = (time: number) => left + 9 + (time / length) * (width - left - 24);
  const height = top + row * (vehicles.length + 1) + 6;
  const parts: Node[] = [];

  const step = nice.find((s) => (width - left) / (length / s) >= 64) ?? nice[nice.length - 1];
  for (let t = 0; t <= length; t += step)
    parts.push(svg("line", { x1: x(t), x2: x(t), y1: top - 4, y2: height, class: "tick" }),
      svg("text", { x: x(t), y: top - 8, class: "time" }, steps ? String(t) : clock(t)));

  vehicles.forEach((v, i) => {
    const y = top + row * i;
    parts.push(svg("text", { x: left - 8, y: y + 17, class: "who" }, short(v.id, 16)));
    parts.push(svg("line", { x1: left, x2: width, y1: y + row - 1, y2: y + row - 1, class: "rule" }));
    for (const gap of v.silent)
      parts.push(svg("rect", { x: x(gap.from), y: y + 1, width: Math.max(2, x(gap.until ?? run.time) - x(gap.from)), height: row - 3, class: "gap" },
        svg("title", {}, `${v.id}: no link`)));
    v.tasks.forEach((t, n) => {
      const window = windowOf(v, t), isLate = window !== undefined && run.time > window.latest;
      const from = x(t.from), to = x(t.until ?? run.time), wide = Math.max(3, to - from), one = ofTask(v, t, n, steps, window, run.time);
      // Dark until it may be over, light until it has to be.
      if (window && !isLate) for (const [kind, start, end] of [["ahead", run.time, window.earliest], ["ahead maybe", Math.max(run.time, window.earliest), window.latest]] as const)
        if (Math.min(end, length) > start)
          parts.push(svg("rect", { x: x(start), y: y + 4, width: x(Math.min(end, length)) - x(start), height: row - 9, class: kind }));
      parts.push(svg("rect", { x: from, y: y + 4, width: wide, height: row - 9, rx: 3, class: "task " + t.how + (isLate ? " late" : "") + (one.key === picked ? " picked" : ""),
        // Pressing, and not clicking: the picture may be drawn anew in between.
        pointerdown: () => pick(one) }, svg("title", {}, one.text)));
      if (wide > 30) parts.push(svg("text", { x: from + 5, y: y + 17, class: "plan " + t.how }, short(t.plan, Math.floor((wide - 8) / 6.4))));
    });
  });

  if (length > run.time) parts.push(svg("line", { x1: x(run.time), x2: x(run.time), y1: top - 4, y2: height, class: "now" }));
  const y = top + row * vehicles.length;
  parts.push(svg("text", { x: left - 8, y: y + 17, class: "who" }, "program"));
  let last = -99;
  run.marks.forEach((mark, i) => {
    const at = x(mark.time), one = ofMark(mark, i, steps);
    if (at - last < 3 && mark.kind !== "failed" && mark.kind !== "note" && one.key !== picked) return;
    last = at;
    parts.push(svg("g", { class: "mark " + mark.kind + (one.key === picked ? " picked" : ""), transform: `translate(${at} ${y + 13})`,
      pointerdown: () => pick(one) },
      svg("circle", { r: 8 }), svg("text", { y: 4 }, letter[mark.kind]), svg("title", {}, one.text)));
  });
  const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `${vehicles.length} vehicles, ${clock(run.time)}` }, ...parts);
  el.replaceChildren(vehicles.length + run.marks.length ? picture : h("p", { class: "empty" }, "Nothing has happened yet."));
}

function short(text: string, n: number): string {
  return text.length <= n ? text : n < 2 ? "" : text.slice(0, n - 1) + "…";
}
