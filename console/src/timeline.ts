// Tasks over time: a row for each vehicle, and one for the program. Events can be picked, by pressing
// it or by the arrow keys: then it is told in words, with its place in the program and on the map.

import type { Window } from "./outlook";
import { type Mark, type Run, type Task, type Vehicle, clock } from "./model";
import { h, svg } from "./dom";

// What was picked; vehicles are where they were then.
export interface Picked { key: string; time: number; vehicle: string | null; text: string; at?: string; step: number; second?: boolean }

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

// A run as it is drawn: [only] has the steps that the run beside it lacks.
export interface View { run: Run; steps: boolean; windows: Map<string, Window>; title?: string; only?: Set<number>; second?: boolean }

// One run, or two below one another on one scale.
export function timeline(el: HTMLElement, views: View[], picked: string | null, pick: (p: Picked) => void) {
  const length = Math.max(...views.map(extent));
  const isEmpty = views.every(({ run }) => run.marks.length + rows(run).length === 0);
  el.replaceChildren(...(isEmpty ? [h("p", { class: "empty" }, "Nothing has happened yet.")]
    : views.flatMap((view) => [view.title ? h("h3", {}, view.title) : "", draw(el, view, length, picked, pick)])));
}

const rows = (run: Run) => [...run.vehicles.values()].filter((v) => v.tasks.length > 0 || run.bound.has(v.id));
const windowIn = (windows: Map<string, Window>, v: Vehicle, t: Task) =>
  (t.until === null && windows.get(v.id)?.plan === t.plan ? windows.get(v.id) : undefined);

// What is due has at most as much room as what has been.
function extent({ run, windows }: View): number {
  const due = rows(run).flatMap((v) => v.tasks.map((t) => windowIn(windows, v, t)?.latest ?? 0));
  return Math.max(run.time, 1, Math.min(2 * run.time, ...[Math.max(0, ...due)]));
}

function draw(el: HTMLElement, { run, steps, windows, only, second }: View, length: number, picked: string | null, pick: (p: Picked) => void): Node {
  const vehicles = rows(run), width = Math.max(320, el.clientWidth - 4);
  const here = (p: Picked): Picked => (second ? { ...p, key: "second " + p.key, text: "second run: " + p.text, second } : p);
  const alone = (at: number) => (only?.has(at) ? " only" : ""), inWords = (at: number) => (only?.has(at) ? "; not in the other run" : "");
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
      const window = windowIn(windows, v, t), isLate = window !== undefined && run.time > window.latest;
      const from = x(t.from), to = x(t.until ?? run.time), wide = Math.max(3, to - from), one = here(ofTask(v, t, n, steps, window, run.time));
      // Dark until it may be over, light until it has to be.
      if (window && !isLate) for (const [kind, start, end] of [["ahead", run.time, window.earliest], ["ahead maybe", Math.max(run.time, window.earliest), window.latest]] as const)
        if (Math.min(end, length) > start)
          parts.push(svg("rect", { x: x(start), y: y + 4, width: x(Math.min(end, length)) - x(start), height: row - 9, class: kind }));
      parts.push(svg("rect", { x: from, y: y + 4, width: wide, height: row - 9, rx: 3, class: "task " + t.how + (isLate ? " late" : "") + alone(t.step) + (one.key === picked ? " picked" : ""),
        // Pressing, and not clicking: the picture may be drawn anew in between.
        pointerdown: () => pick(one) }, svg("title", {}, one.text + inWords(t.step))));
      if (wide > 30) parts.push(svg("text", { x: from + 5, y: y + 17, class: "plan " + t.how }, short(t.plan, Math.floor((wide - 8) / 6.4))));
    });
  });

  if (length > run.time) parts.push(svg("line", { x1: x(run.time), x2: x(run.time), y1: top - 4, y2: height, class: "now" }));
  const y = top + row * vehicles.length;
  parts.push(svg("text", { x: left - 8, y: y + 17, class: "who" }, "program"));
  let last = -99;
  run.marks.forEach((mark, i) => {
    const at = x(mark.time), one = here(ofMark(mark, i, steps));
    if (at - last < 3 && mark.kind !== "failed" && mark.kind !== "note" && one.key !== picked) return;
    last = at;
    parts.push(svg("g", { class: "mark " + mark.kind + (mark.kind === "note" ? "" : alone(mark.step)) + (one.key === picked ? " picked" : ""), transform: `translate(${at} ${y + 13})`,
      pointerdown: () => pick(one) },
      svg("circle", { r: 8 }), svg("text", { y: 4 }, letter[mark.kind]), svg("title", {}, one.text + (mark.kind === "note" ? "" : inWords(mark.step)))));
  });
  return svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `${vehicles.length} vehicles, ${clock(run.time)}` }, ...parts);
}

function short(text: string, n: number): string {
  return text.length <= n ? text : n < 2 ? "" : text.slice(0, n - 1) + "…";
}
