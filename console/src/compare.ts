// Two runs that were, in words: where they part, how they end, and how many steps only one of them has.

import { h } from "./dom";
import { clock } from "./model";
import { type Differences, type End, type Reel, type Tape, differences } from "./tape";

let known: { first: Reel; second: Reel; found: Differences } | null = null;

const ending = (end: End | null) => (end ? `${end.how}${end.message ? `: ${end.message}` : ""} at ${clock(end.time)}` : "no end");
const steps = (n: number) => `${n} ${n === 1 ? "step" : "steps"}`;

// The differences, also for the timelines; null if there is no second run. The buttons go to a moment.
export function compare(el: HTMLElement, tape: Tape | null, seek: (time: number) => void): Differences | null {
  const second = tape?.second;
  if (!tape || !second) { known = null; el.hidden = true; return null; }
  const { first } = tape;
  if (known?.first === first && known.second === second) return known.found;
  const found = differences(first.steps, second.steps), { same, only } = found;
  known = { first, second, found };
  const next = (reel: Reel) => {
    const step = reel.steps[same];
    return step ? h("button", { class: "link", click: () => seek(step.time) }, `${step.label} at ${clock(step.time)}`) : "nothing";
  };
  const isSame = same === first.steps.length && same === second.steps.length;
  el.replaceChildren(
    isSame ? h("p", {}, `Both have the same ${steps(same)}.`)
      : h("p", {}, same ? `The same for ${steps(same)}; then first: ` : "From the first step on. First: ", next(first), "; second: ", next(second), "."),
    h("p", {}, `Ends: ${ending(first.end)}; second: ${ending(second.end)}.`),
    only[0].size + only[1].size ? h("p", {}, `Outlined: ${steps(only[0].size)} only the first has, ${only[1].size} only the second.`) : "");
  el.hidden = false;
  return found;
}
