/**
 * The page of a person: it shows the instruction that the mission gives, and sends the person's acts to the adapter.
 *
 * The token is the fragment of the link. sessionStorage keeps it, answers that are being typed, and acts that are not
 * sent yet: a reload loses none of them. An act is repeated until the adapter replies; acts are idempotent.
 * Texts of missions are untrusted, so they become textContent only.
 */
const pollPatience = 15_000, patience = 10_000, again = 1_000, between = 5_000;  // milliseconds
const settle = 500;  // a button that has just appeared under a finger takes no press for this long

const acts = { offered: ["accept", "decline"], accepted: ["done", "cannot"], stopping: ["stopped"] };
const names = { accept: "Accept", decline: "Decline", done: "Done", cannot: "Cannot", stopped: "I have stopped" };
const states = { offered: "New", accepted: "Yours", stopping: "Stop: this is no longer wanted" };

const $ = (id) => document.getElementById(id);
const put = (el, text) => { if (el.textContent !== text) el.textContent = text; };
const show = (el, shown) => { if (el.hidden === Boolean(shown)) el.hidden = !shown; };
const warn = (el, text) => { put(el, text); show(el, text); };
/** Throws a refusal: of the adapter with its `status`, or of the page with the `field` to mend. */
const refuse = (text, more) => { throw Object.assign(new Error(text), more); };
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

function h(tag, attributes = {}, ...children) {
  const el = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) el.setAttribute(name, value);
  el.append(...children);
  return el;
}

const read = (key) => { try { return JSON.parse(sessionStorage.getItem(key)); } catch { return null; } };
const write = (key, value) => { try { sessionStorage.setItem(key, JSON.stringify(value)); } catch { /* full */ } };

// The person, by the link.
const token = location.hash.slice(1) || read("token") || "";
write("token", token);
addEventListener("hashchange", () => { if (!["", token].includes(location.hash.slice(1))) location.reload(); });

let now = null;  // the last reply of /state
let due = null;  // when the time of the instruction is over
let delivered = "";  // a request whose act has arrived; its next state is awaited
let { outbox = [], draft = {} } = read(`person ${token}`) ?? {};
const save = () => write(`person ${token}`, { outbox, draft });

// Requests.
let since = null;
function linked(good) {
  since = good ? null : since ?? new Date().toTimeString().slice(0, 8);
  put($("link"), good ? "connected" : `no connection since ${since}; answers are kept and sent later`);
  $("link").className = good ? "good" : "bad";
}

async function call(path, { body, type, control = new AbortController(), limit = patience } = {}) {
  const timer = setTimeout(() => control.abort(), limit);
  try {
    const headers = { Authorization: `Bearer ${token}` };
    if (body !== undefined) headers["Content-Type"] = type || "application/json";
    const method = body === undefined ? "GET" : "POST", sent = body instanceof Blob ? body : JSON.stringify(body);
    const reply = await fetch(path, { method, headers, body: sent, cache: "no-store", signal: control.signal });
    if (reply.ok) return await reply.json();
    if (reply.status >= 500 || reply.status === 408 || reply.status === 429) throw new Error(`status ${reply.status}`);
    const reason = await reply.json().then((found) => String(found.error), () => `status ${reply.status}`);
    refuse(reason, { status: reply.status });
  } finally {
    clearTimeout(timer);
  }
}

/** Whether the adapter refuses, once and for all; otherwise the request is sent again. */
function refused(error) {
  linked(Boolean(error.status));
  if (error.status === 401) warn($("denied"), "The link is refused: it is not valid any more. Ask for a new one.");
  return Boolean(error.status) && error.status !== 401;
}

// The state, by long polls.
let poll = null, stale = false;
/** Asks for the state at once: the reply under way may be older than an act that has arrived. */
const refresh = () => { stale = true; poll?.abort(); };

async function follow() {
  for (;;) {
    const began = Date.now(), version = stale ? undefined : now?.version;
    stale = false;
    poll = new AbortController();
    const path = version === undefined ? "state" : `state?after=${encodeURIComponent(version)}`;
    const next = await call(path, { control: poll, limit: pollPatience })
      .catch((error) => { if (!stale) refused(error); });
    if (stale) continue;
    if (next) receive(next);
    if (!next || (next.version === version && Date.now() - began < again)) await sleep(again);
  }
}

