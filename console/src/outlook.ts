// What may still happen in the run: when it will be over, and what may go wrong, as the server has worked it out last.

import type { Outlook } from "./api";
import { h } from "./dom";
import { clock } from "./model";

function over(o: Exclude<Outlook, { error: string }>, now: number): string {
  if (!o.over) return o.complete ? "it does not end by itself" : "its end is unknown";
  const { earliest, latest } = o.over;
  if (latest === null) return `over at ${clock(Math.max(earliest, now))} or later`;
  if (now >= latest) return `over by ${clock(latest)}, by the fleet's durations`;
  if (now > earliest) return `over by ${clock(latest)}`;
  return clock(earliest) === clock(latest) ? `over at ${clock(latest)}` : `over between ${clock(earliest)} and ${clock(latest)}`;
}

const properties = (n: number) => (n === 1 ? "1 property" : `${n} properties`);

// One line; the names of the properties are in it too, if something goes wrong without a fault.
export function outlook(el: HTMLElement, o: Outlook | null, now: number) {
  if (!o) return el.replaceChildren();
  if ("error" in o) return el.replaceChildren(h("span", { title: o.error }, "what may happen is unknown"));
  const looked = o.complete ? "all that may happen from there" : "a part of what may happen from there";
  const of = `From ${clock(o.from.time)}, after ${o.from.transitions} transitions: ${looked}.`;
  const late = o.over && o.over.latest !== null && now >= o.over.latest;
  const parts = [h("span", { title: of, class: late ? "trouble" : "" }, over(o, now))];
  if (o.violated.length) parts.push(h("span", { class: "trouble", title: of }, `may be violated: ${o.violated.join(", ")}`));
  if (o.by_faults.length)
    parts.push(h("span", { title: `If plans fail or links are lost: ${o.by_faults.join(", ")}. ${of}` },
      `faults may violate ${properties(o.by_faults.length)}`));
  if (!o.violated.length && !o.by_faults.length && o.complete) parts.push(h("span", { title: of }, "no property can be violated"));
  el.replaceChildren(...parts.flatMap((part, i) => (i ? [" · ", part] : [part])));
}
