// What is known without running the program: the verdicts of explore, the times of time, the state graph.

import type { Json, Status } from "./api";
import { $, h, svg } from "./dom";
import { StateGraph } from "./graph";
import { clock } from "./model";
import { inWords } from "./place";

type Subject = "exploration" | "timing" | "graph";
interface Events { show: (found: Json, program: string | null) => void; goTo: (at: string, of: string | null) => void; cancel: (s: Subject) => void; graph: () => void;
  enact: (s: "exploration" | "timing") => void }

const mark = (verdict: string) => (verdict === "holds" ? "✓" : verdict === "violated" ? "✗" : "–");
// What the battery of a vehicle has left; never more than it has.
const left = (b: Json) => (b.verdict === "violated" ? "its battery runs empty in some run"
  : b.verdict === "holds" ? `battery: ${Math.floor(b.least * 1000 + 1e-6) / 10} % at the least` : "whether its battery lasts is not known");
const hints: Partial<Record<Subject, string>> = {
  exploration: "Explore looks at every run that the program can have in its fleet's world.",
  timing: "Time says when tasks and runs start and end, at the earliest and at the latest.",
};

export class Verdicts {
  private results = new Map<Subject, Json>();
  private now: Partial<Record<Subject, { state: string; progress: string } | null>> = {};
  private picture = new StateGraph();
  private drawn = new Map<Subject, { key: string; found: Json }>();  // drawn again only if it has changed

  constructor(private events: Events) {
    $("graph").addEventListener("click", () => { this.wanted = true; events.graph(); });
    this.draw();
  }

  status(s: Status) {
    this.now = { exploration: s.exploration, timing: s.timing, graph: s.graph };
    this.draw();
  }

  result(subject: Subject, found: Json) {
    this.results.set(subject, found);
    this.draw();
    if (subject === "graph" && found?.state === "over" && this.wanted) this.picture.open(found.result);
    if (subject === "graph" && found?.state !== "running") this.wanted = false;
  }

  private open: { path: string; hash: string | null } = { path: "", hash: null };

  // What is in the editor: what was found may be of another program, or of what this one was.
  about(path: string, hash: string | null) {
    this.open = { path, hash };
    this.drawn.clear();
    this.draw();
  }

  private of(found: Json): Node[] {
    const { path, hash } = this.open;
    const text = found.program !== path ? `Of ${found.program ?? "a program that is not here any more"}.`
      : hash !== null && found.hash !== hash ? "Of the program as it was before it was changed." : "";
    return text ? [h("p", { class: "outcome" }, text)] : [];
  }

  // A graph that another page asked for does not open here.
  private wanted = false;
  private draw() {
    for (const subject of ["exploration", "timing", "graph"] as const) this.part(subject);
  }

  private part(subject: Subject) {
    const el = $("found-" + subject), now = this.now[subject], found = this.results.get(subject);
    const key = JSON.stringify(now ?? null);
    if (this.drawn.has(subject) && this.drawn.get(subject)!.key === key && this.drawn.get(subject)!.found === found) return;
    this.drawn.set(subject, { key, found });
    const hint = h("p", { class: "empty" }, hints[subject] ?? "");
    if (now?.state === "running")
      return el.replaceChildren(h("p", {}, now.progress || `${subject} goes on`), h("progress", { "aria-label": subject }),
        h("button", { click: () => this.events.cancel(subject) }, "Cancel"));
    if (!found || found.state !== now?.state) return el.replaceChildren(hint);
    if (found.state === "failed") return el.replaceChildren(...this.of(found), h("pre", { class: "trouble" }, found.error));
    if (found.state === "cancelled") return el.replaceChildren(h("p", { class: "empty" }, `${subject}: cancelled`));
    if (subject === "exploration") return el.replaceChildren(...this.of(found), ...this.exploration(found));
    if (subject === "timing") return el.replaceChildren(...this.of(found), ...this.timing(found));
    el.replaceChildren(...this.of(found), h("button", { click: () => this.picture.open(found.result) }, `Show the state graph: ${found.result.states} states`));
  }

