// The page: it shows the messages of the server and sends a person's commands.

import { type Diagnostic, type Heard, type Json, type LogLine, type Note, type OpenQuestion, type Operator, type Status, Refusal, ask, get, listen, post, replay } from "./api";
import { choose } from "./choice";
import { HelmView } from "./helm";
import { Stop } from "./stop";
import { $, h } from "./dom";
import { Draw } from "./draw";
import { Editor } from "./editor";
import { Layers } from "./layers";
import { ChartMap, tintOf } from "./map";
import { Run, clock } from "./model";
import { Layout } from "./layout";
import { Readings } from "./readings";
import { Reel, Tape } from "./tape";
import { compare } from "./compare";
import { VehiclePanel } from "./vehicle";
import { VehicleTable } from "./vehicles";
import { beside, inWords, read as readPlace } from "./place";
import { Wall, outlook, windows } from "./outlook";
import { type Picked, type View, happenings, timeline } from "./timeline";
import { Plans } from "./plans";
import { Replacing } from "./replace";
import { Shapes } from "./shapes";
import { Alarms } from "./alarms";
import { Operators, isAsked, mayAnswer } from "./operators";
import { Dialog } from "./question";
import { mark as markTitle, setTitle } from "./title";
import { Verdicts } from "./verdicts";

// A run that was, or one that explore found: gone through by steps.
interface Past {
  tape: Tape; index: number; steps: boolean; found: boolean;
  reading?: AbortController;  // messages are still coming
}

let status: Status | null = null;
let live = new Run();
let heard: Heard | null = null;  // of a network, while no run goes on
let past: Past | null = null;
let shown = live;
let second: Run | null = null;  // of a second run that was, at the same time
let hash: string | null = null;
let dirty = false;
let linked = false;
let watches = false;  // this page's link commands nothing
let answers = false;  // but it answers questions and posts inputs
let me = "";  // the name that others know this page by
let operator: Operator | null = null;

const map = new ChartMap($("map"), (id) => { $<HTMLSelectElement>("about").value = id; renderLog(true); look(id); });
const table = new VehicleTable($("vehicles"), (id) => { map.focus(id); look(id); });
const quoted = (text: string) => `'${text.replace(/[\\']/g, "\\$&")}'`;
const panel = new VehiclePanel(changed, (key, vehicle) => void attempt(() => post("run/post", { pairs: `${key}: vehicles(${quoted(vehicle)})` }))());
new Layout(changed);
const readings = new Readings(tintOf, { changed, mark: (spots) => map.tracks.mark(spots), seek: (time) => { if (past) seek(past.tape.placeOf(time)); } });

// The panel of this vehicle.
function look(id: string) {
  panel.open(id);
  changed();
}

const layers = new Layers(map, tell);
const editor = new Editor($("editor"), { changed: () => { setDirty(true); shapes.changed(); }, checked: showFaults, save,
  elsewhere: (path, from, to) => attempt(async () => { if (await openOther(path)) editor.select(from, to); })() });

// Who may change the program may draw it. What stands in it is on the map until a run is; then while one draws.
const mayEdit = () => !watches && linked;
const shapes = new Shapes(map, editor, mayEdit, tell);
const draw = new Draw(map, editor, shapes, { may: mayEdit, tell, changed: () => { showTab("source"); changed(); },
  stored: (paths, path) => { layers.offer(paths); layers.turnOn(path); } });

function showShapes() {
  draw.show();
  shapes.show(!past && (draw.open || (live.transitions === 0 && !goesOn())), draw.open);
}

// A notice about a failure, which disappears by itself.
let notice = 0;
function tell(text: string, bad = true) {
  const banner = $("banner");
  banner.textContent = text;
  banner.className = bad ? "trouble" : "";
  banner.hidden = false;
  clearTimeout(notice);
  notice = window.setTimeout(() => renderBanner(), 6000);
}

function attempt(f: () => Promise<unknown>) {
  return () => void f().catch((e) => {
    tell(e.message);
    if (e instanceof Refusal && e.diagnostics.length) showFaults(e.diagnostics);
  });
}

const dialog = new Dialog((answer) => attempt(() => post("run/answer", answer))(), (at) => goTo(at, status?.run?.program ?? null));
const verdicts = new Verdicts({ show: showFound, goTo, cancel: (subject) => attempt(() => ask("DELETE", subject, {}))(),
  graph: () => attempt(() => analyse("graph"))(), enact: (of) => attempt(() => enact(of))() });
const plans = new Plans((sketch) => map.sketch(sketch));
const stop = new Stop(tell);
const replacing = new Replacing((text) => tell(text, false));
const helm = new HelmView(attempt, tell);
const operators = new Operators(attempt);
const alarms = new Alarms((id) => { map.focus(id); $<HTMLSelectElement>("about").value = id; renderLog(true); });

// {1 The program}

const program = () => $<HTMLSelectElement>("program").value;

