open Summary

let style =
  {|
.picture { overflow-x: auto; }
.picture svg { min-width: 720px; }
.steer { display: flex; align-items: center; gap: 12px; margin: 4px 28px; }
.steer input { flex: 1; min-width: 120px; }
.steer output { min-width: 5em; font-variant-numeric: tabular-nums; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 6px; margin: 8px 28px 20px; padding: 0; list-style: none; }
.legend button { font: inherit; color: inherit; background: none; border: 1px solid #b9c1c9; border-radius: 4px; }
.legend button { padding: 3px 8px; cursor: pointer; text-align: left; }
.legend button[aria-pressed=true] { border-color: currentColor; font-weight: 600; }
.legend i { display: inline-block; width: 10px; height: 10px; border-radius: 5px; margin-right: 6px; }
.legend small { margin-left: 6px; opacity: 0.75; }
svg.following .who { opacity: 0.13; }
svg.following .who.followed { opacity: 1; }
.now { stroke: #d92d20; stroke-width: 1.2; pointer-events: none; }
.at-now { stroke: #ffffff; stroke-width: 1.5; pointer-events: none; }
@media (max-width: 700px) {
.steer, .legend, table { margin-left: 12px; margin-right: 12px; }
.legend button { padding: 8px 12px; }
}
@media print { .steer, .legend { display: none; } }
|}

(* {1 What the script knows} *)

let tenth x : Yojson.Safe.t = `Float (Float.round (x *. 10.) /. 10.)

let of_vehicle i (v : vehicle) moments : Yojson.Safe.t =
  let moment (time, (x, y)) : Yojson.Safe.t = `List [ tenth time; tenth x; tenth y ] in
  let task (t : task) : Yojson.Safe.t = `List [ tenth t.from; tenth t.until; `String t.plan ] in
  `Assoc
    [ ("name", `String v.id); ("colour", `String (Style.colour i)); ("moments", `List (List.map moment moments));
      ("tasks", `List (List.map task v.tasks)) ]

let known run moments : Yojson.Safe.t =
  let vehicles = List.mapi (fun i (v, moments) -> of_vehicle i v moments) (List.combine run.vehicles moments) in
  `Assoc
    [ ("duration", `Float run.duration); ("steps", `Bool (run.clock = Steps)); ("vehicles", `List vehicles) ]

(* A text in a script must not end it. *)
let embedded json =
  let text = Dolphin_json.Canonical.to_string json in
  String.concat "\\u003c" (String.split_on_char '<' text)

let script =
  {|
"use strict";
(() => {
  const run = JSON.parse(document.getElementById("run").textContent);
  const picture = document.querySelector(".picture svg");
  const slider = document.getElementById("time"), shown = document.getElementById("shown");
  const buttons = [...document.querySelectorAll(".legend button")];
  let pinned = null;

  const follow = (i) => {
    for (const part of picture.querySelectorAll(".followed")) part.classList.remove("followed");
    picture.classList.toggle("following", i !== null);
    if (i !== null) for (const part of picture.querySelectorAll(".w" + i)) part.classList.add("followed");
  };
  const pin = (i) => {
    pinned = pinned === i ? null : i;
    for (const b of buttons) b.setAttribute("aria-pressed", String(Number(b.dataset.vehicle) === pinned));
    follow(pinned);
  };
  const of = (part) => Number([...part.classList].find((c) => /^w[0-9]+$/.test(c)).slice(1));
  const over = (event) => { const part = event.target.closest(".who"); follow(part ? of(part) : pinned); };
  picture.addEventListener("pointerover", over);
  picture.addEventListener("pointerleave", () => follow(pinned));
  picture.addEventListener("click", (event) => { const part = event.target.closest(".who"); if (part) pin(of(part)); });
  for (const b of buttons) {
    const i = Number(b.dataset.vehicle);
    b.addEventListener("pointerenter", () => follow(i));
    b.addEventListener("pointerleave", () => follow(pinned));
    b.addEventListener("focus", () => follow(i));
    b.addEventListener("blur", () => follow(pinned));
    b.addEventListener("click", () => pin(i));
  }

  const make = (name, parent, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [k, x] of Object.entries(attributes)) made.setAttribute(k, x);
    parent.append(made);
    return made;
  };
  const charts = [...picture.querySelectorAll(".chart")].map((chart) => {
    const { left, right, top, bottom } = chart.dataset;
    const line = make("line", chart, { class: "now", y1: top, y2: bottom });
    return { left: Number(left), right: Number(right), line };
  });
  const dots = run.vehicles.map((v, i) => {
    if (v.moments.length === 0) return null;
    return make("circle", make("g", picture, { class: "who w" + i }), { class: "at-now", r: 5, fill: v.colour });
  });
  const place = (moments, time) => {
    let low = 0, high = moments.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (moments[middle][0] <= time) low = middle; else high = middle;
    }
    const [t, x, y] = moments[low], [u, p, q] = moments[high];
    const share = u > t ? Math.min(1, Math.max(0, (time - t) / (u - t))) : 0;
    return [x + share * (p - x), y + share * (q - y)];
  };
  const two = (n) => String(n).padStart(2, "0");
  const told = (time) => {
    if (run.steps) return "step " + Math.round(time);
    const seconds = Math.round(time), minutes = Math.floor(seconds / 60);
    const rest = ":" + two(seconds % 60);
    return minutes < 60 ? minutes + rest : Math.floor(minutes / 60) + ":" + two(minutes % 60) + rest;
  };
  const show = () => {
    const time = Number(slider.value);
    shown.textContent = told(time);
    for (const { left, right, line } of charts) {
      const x = left + (right - left) * (run.duration > 0 ? time / run.duration : 0);
      line.setAttribute("x1", x);
      line.setAttribute("x2", x);
    }
    run.vehicles.forEach((v, i) => {
      if (dots[i]) {
        const [x, y] = place(v.moments, time);
        dots[i].setAttribute("cx", x);
        dots[i].setAttribute("cy", y);
      }
      const task = v.tasks.find(([from, until]) => from <= time && (time < until || until === run.duration));
      buttons.find((b) => Number(b.dataset.vehicle) === i).querySelector("small").textContent = task ? task[2] : "";
    });
  };
  slider.addEventListener("input", show);
  show();
})();
|}

(* {1 Elements} *)

let tail n s = String.sub s n (String.length s - n)

let rec without_digits s =
  if s <> "" && s.[0] >= '0' && s.[0] <= '9' then without_digits (tail 1 s) else s

(* Numbers in names count as numbers: v2 comes before v10. *)
let rec by_numbers a b =
  let digits s = String.length s - String.length (without_digits s) in
  match digits a, digits b with
  | _ when a = "" || b = "" -> String.compare a b
  | 0, _ | _, 0 -> if a.[0] = b.[0] then by_numbers (tail 1 a) (tail 1 b) else Char.compare a.[0] b.[0]
  | m, n -> (
      let number s k = match int_of_string_opt (String.sub s 0 (min k 18)) with Some x -> x | None -> max_int in
      match Int.compare (number a m) (number b n) with 0 -> by_numbers (tail m a) (tail n b) | order -> order)

let legend run =
  let entry (i, v) =
    let attributes = [ ("type", "button"); ("data-vehicle", string_of_int i); ("aria-pressed", "false") ] in
    let sample = Svg.element "i" [ ("style", "background:" ^ Style.colour i) ] [ Svg.text_only "" ] in
    Svg.element "li" []
      [ Svg.element "button" attributes [ sample; Svg.text_only v.id; Svg.element "small" [] [ Svg.text_only "" ] ] ]
  in
  let by_name (_, v) (_, w) = by_numbers v.id w.id in
  let sorted = List.stable_sort by_name (List.mapi (fun i v -> (i, v)) run.vehicles) in
  Svg.element "ul" [ ("class", "legend"); ("aria-label", "vehicles") ] (List.map entry sorted)

let slider run =
  let last = Printf.sprintf "%g" run.duration in
  let step = match run.clock with Steps -> "1" | Seconds -> "any" in
  let range =
    [ ("id", "time"); ("type", "range"); ("min", "0"); ("max", last); ("step", step); ("value", last) ]
    @ [ ("aria-label", "time") ]
  in
  Svg.element "div" [ ("class", "steer") ]
    [ Svg.element "label" [ ("for", "time") ] [ Svg.text_only "time" ]; Svg.element "input" range [];
      Svg.element "output" [ ("id", "shown"); ("for", "time") ] [ Svg.text_only "" ] ]

let parts run ~moments =
  if run.vehicles = [] then []
  else
    [ slider run; legend run;
      Svg.element "script" [ ("type", "application/json"); ("id", "run") ] [ Svg.raw (embedded (known run moments)) ];
      Svg.element "script" [] [ Svg.raw script ] ]
