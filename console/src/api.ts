// The console's interface: docs/api.md.

export type Json = any;

export interface Question { number: number; prompt: string; kind: "value" | "truth"; at: string | null; refused: string | null; to: string | null }
export interface OpenQuestion { prompt: string; of: "task" | "script"; at: string | null; until: number | null; to: string | null }
// The operator of a page, if operators have names.
export interface Operator { name: string | null; admin: boolean; duties: string[] }
export interface Diagnostic {
  from: number; to: number; line: number; column: number; severity: "error" | "warning";
  message: string; code: string; hint?: string; file?: string;
}
export interface RunStatus {
  id: string; state: "running" | "stopping" | "over"; speed: number | null; simulated: boolean; inputs: string[]; vehicle_inputs: string[];
  question: Question | null; questions: OpenQuestion[]; progress: Progress[]; outcome: { how: string; text: string; diagnostics: Diagnostic[] } | null;
  program: string | null; journal: string | null; counterexample: string | null; outlook: Outlook | null;
}
// Of the run from its present on, or why that is unknown.
export type Outlook = { error: string } | {
  from: { time: number; transitions: number }; over: { earliest: number; latest: number | null } | null;
  running: { vehicle: string; plan: string; earliest: number; latest: number }[];
  violated: string[]; by_faults: string[]; complete: boolean;
};
// How far a vehicle is with its plan, by its own estimate; [remaining] in seconds.
export interface Progress { vehicle: string; plan: string; share: number; remaining: number | null }
export interface Going { number: number; state: string; progress: string }
export interface Status {
  instance: string; folder: string; tiles: string | null; simulated: boolean; version: string; run: RunStatus | null;
  exploration: Going | null; timing: Going | null; graph: Going | null; replacement: Going | null;
  helm: { holder: string | null; asking: string[]; taken_from: string | null }; watching: number;
}
// The vehicles of a network while no run goes on: each as a line of a journal, of the time when it was heard.
export interface Heard { time: number; vehicles: Json[]; error: string | null }
export interface LogLine { time: number; severity: string; about: string[]; text: string }
export interface Waiting { time: number; for: { what: string; at?: string; lacking?: string }[] }

// On a moment of a run that was.
export interface Note { time: number; text: string; by: string | null; at: string }

export type Pair = [number, number];
// Values of the program's variables on the map.
export interface Place { name: string; position?: Pair; centre?: Pair; radius?: number; rings?: Pair[][] }
// A number of the text, and whether one below 0 may stand there.
export interface ShapeNumber { from: number; to: number; negative: boolean }
export interface ShapePoint { at: Pair; latitude?: ShapeNumber; longitude?: ShapeNumber }
export interface Shape {
  name: string; from: number; to: number; kind: "position" | "way" | "plan" | "area" | "circle" | "computed"; points: ShapePoint[];
  holes?: ShapePoint[][]; radius?: number; metres?: ShapeNumber; centre?: Pair; rings?: Pair[][];
}
export interface Fence {
  fence: string; rule: "inside" | "outside" | "depth" | "height" | "distance"; margin?: number; metres?: number;
  centre?: Pair; radius?: number; rings?: Pair[][];
}
export interface Way { vehicle: string; plan: string; path: Pair[] }

// A page keeps its key when it is loaded again, and so its helm. It is a secret: other clients see a name made from it.
const fresh = () => "page-" + [...crypto.getRandomValues(new Uint8Array(16))].map((b) => b.toString(16).padStart(2, "0")).join("");
const client: string = sessionStorage.getItem("client") ?? fresh();
sessionStorage.setItem("client", client);

export class Refusal extends Error {
  constructor(public code: string, message: string, public diagnostics: Diagnostic[]) { super(message); }
}

// Requests that only compute are aborted where a command needs a connection: browsers have six to a server.
let computing = new AbortController();
const computes = /^(check|complete|hover|signature|definition|format|shapes|plans|world|runs|files|layer|exploration|timing|graph|replacement|run\/differences)\b/;