// [wanted] is opened, or else the one that was open.
async function loadFiles(wanted: string | null) {
  const files = await get("files");
  const option = (path: string) => h("option", { value: path }, path);
  const before = wanted ?? (program() || decodeURIComponent(location.hash.slice(1)));
  $("program").replaceChildren(...files.programs.map(option));
  $("fleet").replaceChildren(h("option", { value: "" }, "the one beside it"), ...files.fleets.map(option));
  layers.offer(files.layers);
  if (files.programs.includes(before)) $<HTMLSelectElement>("program").value = before;
  if (program()) await openProgram();
  else tell("There is no program in this folder.");
}

async function openProgram() {
  const path = program();
  location.hash = path;
  setDirty(false);
  const file = await get("file?path=" + encodeURIComponent(path));
  if (program() !== path) return; // another one was chosen meanwhile
  hash = file.hash;
  verdicts.about(path, hash);
  editor.open(path, file.text);
  setDirty(false);
  shapes.changed();
  await loadWorld();
}

let parameters: { name: string; as: string; description?: string }[] = [];
const settings = new Map<string, string>();

// Another file in the editor; whether it is there.
async function openOther(path: string | null): Promise<boolean> {
  if (path === null) return false;
  if (path === editor.path) return true;
  const select = $<HTMLSelectElement>("program");
  if (![...select.options].some((o) => o.value === path)) return false;
  if (dirty && !(await leaves())) return false;
  select.value = path;
  showTab("source");
  await openProgram();
  return true;
}

const leaves = () => choose("The text is not saved. Leave it?", "Leave it", "Stay", "danger");

let plansAsked = 0;
async function loadWorld() {
  const fleet = $<HTMLSelectElement>("fleet").value;
  try {
    const world = await get(`world?program=${encodeURIComponent(program())}` + (fleet ? `&fleet=${encodeURIComponent(fleet)}` : ""));
    // Real vehicles are those that are heard, wherever the fleet file has them.
    const simulated = status?.simulated !== false;
    map.setPlaces(simulated ? world.plans.filter((p: Json) => p.latitude !== undefined) : []);
    parameters = world.parameters ?? [];
    suggested = world.suggested ?? {};
    settings.clear();
    // Before anything runs, the fleet stands where it will.
    if (!past && live.transitions === 0) {
      live = shown = new Run();
      map.reset();
      live.fences = world.fences ?? [];
      showHeard();
      for (const v of simulated ? world.vehicles : []) live.add({ kind: "journal", line: { kind: "vehicle", time: 0, connected: true, ...v } });
    }
  } catch { parameters = []; suggested = {}; map.setPlaces([]); }
  renderNow();
  changed();
  if (!$("plans").hidden) await loadPlans();
  else { plansAsked++; plans.forget(); }  // what is under way is of another program
}

async function loadPlans() {
  const number = ++plansAsked, fleet = $<HTMLSelectElement>("fleet").value;
  try {
    const found = await post("plans", { program: program(), fleet: fleet || null, set: Object.fromEntries(settings) });
    if (number === plansAsked) plans.show(found, dirty ? "These are the plans of the program as it was saved." : "");
  } catch (e) {
    if (number === plansAsked) plans.say((e as Error).message);
  }
}

function setDirty(value: boolean) {
  dirty = value;
  $<HTMLButtonElement>("save").disabled = !value;
  $("editor-title").textContent = "Program" + (value ? " (not saved)" : "");
}

async function save() {
  if (!dirty) return;
  try {
    hash = (await ask("PUT", "file", { path: editor.path, text: editor.text, hash })).hash;
  } catch (e) {
    if (!(e instanceof Refusal && e.code === "changed")) { tell((e as Error).message); return; }
    if (!(await choose("The file has changed on the disk since it was read. Write over it?", "Write over it", "Cancel", "danger"))) return;
    hash = (await get("file?path=" + encodeURIComponent(editor.path))).hash;
    hash = (await ask("PUT", "file", { path: editor.path, text: editor.text, hash })).hash;
  }
  setDirty(false);
  verdicts.about(program(), hash);
  await loadWorld();
}

function showFaults(found: Diagnostic[]) {
  const errors = found.filter((d) => d.severity === "error").length, warnings = found.length - errors;
  const count = (n: number, what: string) => (n ? `${n} ${what}${n > 1 ? "s" : ""}` : "");
  const text = [count(errors, "error"), count(warnings, "warning")].filter(Boolean).join(", ") || "no errors";
  $("faults").replaceChildren(h("span", { class: errors ? "trouble" : "" }, text),
    found.length ? h("span", { class: "first" }, ` ${found[0].file ? found[0].file + " " : ""}line ${found[0].line}: ${found[0].message}`) : "");
}

// {1 Runs and explorations}

// The text as it is on the screen: saved, once its author has agreed.
async function saved(what: string): Promise<boolean> {
  if (dirty && !(await choose(`The text of ${editor.path} is not saved. Save it and ${what}?`, `Save and ${what}`))) return false;
  await save();
  return !dirty;
}

const percent = (battery: unknown) => (typeof battery === "number" ? `, battery ${Math.round(battery * 100)} %` : "");

const real = h("div");  // the vehicles that are heard, in the question before a run

