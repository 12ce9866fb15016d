// A run, added up from its messages. It decides nothing.

import type { Fence, Json, LogLine, Place, Waiting, Way } from "./api";

export interface Task { plan: string; from: number; until: number | null; how: "runs" | "done" | "failed" | "stopped"; why?: string; at?: string; step: number }
export interface Sample {
  time: number; latitude: number; longitude: number; battery: number | null;
  depth?: number; altitude?: number; speed?: number; readings?: Record<string, number>;
}
export interface Vehicle {
  id: string; kind: string; payload: string[]; connected: boolean; unready: string | null;
  heard: number; samples: Sample[]; tasks: Task[]; silent: { from: number; until: number | null }[]; low: boolean;
}
export interface Mark { time: number; kind: "posted" | "consumed" | "said" | "asked" | "failed" | "input" | "note"; text: string; at?: string; step: number }
// Trouble that needs a look, also when it has passed.
export interface Alarm { kind: "link" | "battery" | "failed"; time: number; vehicle: string; text: string; until: number | null }
export const lowBattery = 0.2;
export type Message =
  | { kind: "journal"; line: Json } | { kind: "log"; line: LogLine } | { kind: "waiting"; waiting: Waiting }
  | { kind: "places"; places: Place[] } | { kind: "way"; way: Way };

const mostSamples = 2000;

export class Run {
  vehicles = new Map<string, Vehicle>();
  allocation = new Map<string, string>();
  bound = new Set<string>();
  tuples: string[] = [];
  marks: Mark[] = [];
  alarms: Alarm[] = [];
  log: LogLine[] = [];
  waiting: Waiting["for"] = [];
  places: Place[] = [];
  fences: Fence[] = [];  // that the program or the fleet has
  ways = new Map<string, Way>();  // of each vehicle, that of the plan described for it last
  moves = true;  // false for a run that was found: the places of its vehicles are unknown
  time = 0;
  at: string | null = null;
  label = "";
  transitions = 0;
  ending: { how: string; message: string | null } | null = null;
  private cause: Json = null;

  vehicle(id: string): Vehicle {
    let v = this.vehicles.get(id);
    if (!v) {
      v = { id, kind: "", payload: [], connected: true, unready: null, heard: 0, samples: [], tasks: [], silent: [], low: false };
      this.vehicles.set(id, v);
    }
    return v;
  }

  add(m: Message) {
    if (m.kind === "log") this.log.push(m.line);
    else if (m.kind === "waiting") this.waiting = m.waiting.for;
    else if (m.kind === "places") this.places = m.places;
    else if (m.kind === "way") this.ways.set(m.way.vehicle, m.way);
    else this.journal(m.line);
  }

  private journal(line: Json) {
    if (typeof line.time === "number") this.time = Math.max(this.time, line.time);
    if (line.format) this.fences = line.fences ?? [];  // the first line
    switch (line.kind) {
      case "vehicle": return this.news(line);
      case "event":
        this.cause = line;
        if (line.event === "input") this.mark("input", `${line.key}: ${JSON.stringify(line.value)}`);
        return;
      case "transition": return this.transition(line);
      case "end": this.ending = { how: line.how ?? line.ending ?? "", message: line.message ?? null }; this.waiting = []; return;
    }
  }

  private mark(kind: Mark["kind"], text: string, at?: string) { this.marks.push({ time: this.time, kind, text, at, step: this.transitions }); }

  // Of a person, later: it is none of the run's own events.
  note(time: number, text: string) {
    const at = this.marks.findIndex((m) => m.time > time);
    this.marks.splice(at < 0 ? this.marks.length : at, 0, { time, kind: "note", text, step: this.transitions });
  }

  private news(line: Json) {
    const v = this.vehicle(line.vehicle);
    v.kind = line.type; v.payload = line.payload; v.unready = line.unready ?? null;
    if (line.connected) {
      v.heard = line.time;
      const last = v.silent[v.silent.length - 1];
      if (last && last.until === null) { last.until = line.time; this.pass("link", v.id); }
      this.charge(v, line.battery);
      const { time, latitude, longitude, battery = null, depth, altitude, speed, readings } = line;
      v.samples.push({ time, latitude, longitude, battery, depth, altitude, speed, readings });
      // The older half is thinned out: a track stays a track.
      if (v.samples.length > mostSamples)
        v.samples = v.samples.filter((_, i) => i % 2 === 0 || i > mostSamples * 0.9);
    } else if (v.connected) {
      v.silent.push({ from: line.time, until: null });
      if (v.samples.length) this.alarm("link", v.id, "no link");
    }
    v.connected = line.connected;
  }