  private through(subject: "exploration" | "timing", found: Json, text: string) {
    return h("span", { class: "found" }, h("button", { click: () => this.events.show(found.counterexample, found.program) }, text),
      h("button", { class: "enact", title: "Simulated vehicles do what the counterexample says", click: () => this.events.enact(subject) },
        "Run this in the simulator"));
  }

  private exploration(found: Json): Node[] {
    const r = found.result, cx = found.counterexample;
    const line = (v: Json) => h("li", { class: v.verdict.replace(/ .*/, "") }, h("b", {}, mark(v.verdict)), ` ${v.property}: ${v.verdict}`,
      cx && cx.property === v.property ? this.through("exploration", found, "Step through it") : null);
    const named = cx && r.verdicts.some((v: Json) => v.property === cx.property);
    const pairs = r.verdicts.flatMap((v: Json) => v.pairs ?? []).map((p: Json) => this.pair(found, p));
    return [h("ul", { class: "verdicts" }, ...r.verdicts.map(line), ...pairs),
      ...(cx && !named ? [this.through("exploration", found, `Step through: ${cx.property || "a run"}`)] : []),
      h("p", { class: "hint" }, `${r.states} states, ${r.transitions} transitions, ${r.seconds.toFixed(2)} s`)];
  }

  // {1 Times}

  private timing(found: Json): Node[] {
    const r = found.result, cx = found.counterexample;
    const span = (w: Json) => (w.latest === null ? `${clock(w.earliest)} or later` : w.latest === w.earliest ? clock(w.latest)
      : `${clock(w.earliest)} to ${clock(w.latest)}`);
    const lines: Node[] = Object.entries<Json>(r.ends).map(([how, w]) => h("li", {}, h("b", {}, "◷"), ` ${how}: ${span(w)}`));
    if (r.deadline !== undefined || r.endless) lines.push(h("li", { class: r.inTime }, h("b", {}, mark(r.inTime)),
      r.deadline !== undefined ? ` over by ${clock(r.deadline)}: ${r.inTime}` : ` every run ends: ${r.inTime}`));
    for (const w of r.within) lines.push(h("li", { class: w.missed ? "violated" : "holds" }, h("b", {}, w.missed ? "✗" : "✓"),
      this.place(found, w.at, w.missed ? ` within: missed, at ${span(w.missed)}` : " within: kept")));
    for (const b of r.batteries) lines.push(h("li", { class: b.verdict }, h("b", {}, mark(b.verdict)), ` ${b.vehicle}: ${left(b)}`));
    if (r.apart) lines.push(h("li", { class: r.apart.verdict }, h("b", {}, mark(r.apart.verdict)), ` ${r.apart.fence}: ${r.apart.verdict}`),
      ...r.apart.pairs.map((p: Json) => this.pair(found, p)));
    for (const what of r.unknown) lines.push(h("li", {}, h("b", {}, "–"), ` duration unknown: ${what.replace(/^.*\//, "")}`));
    if (r.bound) lines.push(h("li", {}, h("b", {}, "–"), ` inconclusive: ${r.bound}`));
    const chain = r.shown?.run.chain ?? [];
    return [h("ul", { class: "verdicts" }, ...lines), this.bars(found, span),
      ...(chain.length ? [h("p", { class: "hint" }, "The end depends on: " +
        chain.map((c: Json) => `${c.what.replace(/^.*\//, "")} (${clock(c.seconds)})`).join(", then "))] : []),
      ...(cx ? [this.through("timing", found, `Step through ${r.shown?.what ?? "a run"}`)] : []),
      h("p", { class: "hint" }, `${r.states} states, ${r.seconds.toFixed(2)} s`)];
  }