function renderReal() {
  const there = (heard?.vehicles ?? []).filter((v) => v.connected);
  const name = (v: Json) => h("li", {}, h("b", {}, v.vehicle), ` ${v.type}${percent(v.battery)}${v.unready ? ", " + v.unready : ""}`);
  real.replaceChildren(there.length ? h("ul", { id: "real-vehicles" }, ...there.map(name)) : h("p", { class: "trouble" }, "No vehicle is heard now."),
    heard?.error ? h("p", { class: "trouble" }, heard.error) : "");
}

function commandsReal() {
  renderReal();
  return choose(h("div", {},
    h("p", {}, `${program()} commands REAL vehicles: each that its picks choose among those that are heard.`), real),
    "Command real vehicles", "Cancel", "danger");
}

// Before a run on a network the page shows the vehicles that are heard.
const isBefore = () => status?.simulated === false && !goesOn() && live.transitions === 0;

function showHeard() {
  if (!heard || !isBefore()) return;
  for (const line of heard.vehicles) {
    const v = live.vehicles.get(line.vehicle), last = v?.samples[v.samples.length - 1];
    if (!v || v.connected !== line.connected || !last || last.time < line.time) live.add({ kind: "journal", line: { ...line, kind: "vehicle" } });
  }
  live.time = Math.max(live.time, heard.time);
  live.alarms = [];
  if (!past) changed();
}

async function startRun() {
  if (!(await saved("run"))) return;
  if (status?.simulated === false && !(await commandsReal())) return;
  const speed = $<HTMLSelectElement>("speed").value, fleet = $<HTMLSelectElement>("fleet").value;
  leavePast();
  plans.undraw();
  await post("run", { program: program(), fleet: fleet || null, people: $<HTMLInputElement>("people").checked,
    speed: status?.simulated && speed ? Number(speed) : null, set: Object.fromEntries(settings) });
}

// The run that goes on gets the program in the editor.
async function replaceProgram() {
  const run = status?.run;
  if (!run || !goesOn() || !(await saved("replace"))) return;
  const there = [...live.vehicles.values()].filter((v) => live.bound.has(v.id)).map((v) => h("b", {}, `${v.id} `));
  const real = run.simulated ? null : h("p", { class: "trouble" }, "The run commands REAL vehicles: ", ...(there.length ? there : ["none yet"]));
  replacing.open({ program: program(), running: run.program ?? "the program", faults: $<HTMLInputElement>("faults-allowed").value.trim(), real });
}

async function enact(of: "exploration" | "timing") {
  const speed = $<HTMLSelectElement>("speed").value;
  leavePast();
  await post("run/counterexample", { of, speed: speed ? Number(speed) : null });
}

// Analyses of the program.
const subjects = ["exploration", "timing", "graph"] as const;

async function analyse(subject: (typeof subjects)[number]) {
  if (!(await saved("analyse"))) return;
  showTab("verdicts");
  const fleet = $<HTMLSelectElement>("fleet").value, faults = $<HTMLInputElement>("faults-allowed").value.trim();
  const deadline = $<HTMLInputElement>("deadline").value.trim();
  await post(subject, { program: program(), fleet: fleet || null, set: Object.fromEntries(settings), faults: faults || null,
    ...(subject === "timing" ? { deadline: deadline || null } : {}) });
}

// A run that was found, step by step, from where the fleet stands.
function showFound(cx: Json, program: string | null) {
  const what = cx.property ? `Counterexample: ${cx.property}` : "A run that ends last";
  const reel = new Reel(what, undefined, program);
  for (const v of live.vehicles.values()) {
    const s = v.samples[0];
    if (s) reel.add({ kind: "journal", line: { kind: "vehicle", vehicle: v.id, type: v.kind, payload: v.payload,
      time: 0, latitude: s.latitude, longitude: s.longitude, battery: s.battery, connected: true } });
  }
  for (const step of cx.steps) {
    reel.add({ kind: "journal", line: step });
    reel.add({ kind: "log", line: { time: step.time, severity: "ordinary", about: Object.keys(step.A ?? {}),
      text: `${(cx.dated ? clock(step.time) : String(step.i + 1)).padStart(7)}  ${step.words || step.label}` } });
  }
  openPast({ tape: new Tape(reel), index: reel.messages.length, steps: !cx.dated, found: true });
  showTab("source");
}

const dated = (name: string) => `${name.slice(0, 10)} ${name.slice(11, 13)}:${name.slice(13, 15)} UTC`;

type Journal = { run?: string; path?: string };
const queryOf = (of: Journal) => new URLSearchParams(of as Record<string, string>).toString();

// Reads a journal, piece by piece, until [reading] is aborted.
async function fill(reel: Reel, reading: AbortController, piece: () => void) {
  try {
    await replay(queryOf(reel.of!), {
      program: (path) => { reel.program = path; },
      journal: (line) => reel.add({ kind: "journal", line }),
      log: (line) => reel.add({ kind: "log", line }),
      waiting: (waiting) => reel.add({ kind: "waiting", waiting }),
      places: ({ places }) => reel.add({ kind: "places", places }),
      way: ({ way }) => reel.add({ kind: "way", way }),
      piece,
    }, reading.signal);
  } catch (e) {
    if (!reading.signal.aborted) throw e;
  }
}