function receive(next) {
  if (since && here) void share(here);  // an adapter that was started again does not know it
  linked(true);
  warn($("denied"), "");
  now = next;
  delivered = "";
  const { instruction } = now;
  due = instruction?.remaining == null ? null : Date.now() + 1000 * instruction.remaining;
  if (instruction && draft.request !== instruction.request) {
    draft = { request: instruction.request, fields: {}, why: {} };
    save();
    warn($("remark"), "");
  }
  draw();
  alertTo(instruction);
  stayAwake();
  locate();
}

// Acts, kept until a reply.
let sending = false;
function enqueue(entry) {
  if (entry.path === "duty") outbox = outbox.filter((e) => e.path !== "duty");  // the last wish counts
  outbox.push({ ...entry, tries: 0 });
  save();
  warn($("remark"), "");
  draw();
  deliver();
}

async function deliver() {
  if (sending) return;
  sending = true;
  while (outbox.length) {
    const entry = outbox[0], { path, body, text } = entry;
    const failure = await call(path, { body }).then(() => linked(true), (error) => error);
    const over = !failure || refused(failure);
    if (over) outbox = outbox.filter((e) => e !== entry); else entry.tries++;
    save();
    if (!failure) delivered = body.request ?? delivered;
    else if (failure.status === 400 && body.request === now?.instruction?.request) fault(failure.message);
    else if (over) warn($("remark"), `Not sent: ${text}. ${failure.message}`);
    draw();
    if (over) refresh(); else await sleep(again);
  }
  sending = false;
}

// What is drawn: only the parts that have changed.
function draw() {
  if (now) {
    put($("person"), now.person);
    const parts = [now.program ?? "no mission runs", ...now.skills, now.held ? "picked by the mission" : ""];
    put($("about"), parts.filter(Boolean).join(" · "));
    const duty = outbox.find((e) => e.path === "duty")?.body.duty ?? now.duty;
    show($("duty-row"), true);
    put($("duty"), duty ? "On duty" : "On a break: you are not picked.");
    put($("duty-change"), duty ? "Take a break" : "On duty");
    $("duty-change").value = String(!duty);
  }
  const late = outbox.filter((e) => e.tries > 0);
  rows($("outbox"), late.map((e) => `Not sent yet: ${e.text}`));
  show($("outbox"), late.length);
  rows($("notices"), [...now?.notices ?? []].sort((a, b) => b.number - a.number).map((n) => n.text));
  show($("notices-panel"), now?.notices.length);
  drawCard(now?.instruction ?? null);
  drawTitle();
}

function rows(list, texts) {
  if (JSON.stringify([...list.children].map((e) => e.textContent)) !== JSON.stringify(texts))
    list.replaceChildren(...texts.map((text) => h("li", {}, text)));
}

let drawn = "", asked = "";
function drawCard(instruction) {
  show($("card"), instruction);
  show($("idle"), now && !instruction);
  const { request = "", state = "", text = "", answer = null } = instruction ?? {};
  if (check && (check.request !== request || !acts[state]?.includes(check.act))) close();
  $("card").className = state;
  put($("state"), states[state] ?? state);
  put($("text"), text);
  tick();
  const waits = delivered === request || outbox.some((e) => e.body.request === request);
  warn($("sending"), !waits || outbox.some((e) => e.tries > 0) ? "" : delivered === request ? "Sent." : "Sending…");
  show($("acts"), !waits);
  const fields = state === "accepted" && answer ? JSON.stringify([request, answer]) : "";
  if (fields !== asked) {
    asked = fields;
    $("answer").replaceChildren();
    value = (fields && kinds[answer.kind]?.(answer)) || (() => undefined);
  }
  const buttons = JSON.stringify([request, state]);
  if (buttons !== drawn) {
    drawn = buttons;
    fault("");
    const made = (acts[state] ?? []).map((act, i) =>
      h("button", { type: "button", disabled: "", value: act, ...i ? {} : { class: "main" } }, names[act]));
    $("acts").replaceChildren(...made);
    setTimeout(() => made.forEach((b) => { b.disabled = false; }), settle);
    // The buttons and fields that had the focus are gone; a screen reader goes on here.
    if (!$("duty-row").contains(document.activeElement)) $(instruction ? "state" : "idle").focus();
  }
}