  private alarm(kind: Alarm["kind"], vehicle: string, text: string) {
    this.alarms.push({ kind, time: this.time, vehicle, text, until: null });
  }

  private pass(kind: Alarm["kind"], vehicle: string) {
    for (const a of this.alarms) if (a.kind === kind && a.vehicle === vehicle && a.until === null) a.until = this.time;
  }

  // A battery near the limit gives one alarm.
  private charge(v: Vehicle, battery: number | null) {
    if (typeof battery !== "number") return;
    if (!v.low && battery < lowBattery) { v.low = true; this.alarm("battery", v.id, `battery at ${Math.round(battery * 100)} %`); }
    else if (v.low && battery > lowBattery + 0.05) { v.low = false; this.pass("battery", v.id); }
  }

  private end(id: string, how: Task["how"], why?: string) {
    const tasks = this.vehicle(id).tasks, task = tasks[tasks.length - 1];
    if (task && task.until === null) { task.until = this.time; task.how = how; task.why = why; }
  }

  private transition(line: Json) {
    this.transitions++;
    this.at = line.at ?? this.at;
    this.label = line.words || line.label;
    const cause = this.cause;
    this.cause = null;
    if (cause?.event === "done") this.end(cause.vehicle, "done");
    if (cause?.event === "failed") {
      const plan = this.allocation.get(cause.vehicle) ?? "task";
      this.alarm("failed", cause.vehicle, `${plan} failed: ${cause.why}`);
      this.end(cause.vehicle, "failed", cause.why);
      this.mark("failed", `${cause.vehicle}: ${cause.why}`, line.at);
    }
    // A run that was found has no events: its labels name the ends.
    if (!cause) {
      const ended = /^(done|failed)\(([^,)]*)/.exec(line.label);
      if (ended) this.end(ended[2], ended[1] === "done" ? "done" : "failed");
    }
    for (const [id, plan] of Object.entries<string | null>(line.A ?? {})) {
      if (plan === null) { this.end(id, "stopped"); this.allocation.delete(id); }
      else {
        this.end(id, "stopped");
        this.allocation.set(id, plan);
        this.vehicle(id).tasks.push({ plan, from: this.time, until: null, how: "runs", at: line.at, step: this.transitions });
      }
    }
    for (const id of line.B?.bound ?? []) { this.bound.add(id); this.vehicle(id); }
    for (const id of line.B?.released ?? []) { this.bound.delete(id); this.end(id, "stopped"); }
    for (const pair of line.N?.consumed ?? []) {
      const i = this.tuples.indexOf(pair);
      if (i >= 0) this.tuples.splice(i, 1);
      this.mark("consumed", pair, line.at);
    }
    for (const pair of line.N?.posted ?? []) { this.tuples.push(pair); this.mark("posted", pair, line.at); }
    for (const effect of line.effects ?? []) {
      if (effect.say !== undefined) this.mark("said", effect.say, line.at);
      if (effect.ask !== undefined) this.mark("asked", effect.ask, line.at);
    }
  }
}

// Rank of a vehicle's need for a look.
export function trouble(run: Run, v: Vehicle): { rank: number; text: string } {
  const last = v.tasks[v.tasks.length - 1];
  const battery = v.samples[v.samples.length - 1]?.battery;
  if (!v.connected) return { rank: 4, text: v.samples.length ? "no link since " + clock(v.heard) : "no link yet" };
  if (last?.how === "failed") return { rank: 3, text: `${last.plan} failed${last.why ? ": " + last.why : ""}` };
  if (v.unready) return { rank: 2, text: v.unready };
  if (typeof battery === "number" && battery < lowBattery) return { rank: 1, text: "battery low" };
  return { rank: run.bound.has(v.id) ? 0 : -1, text: "" };
}

// Where a vehicle was, as far as it was heard of by then.
export function whereabouts(v: Vehicle, time: number): Sample | null {
  let found: Sample | null = null;
  for (const s of v.samples) { if (s.time > time) break; found = s; }
  return found;
}

export function clock(seconds: number): string {
  const s = Math.floor(seconds % 60), m = Math.floor(seconds / 60) % 60, h = Math.floor(seconds / 3600);
  const two = (n: number) => String(n).padStart(2, "0");
  return h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}