async function openReplay(of: Journal, title: string) {
  const reel = new Reel(title, of), reading = new AbortController();
  const p: Past = { tape: new Tape(reel), index: 0, steps: false, found: false, reading };
  const piece = () => { if (past === p) grow(p); else { leavePast(); p.index = reel.messages.length; openPast(p); } };
  try { await fill(reel, reading, piece); }
  finally {
    p.reading = undefined;
    if (past === p) { renderBanner(); attempt(() => showNotes(p, reel, get("notes?" + queryOf(of))))(); }
  }
}

// A second run, on the same clock as the one that is shown.
async function openBeside(of: Journal, title: string) {
  const p = past;
  if (!p?.tape.first.of) return;
  if (p.reading) throw new Error("The first run is still being read.");
  const reel = new Reel(title, of), reading = new AbortController(), time = shown.time, atEnd = p.index === p.tape.length;
  p.reading = reading;
  renderBanner();
  try { await fill(reel, reading, () => {}); }
  finally {
    p.reading = undefined;
    if (past === p) renderBanner();
  }
  if (past !== p || reading.signal.aborted) return;
  p.tape.second = reel;
  openPast(p, atEnd ? p.tape.length : p.tape.placeOf(time));
  attempt(() => showNotes(p, reel, get("notes?" + queryOf(of))))();
}

function leaveBeside() {
  if (!past?.tape.second) return;
  past.tape.second = null;
  openPast(past, past.tape.placeOf(shown.time));
}

const titleOf = (run: string, what: string) => `${what} of ${dated(run)}`;
const replayRun = (run: string, what: string) => openReplay({ run }, titleOf(run, what));

async function showNotes(p: Past, reel: Reel, reply: Promise<{ notes: Note[] }>) {
  reel.notes = (await reply).notes;
  if (past === p) seek(p.index);
}

async function writeNote() {
  const p = past, text = $<HTMLInputElement>("note").value.trim(), reel = p?.tape.first;
  if (!p || !reel?.of || !text) return;
  await showNotes(p, reel, post("notes", { ...reel.of, time: shown.time, text }));
  $<HTMLInputElement>("note").value = "";
}

// Beside the run that is shown, if it has a journal.
const besideButton = (of: Journal, title: string) => h("button", { class: "beside", "aria-label": `${title} beside it`,
  title: "Both runs, below one another, on one clock", click: attempt(() => openBeside(of, title)) }, "Beside");

async function renderRuns() {
  const [{ runs }, { journals }] = await Promise.all([get("runs"), get("files")]);
  const row = (r: Json) => h("tr", {}, h("td", {}, r.program), h("td", {}, r.started.replace("T", " ").slice(0, 16)),
    h("td", { class: "number" }, clock(r.time)), h("td", { class: r.state === "completed" ? "" : "trouble" }, r.state),
    h("td", {}, h("button", { click: attempt(() => replayRun(r.run, r.program)) }, "Replay"), besideButton({ run: r.run }, titleOf(r.run, r.program)),
      r.state === "broken off" && !goesOn() ? h("button", { class: "main", click: attempt(() => resume(r)) }, "Resume") : null));
  $("runs").replaceChildren(runs.length
    ? h("table", {}, h("thead", {}, h("tr", {}, ...["program", "started (UTC)", "time", "end", ""].map((t) => h("th", { scope: "col" }, t)))),
        h("tbody", {}, ...runs.map(row)))
    : h("p", { class: "empty" }, "No run of a program of this folder was kept yet."),
    journals.length ? h("table", { id: "journals" }, h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "journals in this folder"), h("th", {}))),
      h("tbody", {}, ...journals.map((path: string) => h("tr", {}, h("td", {}, path),
        h("td", {}, h("button", { "aria-label": "Replay " + path, click: attempt(() => openReplay({ path }, path)) }, "Replay"), besideButton({ path }, path)))))) : "");
  return runs;
}

async function resume(r: Json) {
  leavePast();
  await post("run/resume", { run: r.run, people: $<HTMLInputElement>("people").checked });
  await renderRuns();
}

const goesOn = () => status?.run?.state === "running" || status?.run?.state === "stopping";

// After a server died in a run, pages offer to resume it.
async function offerToResume() {
  if (goesOn()) return;
  const broken = (await renderRuns()).find((r: Json) => r.state === "broken off");
  if (broken) { showTab("runs"); tell(`The console died in a run of ${broken.program}: it can be resumed.`); }
}

// {1 Replays}

function openPast(p: Past, index = p.index) {
  if (past !== p) past?.reading?.abort();
  past = p;
  unpick();
  map.reset();
  $<HTMLInputElement>("slider").max = String(p.tape.length);
  seek(index);
  $("slider-row").hidden = false;
  $("note-form").hidden = !p.tape.first.of || (watches && !answers);
  document.body.classList.toggle("replays", p.tape.first.of !== undefined);
  renderBanner();
}

// More of it has come: a slider at its end stays there.
function grow(p: Past) {
  const slider = $<HTMLInputElement>("slider"), follows = p.index === Number(slider.max);
  slider.max = String(p.tape.length);
  if (!follows) return;
  for (; p.index < p.tape.length; p.index++) shown.add(p.tape.message(p.index));
  slider.value = slider.max;
  $("step").textContent = clock(shown.time);
  changed();
}