function tick() {
  const timed = due !== null && now.instruction.state !== "stopping";
  const left = timed ? Math.max(0, Math.ceil((due - Date.now()) / 1000)) : null;
  const two = (n) => String(n).padStart(2, "0"), minutes = Math.floor(left / 60);
  const hours = minutes < 60 ? minutes : `${Math.floor(minutes / 60)}:${two(minutes % 60)}`;
  put($("left"), left === null ? "" : left ? `${hours}:${two(left % 60)} left` : "the time is over");
  $("left").className = left !== null && left < 60 ? "late" : "";
}
setInterval(tick, 1000);

function fault(text, field = null) {
  warn($("trouble"), text);
  for (const el of $("answer").querySelectorAll("input, textarea")) el.removeAttribute("aria-invalid");
  field?.setAttribute("aria-invalid", "true");
  field?.focus();
}

// Answers: `kinds[kind](answer)` makes the fields, and returns a function that reads them.
let value = () => undefined;
function field(label, name, tag, attributes = {}) {
  const el = h(tag, { id: `answer-${name}`, autocomplete: "off", "aria-describedby": "trouble", ...attributes });
  if (attributes.type !== "file") {
    el.value = draft.fields[name] ?? "";
    el.addEventListener("input", () => { draft.fields[name] = el.value; save(); });
  }
  $("answer").append(h("div", {}, h("label", { for: el.id }, label), el));
  return el;
}

/** The number of a field, within limits that `limits` has in words. */
function number(el, least, most, limits) {
  const text = el.value.trim().replace(",", ".").replace("−", "-");
  const found = Number(text), wanted = `a number ${limits}`;
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d{1,2})?$/i.test(text)) refuse(`Enter ${wanted.trim()}.`, { field: el });
  const within = found >= (least ?? -Infinity) && found <= (most ?? Infinity);
  return within ? found : refuse(`${text} is refused. Enter ${wanted}.`, { field: el });
}

const kinds = {
  number({ unit, least, most }) {
    const low = least == null ? "" : `from ${least}`, high = most == null ? "" : low ? `to ${most}` : `up to ${most}`;
    const limits = [low, high, unit].filter(Boolean).join(" ");
    // Some keyboards for decimals have no minus.
    const inputmode = least != null && least >= 0 ? "decimal" : "text";
    const el = field(`A number ${limits}`.trim(), "number", "input", { inputmode });
    return () => number(el, least, most, limits);
  },
  text() {
    const el = field("Answer", "text", "textarea", { rows: "3" });
    return () => el.value.trim() || refuse("Enter an answer.", { field: el });
  },
  choice({ choices }) {
    const made = choices.map((choice, i) => {
      const el = h("input", { type: "radio", name: "choice", id: `choice-${i}` });
      el.checked = draft.fields.choice === choice;
      el.addEventListener("change", () => { draft.fields.choice = choice; save(); });
      return h("label", { class: "choice" }, el, choice);
    });
    $("answer").append(h("fieldset", { "aria-describedby": "trouble" }, h("legend", {}, "Choose one"), ...made));
    return () => draft.fields.choice ?? refuse("Choose one of them.", { field: $("choice-0") });
  },
  position() {
    const find = h("button", { type: "button" }, "Use my position"), hint = h("p", { class: "hint", role: "status" });
    $("answer").append(find, hint);
    const north = field("Latitude in degrees", "latitude", "input");
    const east = field("Longitude in degrees", "longitude", "input");
    const fill = ({ latitude, longitude, accuracy }) => {
      [north.value, east.value] = [latitude.toFixed(7), longitude.toFixed(7)];
      for (const el of [north, east]) el.dispatchEvent(new Event("input"));
      put(hint, `Your position, within ${Math.ceil(accuracy)} m.`);
    };
    find.addEventListener("click", () => {
      put(hint, unlocated() || "Waiting for a position…");
      if (here) fill(here);
      else if (!unlocated()) navigator.geolocation.getCurrentPosition(({ coords }) => fill(coords),
        (e) => put(hint, troubles[e.code] ?? e.message), { enableHighAccuracy: true, timeout: 30_000 });
    });
    const coordinate = (el, most) => number(el, -most, most, `from ${-most} to ${most}`);
    return () => ({ latitude: coordinate(north, 90), longitude: coordinate(east, 180) });
  },
  photo() {
    const el = field("Photo", "file", "input", { type: "file", accept: "image/*", capture: "environment" });
    const { photo } = draft.fields, image = h("img", { alt: "the chosen photo", hidden: "" });
    const hint = h("p", { class: "hint", role: "status" }, photo ? `The photo is sent: ${photo}` : "");
    $("answer").append(image, hint);
    el.addEventListener("change", () => void upload(el, hint, image));
    return () => draft.fields.photo || refuse("Take a photo, and wait until it is sent.", { field: el });
  },
};