export function makeWay() {
  computing.abort();
  computing = new AbortController();
}

export async function ask(verb: string, path: string, body?: Json, signal?: AbortSignal): Promise<Json> {
  const isCommand = verb !== "GET" && !(verb === "POST" && computes.test(path));
  const reply = await fetch("/api/" + path, {
    method: verb,
    headers: { "X-Dolphin-Client": client, ...(body === undefined ? {} : { "Content-Type": "application/json" }) },
    body: body === undefined ? undefined : JSON.stringify(body),
    signal: signal ?? (isCommand ? undefined : computing.signal),
    priority: isCommand ? "high" : "low",
  });
  const found = await reply.json();
  if (!reply.ok) throw new Refusal(found.error.code, found.error.message, found.error.diagnostics ?? []);
  return found;
}

export const get = (path: string) => ask("GET", path);
export const post = (path: string, body: Json = {}, signal?: AbortSignal) => ask("POST", path, body, signal);

export interface Listener {
  status(s: Status): void;
  reset(id: string): void;
  journal(line: Json): void;
  log(line: LogLine): void;
  waiting(w: Waiting): void;
  places(p: { time: number; places: Place[] }): void;
  way(w: { time: number; way: Way }): void;
  clock(time: number): void;
  role(role: "steers" | "answers" | "watches", me: string, operator: Operator | null): void;
  heard(h: Heard): void;
  beat(): void;  // something came
  link(up: boolean, why?: string): void;
}

export function listen(l: Listener) {
  const source = new EventSource("/api/events?client=" + client);
  const on = (name: string, f: (data: Json) => void) =>
    source.addEventListener(name, (e) => { f(JSON.parse((e as MessageEvent).data)); l.beat(); });
  on("beat", () => {});
  on("status", (s) => l.status(s));
  on("run", (r) => l.reset(r.id));
  on("journal", (line) => l.journal(line));
  on("log", (line) => l.log(line));
  on("waiting", (w) => l.waiting(w));
  on("role", (r) => l.role(r.role, r.client, r.operator ?? null));
  on("places", (p) => l.places(p));
  on("way", (w) => l.way(w));
  on("heard", (heard) => l.heard(heard));
  on("clock", (c) => l.clock(c.time));
  source.onopen = () => l.link(true);
  source.onerror = () => {
    l.link(false);
    // A server that was started again refuses nothing, but browsers give up on some errors.
    if (source.readyState !== EventSource.CLOSED) return;
    source.close();
    void get("status").catch((e) => { if (e instanceof Refusal) l.link(false, e.message); });
    setTimeout(() => listen(l), 2000);
  };
}

type Replayed = Pick<Listener, "journal" | "log" | "waiting" | "places" | "way"> & {
  program(path: string | null): void;
  piece(): void;  // some messages have been read
};

function replayed(message: string, l: Replayed) {
  const event = /^event: (.*)$/m.exec(message)?.[1], data = /^data: (.*)$/m.exec(message)?.[1];
  if (!event || !data) return;
  const json = JSON.parse(data);
  if (event === "program") l.program(json.program);
  else if (event === "journal") l.journal(json);
  else if (event === "log") l.log(json);
  else if (event === "waiting") l.waiting(json);
  else if (event === "places") l.places(json);
  else if (event === "way") l.way(json);
  else if (event === "failed") throw new Refusal("replay", json.message, []);
}

// A run that was, message by message, as the server reads its journal.
export async function replay(query: string, l: Replayed, signal: AbortSignal) {
  const reply = await fetch("/api/replay?" + query, { signal, headers: { "X-Dolphin-Client": client } });
  if (!reply.ok) throw new Refusal("replay", (await reply.json()).error.message, []);
  const reader = reply.body!.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const messages = (rest + value).split("\n\n");
    rest = messages.pop()!;
    for (const message of messages) replayed(message, l);
    l.piece();
  }
}