function leavePast() {
  if (!past) return;
  past.reading?.abort();
  past = null;
  second = null;
  document.body.classList.remove("replays");
  unpick();
  shown = live;
  map.reset();
  $("slider-row").hidden = true;
  renderBanner();
  renderLog(true);
  changed();
}

function seek(index: number) {
  if (!past) return;
  const { tape, found, steps } = past;
  past.index = Math.max(0, Math.min(index, tape.length));
  const [a, b] = tape.counts(past.index);
  shown = tape.first.run(a, !found);
  second = tape.second?.run(b, true) ?? null;
  $<HTMLInputElement>("slider").value = String(past.index);
  $("step").textContent = steps ? `step ${shown.transitions}: ${shown.label}` : clock(Math.max(shown.time, second?.time ?? 0));
  showLine(shown.at, tape.first.program);
  renderLog(true);
  changed();
}

// To the next transition, or the one before.
function step(by: number) {
  if (!past) return;
  const { tape } = past, isStep = (i: number) => { const m = tape.message(i); return m.kind === "journal" && m.line.kind === "transition"; };
  let i = past.index;
  if (by > 0) {
    while (i < tape.length && !isStep(i)) i++;
    i++;
    while (i < tape.length && tape.message(i).kind !== "journal") i++;
  } else {
    i--;
    while (i > 0 && !isStep(i)) i--;
  }
  seek(i);
}

// {1 The view}

function list(name: string, items: (Node | string)[], empty: string) {
  return h("div", { class: "fact" }, h("h3", {}, name), items.length ? h("ul", {}, ...items.map((i) => h("li", {}, i))) : h("p", { class: "empty" }, empty));
}

// The program of the run on the screen.
const shownProgram = () => (past ? past.tape.first.program : status?.run?.program ?? null);

// The line of [at] if its file is in the editor; else none.
function showLine(at: string | null, of: string | null) {
  const place = at === null ? null : readPlace(at);
  const path = place && (place.file === null ? of : of === null ? null : beside(of, place.file));
  editor.show(place && (path === editor.path || (of === null && place.file === null)) ? place.line : null, true);
}

// The same, and the file is opened if it is another one.
function goTo(at: string | undefined, of: string | null) {
  const place = at === undefined ? null : readPlace(at);
  if (!place) return;
  attempt(async () => {
    const path = place.file === null ? of : of === null ? null : beside(of, place.file);
    if (await openOther(path)) { showTab("source"); editor.show(place.line, true); }
    else if (of === null && place.file === null) editor.show(place.line, true);
    else tell(`${place.file ?? of}, line ${place.line}: this file is not shown here.`);
  })();
}

// {2 The selection on the timeline}

let picked: Picked | null = null;

const programOf = (p: Picked) => (p.second ? past?.tape.second?.program ?? null : shownProgram());

function pick(p: Picked) {
  picked = p;
  const button = p.at === undefined ? "" : h("button", { class: "link", click: () => goTo(p.at, programOf(p)) }, inWords(p.at));
  $("picked").replaceChildren(h("span", { class: "what" }, p.text), button, h("button", { "aria-label": "leave it", click: unpick }, "✕"));
  $("picked").hidden = false;
  if (p.at !== undefined) goTo(p.at, programOf(p));
  map.past(p.second && second ? second : shown, past?.found ? null : p.time, p.vehicle);
  changed();
}

function unpick() {
  if (!picked) return;
  picked = null;
  $("picked").hidden = true;
  map.past(shown, null, null);
  changed();
}

function pickNext(by: number) {
  const all = happenings(shown, past?.steps ?? false), i = all.findIndex((p) => p.key === picked?.key);
  const next = all[i < 0 ? (by > 0 ? 0 : all.length - 1) : Math.max(0, Math.min(i + by, all.length - 1))];
  if (next) pick(next);
}

const placeOf = (d: Diagnostic) => `${d.file ? d.file + ":" : ""}${d.line}:${d.column}`;