async function upload(el, hint, image) {
  const file = el.files[0], { fields } = draft;
  delete fields.photo;
  save();
  URL.revokeObjectURL(image.src);
  show(image, file);
  if (!file) return put(hint, "");
  image.src = URL.createObjectURL(file);
  put(hint, "Sending the photo…");
  // Another photo, or another instruction, ends the tries.
  while (el.isConnected && el.files[0] === file) {
    try {
      const { photo } = await call("photo", { body: file, type: file.type, limit: 120_000 });
      if (el.files[0] !== file) return;
      fields.photo = photo;
      save();
      return put(hint, `The photo is sent: ${photo}`);
    } catch (error) {
      if (refused(error)) return put(hint, `The photo is refused: ${error.message}`);
      put(hint, "The photo is not sent yet; it is sent again.");
      await sleep(again);
    }
  }
}

function inWords(found) {
  const { unit } = now.instruction.answer ?? {};
  if (found === undefined) return "";
  if (typeof found === "object") return `: ${found.latitude}°, ${found.longitude}°`;
  return `: ${found}${typeof found === "number" && unit ? ` ${unit}` : ""}`;
}

// Two presses for an act that ends the instruction: the second one is at another place.
let check = null;  // the act that waits for "Yes, send"
function press(act, from) {
  const { request, text } = now.instruction;
  if (act === "accept") return enqueue({ path: "act", body: { request, act }, text: `Accept (${text})` });
  fault("");
  try { check = { request, act, ...act === "done" ? { value: value() } : {} }; } catch (error) {
    return fault(error.message, error.field);
  }
  const reason = act === "decline" || act === "cannot";
  put($("check-what"), names[act] + inWords(check.value));
  show($("why-row"), reason);
  put($("why-label"), act === "cannot" ? "Reason (needed)" : "Reason (optional)");
  $("why").value = draft.why[act] ?? "";
  warn($("why-trouble"), "");
  $("check").className = "";
  $("check").showModal();
  if ($("check").getBoundingClientRect().bottom > from.getBoundingClientRect().top) $("check").className = "low";
  $("send").disabled = true;
  setTimeout(() => { $("send").disabled = false; }, settle);
  (reason ? $("why") : $("back")).focus();
}

const close = () => { check = null; $("check").close(); };
$("acts").addEventListener("click", (e) => { if (e.target.value) press(e.target.value, e.target); });
$("answer").addEventListener("input", () => fault(""));
$("answer").addEventListener("keydown", (e) => {
  if (e.key !== "Enter" || e.target.tagName !== "INPUT" || e.target.type === "file") return;
  e.preventDefault();
  const button = $("acts").querySelector("button");
  if (button && !button.disabled && !$("acts").hidden) press("done", button);
});
$("why").addEventListener("input", () => { draft.why[check.act] = $("why").value; save(); });
$("back").addEventListener("click", close);
$("check").addEventListener("close", () => { if (!$("check").open) check = null; });
$("send").addEventListener("click", () => {
  if (!check) return;
  const { act } = check, { text } = now.instruction, why = $("why").value.trim();
  if (act === "cannot" && !why) {
    warn($("why-trouble"), "Enter a reason.");
    return $("why").focus();
  }
  const reason = !$("why-row").hidden, body = { ...check, ...reason ? { why } : {} };
  const sent = names[act] + inWords(reason && why ? why : check.value);
  close();
  enqueue({ path: "act", body, text: `${sent} (${text})` });
  $("state").focus();
});
$("duty-change").addEventListener("click", (e) => {
  enqueue({ path: "duty", body: { duty: e.target.value === "true" }, text: e.target.textContent });
});

