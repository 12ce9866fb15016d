// A run that was, message by message, and perhaps a second one beside it. Both count time from their own start; a place of
// the tape has the messages of both that are not later.

import type { Json, Note } from "./api";
import { type Message, Run } from "./model";

export interface Step { label: string; time: number }
export interface End { how: string; message: string | null; time: number }

export class Reel {
  readonly messages: Message[] = [];
  readonly times: number[] = [];  // of the run, at each message
  readonly steps: Step[] = [];
  end: End | null = null;
  notes: Note[] = [];
  private time = 0;

  constructor(readonly title: string, readonly of?: { run?: string; path?: string }, public program: string | null = null) {}

  add(m: Message) {
    if (m.kind === "journal") this.line(m.line);
    this.messages.push(m);
    this.times.push(this.time);
  }

  private line(line: Json) {
    if (typeof line.time === "number") this.time = Math.max(this.time, line.time);
    if (line.kind === "transition") this.steps.push({ label: line.label, time: this.time });
    if (line.kind === "end") this.end = { how: line.how ?? line.ending ?? "", message: line.message ?? null, time: this.time };
  }

  // The run after so many messages.
  run(count: number, moves: boolean): Run {
    const run = new Run();
    run.moves = moves;
    for (let i = 0; i < count; i++) run.add(this.messages[i]);
    for (const n of this.notes) if (n.time <= run.time) run.note(n.time, n.by ? `${n.by}: ${n.text}` : n.text);
    return run;
  }
}

// How many of [n] ascending values are at most [x].
export function upTo(n: number, value: (i: number) => number, x: number): number {
  let low = 0, high = n;
  while (low < high) { const middle = (low + high) >> 1; if (value(middle) <= x) low = middle + 1; else high = middle; }
  return low;
}

export class Tape {
  private other: Reel | null = null;
  private order: boolean[] = [];  // of each place of two runs, whether its message is of the second one
  private both: Message[] = [];

  constructor(readonly first: Reel) {}

  get second() { return this.other; }

  // Both are whole: their messages are put in the order of time.
  set second(reel: Reel | null) {
    this.other = reel;
    this.order = [];
    this.both = [];
    if (!reel) return;
    for (let a = 0, b = 0; a < this.first.times.length || b < reel.times.length;) {
      const isSecond = a === this.first.times.length || (b < reel.times.length && reel.times[b] < this.first.times[a]);
      this.order.push(isSecond);
      this.both.push(isSecond ? reel.messages[b++] : this.first.messages[a++]);
    }
  }

  get length() { return this.other ? this.order.length : this.first.messages.length; }

  // How many messages of each are not behind this place.
  counts(place: number): [number, number] {
    if (!this.other) return [place, 0];
    let b = 0;
    for (let i = 0; i < place; i++) if (this.order[i]) b++;
    return [place - b, b];
  }

  message(place: number): Message { return (this.other ? this.both : this.first.messages)[place]; }

  // The place behind all that is not later than [time].
  placeOf(time: number): number {
    const count = (reel: Reel | null) => (reel ? upTo(reel.times.length, (i) => reel.times[i], time) : 0);
    return count(this.first) + count(this.other);
  }
}

// Where two runs part, and which of their steps (from 1) only one of them has, in whatever order.
export interface Differences { same: number; only: [Set<number>, Set<number>] }

export function differences(a: Step[], b: Step[]): Differences {
  let same = 0;
  while (same < a.length && same < b.length && a[same].label === b[same].label) same++;
  const lacking = (here: Step[], there: Step[]) => {
    const left = new Map<string, number>();
    for (const s of there) left.set(s.label, (left.get(s.label) ?? 0) + 1);
    const only = new Set<number>();
    here.forEach((s, i) => {
      const n = left.get(s.label) ?? 0;
      if (n) left.set(s.label, n - 1); else only.add(i + 1);
    });
    return only;
  };
  return { same, only: [lacking(a, b), lacking(b, a)] };
}