let nowKey = "";
function renderNow() {
  const run = status?.run, going = !past && run !== null && run !== undefined && run.state !== "over";
  const key = JSON.stringify([shown.waiting, shown.tuples, [...shown.allocation], [...shown.bound], run?.inputs, going, run?.question?.number, run?.questions,
    run?.outcome?.text, parameters, suggested, past !== null, shown.ending, run?.id, operator]);
  if (key === nowKey) return;
  nowKey = key;
  const parts: Node[] = [];
  if (!past && run?.state === "over" && run.outcome)
    parts.push(h("p", { class: "outcome " + run.outcome.how }, `${run.program ?? "the run"}${run.counterexample !== null ? ", as the counterexample says" : ""}: ${run.outcome.text}`,
      run.journal !== null ? h("button", { click: attempt(() => replayRun(run.journal!, run.program ?? "run")) }, "Replay") : null));
  if (!past && run?.outcome?.diagnostics.length)
    parts.push(...run.outcome.diagnostics.map((d) => h("button", { class: "link trouble", click: () => goTo(placeOf(d), run.program) }, `${inWords(placeOf(d))}: ${d.message}`)));
  if (going) parts.push(...run.questions.map(openQuestion));
  if (going && run.inputs.length) parts.push(inputs(run.inputs.filter((key) => !run.vehicle_inputs.includes(key)), run.vehicle_inputs));
  if (!going && !past && parameters.length) parts.push(fields());
  parts.push(list("Waits for", shown.waiting.map((w) => h("button", { class: "link", click: () => goTo(w.at, shownProgram()) }, w.what,
    w.lacking ? h("small", {}, ` ${w.lacking}`) : null, w.at ? h("small", {}, " " + inWords(w.at)) : null)), going ? "nothing but its vehicles" : "nothing"));
  parts.push(list("Tuple space N", shown.tuples, "empty"));
  parts.push(list("Allocated A", [...shown.allocation].map(([v, p]) => `${v}: ${p}`), "none"));
  parts.push(list("Bound B", shown.bound.size ? [[...shown.bound].join(", ")] : [], "none"));
  // Text under way stays in its field.
  const focused = document.activeElement?.id, typed = [...$("now").querySelectorAll("input")]
    .map(({ id, value, selectionStart, selectionEnd }) => ({ id, value, from: selectionStart, to: selectionEnd }));
  $("now").replaceChildren(...parts);
  for (const { id, value, from, to } of typed) {
    const field = document.getElementById(id) as HTMLInputElement | null;
    if (!field || (id.startsWith("parameter-") && !settings.has(field.name))) continue;
    field.value = value;
    if (focused === id) { field.focus(); field.setSelectionRange(from, to); }
  }
}

// All questions that are open: those of tasks are answered here, that of the script in its dialog.
function openQuestion(q: OpenQuestion) {
  const give = (name: string, value: boolean) => h("button", { class: "main", "aria-label": `${name}: ${q.prompt}`,
    click: attempt(() => post("run/post", { key: q.prompt, value })) }, name);
  const left = h("small", { class: "left" });
  if (q.until !== null) left.dataset.until = String(q.until);
  return h("p", { class: "outcome asks" }, h("button", { class: "link", click: () => goTo(q.at ?? undefined, shownProgram()) }, q.prompt), left,
    ...(!mayAnswer(operator, q.to) ? [h("small", {}, ` for ${q.to}`)] : q.of === "task" ? [give("Yes", true), give("No", false)] : [h("button", { class: "main", click: () => dialog.open() }, "Answer")]));
}

// The time that is left passes although nothing happens.
function renderTimeLeft() {
  for (const el of document.querySelectorAll<HTMLElement>("#now .left[data-until]")) {
    const text = ` ${clock(Math.max(0, Number(el.dataset.until) - live.time))} left `;
    if (el.textContent !== text) el.textContent = text;
  }
}

// Values of the fleet file have buttons; others are typed.
let suggested: Record<string, string[]> = {};

function inputs(keys: string[], ofVehicles: string[]) {
  const send = (key: string) => attempt(async () => {
    const field = $<HTMLInputElement>("input-" + key);
    await post("run/post", { pairs: field.value.trim() ? `${key}: ${field.value}` : key });
    field.value = "";
  });
  return h("div", { class: "fact" }, h("h3", {}, "Inputs"), ...keys.map((key) => h("form", { class: "input",
    submit: (e: Event) => { e.preventDefault(); send(key)(); } },
    h("label", { for: "input-" + key }, key),
    ...(suggested[key] ?? []).map((value) => h("button", { type: "button", "aria-label": `post ${key}: ${value}`,
      click: attempt(() => post("run/post", { pairs: `${key}: ${value}` })) }, value)),
    h("input", { id: "input-" + key, placeholder: "true", autocomplete: "off" }), h("button", { "aria-label": `post ${key}` }, "Post"))),
    ofVehicles.length ? h("p", {}, `In the panel of a vehicle: ${ofVehicles.join(", ")}`) : null);
}

function fields() {
  return h("div", { class: "fact" }, h("h3", {}, "Parameters"), ...parameters.map((p) => {
    const value = p.as.replace(/^[^=]*= /, "");
    return h("div", { class: "input" }, h("label", { for: "parameter-" + p.name, title: p.description ?? "" }, p.name),
      h("input", { id: "parameter-" + p.name, name: p.name, placeholder: value, autocomplete: "off",
        input: (e: Event) => { const t = (e.target as HTMLInputElement).value.trim(); if (t) settings.set(p.name, t); else settings.delete(p.name); } }));
  }));
}

// {2 The log}

const ranks: Record<string, number> = { ordinary: 0, completed: 1, said: 1, trouble: 2 };
const levels: Record<string, number> = { all: 0, said: 1, trouble: 2 };
const mostLines = 1000;
let logged = { run: live, count: 0 };

function isWanted(line: LogLine) {
  const about = $<HTMLSelectElement>("about").value;
  return ranks[line.severity] >= levels[$<HTMLSelectElement>("level").value] && (!about || line.about.includes(about));
}

function renderLog(anew = false) {
  const el = $("log");
  if (anew || logged.run !== shown) { el.replaceChildren(); logged = { run: shown, count: 0 }; }
  const atEnd = el.scrollTop + el.clientHeight >= el.scrollHeight - 30;
  const added = shown.log.slice(Math.max(logged.count, shown.log.length - mostLines)).filter(isWanted);
  logged.count = shown.log.length;
  if (!added.length) return;
  el.append(...added.map((l) => h("pre", { class: l.severity }, l.text)));
  while (el.childElementCount > mostLines) el.firstElementChild!.remove();
  if (atEnd || anew) el.scrollTop = el.scrollHeight;
}