// A new instruction, and a stop: by vibration, tone, title and screen reader.
let rung = "", mark = "", audio = null;
function alertTo(instruction) {
  const { request, state, text } = instruction ?? {}, key = JSON.stringify([request, state]);
  if (!instruction || key === rung) return;
  rung = key;
  if (state === "accepted") return;
  mark = `● ${state === "offered" ? "New" : "Stop"}: ${text}`;
  drawTitle();
  put($("news"), `${states[state]}: ${text}`);
  navigator.vibrate?.([300, 150, 300]);
  ring();
}

function drawTitle() {
  const { request, state } = now?.instruction ?? {};
  if (rung !== JSON.stringify([request, state])) mark = "";
  const title = mark || (now ? `${now.person} · Dolphin` : "Dolphin");
  if (document.title !== title) document.title = title;
}

function ring() {
  if (!audio) return;
  void audio.resume();
  for (const [start, pitch] of [[0, 880], [0.25, 1320]]) {
    const tone = audio.createOscillator(), gain = audio.createGain(), from = audio.currentTime + start;
    [tone.frequency.value, gain.gain.value] = [pitch, 0.15];
    tone.connect(gain).connect(audio.destination);
    tone.start(from);
    tone.stop(from + 0.2);
  }
}

const looked = () => { mark = ""; drawTitle(); };
for (const kind of ["pointerdown", "click", "keydown"]) addEventListener(kind, () => {
  // Browsers are silent before the first touch.
  try { audio ??= new AudioContext(); void audio.resume(); } catch { /* no sound here */ }
  looked();
}, true);
addEventListener("focus", looked);
addEventListener("online", refresh);
document.addEventListener("visibilitychange", () => {
  if (document.visibilityState !== "visible") return;
  looked();
  stayAwake();
  refresh();  // the request of a page that slept may hang
});

let lock = null, asking = false;
async function stayAwake() {
  if (!now?.instruction) return lock?.release();
  if (lock || asking || !navigator.wakeLock || document.visibilityState !== "visible") return;
  asking = true;
  try {
    lock = await navigator.wakeLock.request("screen");
    lock.addEventListener("release", () => { lock = null; });
  } catch { /* refused, as where the battery is low */ }
  asking = false;
}

// The person's position, if the mission uses it.
const troubles = ["", "The browser does not allow the position.", "No position here.", "No position yet."];
const unlocated = () => !isSecureContext ? "The position cannot be had: it needs HTTPS, or this machine's own address."
  : navigator.geolocation ? "" : "This browser has no position.";
let watch = null, here = null, spot = null, posting = false;
function locate() {
  const { geolocation } = navigator, shared = (text) => put($("shared"), text);
  show($("shared"), now.locate);
  if (now.locate && unlocated()) return shared(`${unlocated()} Your position is not shared.`);
  if (now.locate && watch === null) {
    shared("Waiting for your position, to share it with the mission…");
    watch = geolocation.watchPosition(({ coords }) => share(coords), (e) => {
      here = null;
      shared(`${troubles[e.code] ?? e.message} Your position is not shared.`);
    }, { enableHighAccuracy: true });
  } else if (!now.locate && watch !== null) {
    geolocation.clearWatch(watch);
    watch = here = spot = null;
  }
}

async function share(coords) {
  const { latitude, longitude, altitude } = here = coords;
  spot = { latitude, longitude, ...altitude === null ? {} : { height: altitude } };
  if (posting) return;
  posting = true;
  while (spot) {
    const body = spot;
    spot = null;
    try {
      await call("position", { body });
      put($("shared"), "Your position is shared with the mission.");
    } catch (error) {
      const over = refused(error), why = over ? error.message : "no connection";
      put($("shared"), `Your position is not shared: ${why}.`);
      if (watch !== null && !over) spot ??= body;
    }
    await sleep(between);
  }
  posting = false;
}

if (/^[\x21-\x7e]+$/.test(token)) {
  draw();
  void follow();
  void deliver();
} else {
  put($("link"), "not connected");
  warn($("denied"), "The link is not complete: this page needs all of it, also the part after #.");
}
