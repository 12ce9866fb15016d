// Who ran what when: a row for each vehicle, and one for what the program did.

import { type Mark, type Run, clock } from "./model";
import { h, svg } from "./dom";

const row = 26, left = 118, top = 22;

const nice = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 43200, 86400];

const letter: Record<Mark["kind"], string> =
  { posted: "+", consumed: "−", said: "“", asked: "?", failed: "!", input: "»" };

export function timeline(el: HTMLElement, run: Run, steps: boolean, onMark: (at: string | undefined, time: number) => void) {
  const vehicles = [...run.vehicles.values()].filter((v) => v.tasks.length > 0 || run.bound.has(v.id));
  const width = Math.max(320, el.clientWidth - 4), length = Math.max(run.time, 1);
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
    for (const t of v.tasks) {
      const from = x(t.from), to = x(t.until ?? run.time), wide = Math.max(3, to - from);
      const says = `${v.id}: ${t.plan}, ${steps ? "step " + t.from : clock(t.from)}` +
        (t.until === null ? ", runs" : ` to ${steps ? t.until : clock(t.until)}, ${t.how}`) + (t.why ? `: ${t.why}` : "");
      parts.push(svg("rect", { x: from, y: y + 4, width: wide, height: row - 9, rx: 3, class: "task " + t.how }, svg("title", {}, says)));
      if (wide > 30) parts.push(svg("text", { x: from + 5, y: y + 17, class: "plan " + t.how }, short(t.plan, Math.floor((wide - 8) / 6.4))));
    }
  });

  const y = top + row * vehicles.length;
  parts.push(svg("text", { x: left - 8, y: y + 17, class: "who" }, "program"));
  let last = -99;
  for (const mark of run.marks) {
    const at = x(mark.time);
    if (at - last < 3 && mark.kind !== "failed") continue;
    last = at;
    parts.push(svg("g", { class: "mark " + mark.kind, transform: `translate(${at} ${y + 13})`,
      // Pressing, and not clicking: the picture may be drawn anew in between.
      pointerdown: () => onMark(mark.at, mark.time) },
      svg("circle", { r: 8 }), svg("text", { y: 4 }, letter[mark.kind]), svg("title", {}, `${clock(mark.time)} ${mark.kind}: ${mark.text}`)));
  }
  const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `${vehicles.length} vehicles, ${clock(run.time)}` }, ...parts);
  el.replaceChildren(vehicles.length + run.marks.length ? picture : h("p", { class: "empty" }, "Nothing has happened yet."));
}

function short(text: string, n: number): string {
  return text.length <= n ? text : n < 2 ? "" : text.slice(0, n - 1) + "…";
}