function renderAbout() {
  const select = $<HTMLSelectElement>("about"), ids = [...shown.vehicles.keys()];
  if (select.options.length === ids.length + 1) return;
  const before = select.value;
  select.replaceChildren(h("option", { value: "" }, "everybody"), ...ids.map((id) => h("option", { value: id }, id)));
  select.value = ids.includes(before) ? before : "";
}

// {2 The head}

function renderBanner() {
  const banner = $("banner");
  banner.className = past ? "past" : "";
  banner.hidden = !past;
  if (!past) return;
  const { tape, reading } = past;
  banner.replaceChildren(tape.first.title + (tape.second ? `, beside ${tape.second.title}` : "") + (reading ? " (is being read) " : " "),
    tape.second ? h("button", { click: leaveBeside }, "Leave the second run") : "", " ", h("button", { click: leavePast }, "Back to now"));
}

// What may still happen, while a run goes on.
const wall = new Wall();
const ahead = () => (goesOn() && linked && !past ? status!.run!.outlook : null);

function renderHead() {
  const run = status?.run, going = run?.state === "running" || run?.state === "stopping";
  $<HTMLButtonElement>("run").disabled = watches || going || !linked || !program();
  $("replace").hidden = watches || !going || run?.counterexample !== null;
  $<HTMLButtonElement>("replace").disabled = !linked || !program();
  stop.show(run ?? null, watches);
  $<HTMLButtonElement>("explore").disabled = watches || !linked || status?.exploration?.state === "running" || !program();
  $<HTMLButtonElement>("time").disabled = watches || !linked || status?.timing?.state === "running" || !program();
  $<HTMLSelectElement>("speed").disabled = status !== null && !status.simulated;
  document.body.classList.toggle("going", going);
  document.body.classList.toggle("dead", status !== null && !linked);
  const world = status === null ? "" : (going ? run.simulated : status.simulated) ? "SIMULATED" : "REAL";
  if ($("world").textContent !== world) $("world").textContent = world;
  $("world").className = world.toLowerCase();
  setTitle(world ? `${world} – ${going ? run.program ?? "a program" : "Dolphin console"}` : "Dolphin console");
  $("link").textContent = !linked ? "no server: this is what was known last" : going ? `${run.counterexample !== null ? "counterexample of " : ""}${run.program ?? "a program"} ${clock(live.time)}` : "";
  $("link").className = linked ? "" : "trouble";
  outlook($("outlook"), ahead(), live.time, run ? wall.at(run) : null);
  helm.show(linked ? status?.helm ?? null : null, me, answers ? "answers" : watches ? "watches" : "steers");
}

function renderTimeline() {
  const tape = past?.tape, found = compare($("compared"), tape ?? null, (time) => { if (past) seek(past.tape.placeOf(time)); });
  const first: View = { run: shown, steps: past?.steps ?? false, windows: windows(ahead()) };
  const views = !tape?.second || !second || !found ? [first]
    : [{ ...first, title: tape.first.title, only: found.only[0] }, { run: second, steps: false, windows: new Map(), title: tape.second.title, only: found.only[1], second: true }];
  timeline($("timeline"), views, picked?.key ?? null, pick);
}

function commands() {
  const run = past ? null : status?.run ?? null, takes = run !== null && run.state === "running" && (!watches || answers);
  return { keys: takes ? run.vehicle_inputs : [], twice: run !== null && !run.simulated };
}

// Changes within a tenth of a second are drawn together.
let due = false;
function changed() {
  if (due) return;
  due = true;
  setTimeout(() => requestAnimationFrame(() => {
    due = false;
    showShapes();
    map.render(shown, second);
    const { quantity, vehicles } = readings.show(shown, second);
    map.tracks.colour(quantity, vehicles);
    table.show(shown, past?.steps ?? false);
    panel.show(shown, past ? [] : status?.run?.progress ?? [], commands());
    renderNow();
    renderTimeLeft();
    renderAbout();
    renderLog();
    renderHead();
    alarms.show(status?.run?.id ?? "", live);
    renderTimeline();
  }), 100);
}

const tabs = ["source", "verdicts", "plans", "runs"];

function showTab(name: string) {
  for (const other of tabs) {
    $(other).hidden = other !== name;
    $("tab-" + other).setAttribute("aria-selected", String(other === name));
  }
  if (name === "runs") attempt(renderRuns)();
  if (name === "plans") attempt(loadPlans)();
}

// {1 Beginning}

// The link's fingerprint is for people and programs, before the page is open.
if (location.hash.startsWith("#sha256=")) history.replaceState(null, "", location.pathname);