  // Plans that may run side by side.
  private pair(found: Json, p: Json) {
    const called = (x: Json) => `'${x.plan}' on ${x.vehicle}`;
    const far = p.metres === null ? "distance unknown" : `${p.metres.toFixed(1)} m between ${p.one.maneuver} and ${p.other.maneuver}`;
    return h("li", { class: p.metres === null ? "inconclusive" : "violated" }, this.place(found, p.one.at, ` ${called(p.one)} beside ${called(p.other)}: ${far}`));
  }

  // Places of times are paths from elsewhere: of the program itself, they are lines of it.
  private at(found: Json, at: string | null): string | null {
    const place = at === null ? null : /^(.*):(\d+:\d+)$/.exec(at);
    if (!place) return null;
    const name = (path: string) => path.replace(/^.*\//, "");
    return name(place[1]) === name(found.program ?? "") ? place[2] : `${name(place[1])}:${place[2]}`;
  }

  private place(found: Json, at: string | null, text: string) {
    const place = this.at(found, at);
    return place ? h("button", { class: "link", click: () => this.events.goTo(place, found.program) }, `${text}, ${inWords(place)}`) : text;
  }

  // A row for each task: light from when it may start until when it may end, dark where it certainly runs.
  private bars(found: Json, span: (w: Json) => string): Node {
    const r = found.result;
    const ends = (t: Json) => [t.ends, t.fails, t.stopped].filter(Boolean);
    const all = [...Object.values<Json>(r.ends), ...r.tasks.flatMap((t: Json) => [t.starts, ...ends(t)])].filter(Boolean);
    const length = Math.max(1, r.deadline ?? 0, ...all.map((w: Json) => w.latest ?? w.earliest));
    const left = 150, width = 480, row = 22, height = row * r.tasks.length + 20;
    const x = (t: number) => left + (t / length) * (width - left - 8);
    const parts: Node[] = [];
    r.tasks.forEach((t: Json, i: number) => {
      const y = row * i, over = ends(t);
      const last = over.some((w: Json) => w.latest === null) ? length : Math.max(t.starts.earliest, ...over.map((w: Json) => w.latest));
      const first = Math.min(...over.map((w: Json) => w.earliest));
      const says = `${t.vehicle}: ${t.task} starts ${span(t.starts)}` + ["ends", "fails", "stopped"].map((m) => (t[m] ? `, ${m} ${span(t[m])}` : "")).join("");
      const sure = t.starts.latest !== null && first > t.starts.latest;
      parts.push(svg("g", { class: "time-row", click: () => { const at = this.at(found, t.at ?? null); if (at) this.events.goTo(at, found.program); } },
        svg("title", {}, says), svg("text", { x: left - 6, y: y + 15, class: "who" }, `${t.vehicle} ${t.task}`.slice(0, 22)),
        svg("rect", { x: x(t.starts.earliest), y: y + 3, width: Math.max(3, x(last) - x(t.starts.earliest)), height: row - 8, rx: 3, class: "maybe" }),
        sure ? svg("rect", { x: x(t.starts.latest), y: y + 3, width: Math.max(2, x(first) - x(t.starts.latest)), height: row - 8, rx: 3, class: "task" }) : svg("g")));
    });
    const line = (t: number, kind: string, says: string) =>
      svg("line", { x1: x(t), x2: x(t), y1: 0, y2: height - 16, class: kind }, svg("title", {}, says));
    parts.push(line(0, "tick", "0:00"), line(length, "tick", clock(length)),
      svg("text", { x: x(0), y: height - 3, class: "time" }, "0:00"), svg("text", { x: x(length), y: height - 3, class: "time last" }, clock(length)));
    if (r.deadline !== undefined) parts.push(line(r.deadline, "deadline", `deadline ${clock(r.deadline)}`));
    return svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "times", role: "img", "aria-label": `when ${r.tasks.length} tasks run` }, ...parts);
  }
}
