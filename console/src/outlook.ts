// What may still happen in the run: when it will be over, and what may go wrong, as the server has worked it out last.

import type { Outlook, RunStatus } from "./api";
import { h } from "./dom";
import { clock } from "./model";

// When a run began, by the clock on the wall: known better with each report, which comes late if at all. Null: the time
// of the run is not ours.
export class Wall {
  private run = "";
  private began = 0;

  heard(run: RunStatus | null, time: number) {
    if (!run) return;
    const began = Date.now() - time * 1000;
    this.began = run.id === this.run ? Math.min(this.began, began) : began;
    this.run = run.id;
  }

  at(run: RunStatus): ((time: number) => string) | null {
    if (run.id !== this.run || (run.simulated && run.speed !== 1)) return null;
    return (time) => {
      const date = new Date(this.began + time * 1000), hours = date.toLocaleTimeString("en-GB", { hour: "2-digit", minute: "2-digit" });
      return date.toDateString() === new Date().toDateString() ? hours : `${date.toLocaleDateString("en-GB", { weekday: "short" })} ${hours}`;
    };
  }
}

type Known = Exclude<Outlook, { error: string }>;

function over(o: Known, now: number, at: (time: number) => string): string {
  if (!o.over) return o.complete ? "it does not end by itself" : "its end is unknown";
  const { earliest, latest } = o.over;
  if (latest === null) return `over at ${at(Math.max(earliest, now))} or later`;
  if (now >= latest) return `over by ${at(latest)}, by the fleet's durations`;
  if (now > earliest || at(earliest) === at(latest)) return now > earliest ? `over by ${at(latest)}` : `over at ${at(latest)}`;
  return `over between ${at(earliest)} and ${at(latest)}`;
}

const properties = (n: number) => (n === 1 ? "1 property" : `${n} properties`);

// One line; the names of the properties are in it too, if something goes wrong without a fault.
export function outlook(el: HTMLElement, o: Outlook | null, now: number, wall: ((time: number) => string) | null) {
  if (!o) return el.replaceChildren();
  if ("error" in o) return el.replaceChildren(h("span", { title: o.error }, "what may happen is unknown"));
  const looked = o.complete ? "all that may happen from there" : "a part of what may happen from there";
  const of = `From ${clock(o.from.time)}, after ${o.from.transitions} transitions: ${looked}.`;
  const late = o.over && o.over.latest !== null && now >= o.over.latest;
  const since = wall ? `Since the start: ${over(o, now, clock)}. ${of}` : of;
  const parts = [h("span", { title: since, class: late ? "trouble" : "" }, over(o, now, wall ?? clock))];
  // First: a phone may have no room for more.
  if (o.violated.length) parts.unshift(h("span", { class: "trouble", title: of }, `may be violated: ${o.violated.join(", ")}`));
  if (o.by_faults.length)
    parts.push(h("span", { title: `If plans fail or links are lost: ${o.by_faults.join(", ")}. ${of}` },
      `faults may violate ${properties(o.by_faults.length)}`));
  if (!o.violated.length && !o.by_faults.length && o.complete) parts.push(h("span", { title: of }, "no property can be violated"));
  el.replaceChildren(...parts.flatMap((part, i) => (i ? [" · ", part] : [part])));
}

// When tasks that run will be over, by the fleet's durations.
export interface Window { plan: string; earliest: number; latest: number }

export function windows(o: Outlook | null): Map<string, Window> {
  return new Map(o && !("error" in o) ? o.running.map((r) => [r.vehicle, r]) : []);
}