let first = true;
listen({
  status(s) {
    const ended = status?.run?.id === s.run?.id && status?.run?.state !== "over" && s.run?.state === "over";
    const other = status !== null && status.instance !== s.instance;
    const over = subjects.filter((subject) => s[subject] && s[subject].state !== "running"
      && (other || status?.[subject]?.state !== s[subject].state || status?.[subject]?.number !== s[subject].number));
    status = s;
    linked = true;
    layers.tiles(s.tiles);
    renderHead();
    const asked = s.run?.question ?? null;
    if (!watches || answers) dialog.show(s.run?.id ?? "", asked && mayAnswer(operator, asked.to) ? asked : null, asked !== null && isAsked(operator, asked.to));
    const open = (s.run?.questions ?? []).filter((q) => isAsked(operator, q.to));
    markTitle("question", open.length > 1 ? `● ${open.length} questions` : open.length ? "● " + open[0].prompt : "");
    renderNow();
    verdicts.status(s);
    replacing.status(s);
    for (const subject of over) attempt(async () => verdicts.result(subject, await get(subject)))();
    if (first || other) {
      first = false;
      attempt(async () => {
        await loadFiles(goesOn() ? s.run!.program : location.hash ? null : s.run?.program ?? null);
        await offerToResume();
      })();
    }
    if (ended && !$("runs").hidden) attempt(renderRuns)();
  },
  reset() {
    live = new Run();
    if (!past) { shown = live; unpick(); map.reset(); renderLog(true); }
    changed();
  },
  journal(line) { live.add({ kind: "journal", line }); if (!past) changed(); },
  log(line) { live.add({ kind: "log", line }); if (!past) changed(); },
  waiting(waiting) { live.add({ kind: "waiting", waiting }); if (!past) changed(); },
  places({ places }) { live.add({ kind: "places", places }); if (!past) changed(); },
  way({ way }) { live.add({ kind: "way", way }); if (!past) changed(); },
  clock(time) { wall.heard(status?.run ?? null, time); live.time = Math.max(live.time, time); if (!past) changed(); },
  heard(h) { heard = h; showHeard(); renderReal(); },
  role(is, name, as_) {
    operator = as_;
    operators.show(as_);
    watches = is !== "steers";
    answers = is === "answers";
    me = name;
    document.body.classList.toggle("watches", is === "watches");
    renderHead();
  },
  beat() {
    latest = Date.now();
    helm.alive();
    if (!linked) { linked = true; renderHead(); }
  },
  link(up, why) { latest = Date.now(); linked = up; if (why) tell(why); renderHead(); },
});

// The server sends a beat each second: without it, the page is out of date.
let latest = Date.now();
const mostSilent = 2500;
setInterval(() => {
  if (!linked || Date.now() - latest <= mostSilent) return;
  linked = false;
  renderHead();
}, 250);

$("program").addEventListener("change", attempt(async () => {
  const wanted = program();
  if (dirty) {
    $<HTMLSelectElement>("program").value = editor.path;
    if (!(await leaves())) return;
    $<HTMLSelectElement>("program").value = wanted;
  }
  if (status?.run?.state === "over" || !status?.run) { live = new Run(); if (!past) shown = live; }
  await openProgram();
}));
// The browser's way back and forth.
window.addEventListener("hashchange", attempt(async () => {
  const path = decodeURIComponent(location.hash.slice(1));
  if (path && path !== program() && !(await openOther(path))) location.hash = program();
}));
$("fleet").addEventListener("change", attempt(loadWorld));
$("run").addEventListener("click", attempt(startRun));
$("replace").addEventListener("click", attempt(replaceProgram));
$("explore").addEventListener("click", attempt(() => analyse("exploration")));
$("time").addEventListener("click", attempt(() => analyse("timing")));
$("save").addEventListener("click", attempt(save));
$("format").addEventListener("click", attempt(async () =>
  editor.replace((await post("format", { path: editor.path, text: editor.text })).text)));
$("level").addEventListener("change", () => renderLog(true));
$("about").addEventListener("change", () => renderLog(true));
$("copy").addEventListener("click", attempt(async () => {
  await navigator.clipboard.writeText(shown.log.filter(isWanted).map((l) => l.text).join("\n"));
  tell("The log was copied.", false);
}));
$("slider").addEventListener("input", (e) => seek(Number((e.target as HTMLInputElement).value)));
$("note-form").addEventListener("submit", (e) => { e.preventDefault(); attempt(writeNote)(); });
$("back").addEventListener("click", () => step(-1));
$("forward").addEventListener("click", () => step(1));
for (const name of tabs) $("tab-" + name).addEventListener("click", () => showTab(name));
document.querySelector(".tabs")!.addEventListener("keydown", (e) => {
  const key = (e as KeyboardEvent).key, buttons = [...document.querySelectorAll<HTMLElement>(".tabs button")];
  const i = buttons.indexOf(document.activeElement as HTMLElement);
  if (key !== "ArrowRight" && key !== "ArrowLeft") return;
  buttons[(i + (key === "ArrowRight" ? 1 : buttons.length - 1)) % buttons.length].focus();
});
$("timeline").addEventListener("keydown", (e) => {
  if (e.key === "ArrowRight" || e.key === "ArrowLeft") { e.preventDefault(); pickNext(e.key === "ArrowRight" ? 1 : -1); }
  else if (e.key === "Escape") unpick();
});
window.addEventListener("resize", changed);
window.addEventListener("beforeunload", (e) => { if (dirty) e.preventDefault(); });
