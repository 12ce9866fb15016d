open Dolphin_semantics
module Phrase = Dolphin_trace.Phrase
module Location = Dolphin_syntax.Location

type t = {
  bound : Core.vehicle list;
  running : (Core.platform_task * float) Vehicle_map.t;  (* with the time of its start *)
  failed : (string * string) Vehicle_map.t;  (* the task that failed last, and why, until another one starts *)
  seen : World.vehicle_state Vehicle_map.t;
}

let start =
  { bound = []; running = Vehicle_map.empty; failed = Vehicle_map.empty; seen = Vehicle_map.empty }

(* Only what a transition starts or ends is looked at: a board of a thousand vehicles changes often. *)
let transition b ~time (s : Transition.t) =
  let ended v b =
    if Vehicle_map.mem v s.next.shared.allocation then b else { b with running = Vehicle_map.remove v b.running } in
  let of_effect b : Effect.t -> _ = function
    | Start (v, p) ->
      { b with running = Vehicle_map.add v (p, time) b.running; failed = Vehicle_map.remove v b.failed }
    | Stop v -> { b with running = Vehicle_map.remove v b.running }
    | Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
    | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ -> b
  in
  let b =
    match s.label with
    | Done (v, _) -> ended v b
    | Fail (v, name, why) -> ended v { b with failed = Vehicle_map.add v (name, why) b.failed }
    | _ -> b
  in
  { (List.fold_left of_effect b s.effects) with bound = s.next.shared.bound }

let news b (state : World.vehicle_state) = { b with seen = Vehicle_map.add state.id state b.seen }

(* {1 Vehicles} *)

type condition = Trouble | Doubtful | Well

let low_battery = 0.2

let is_low (s : World.vehicle_state) = match s.battery with Some share -> share < low_battery | None -> false

type row = { condition : condition; cells : string list }

let task_of b ~now ~estimate v =
  match Vehicle_map.find_opt v b.running, Vehicle_map.find_opt v b.failed with
  | Some (p, since), _ ->
    let name = Phrase.one_line p.Core.name in
    (Option.fold (estimate v) ~none:name ~some:(fun how -> name ^ ", " ^ how), Phrase.time (now -. since))
  | None, Some (name, why) -> (Phrase.one_line (Printf.sprintf "failed in %s: %s" name why), "")
  | None, None -> ("-", "")

let row b ~now ~estimate v =
  let task, time = task_of b ~now ~estimate v in
  let has_failed = Vehicle_map.mem v b.failed && not (Vehicle_map.mem v b.running) in
  let condition, battery, place =
    match Vehicle_map.find_opt v b.seen with
    | None -> (Well, "", "")
    | Some s ->
      ( (if not (World.is_ready s) then Trouble else if is_low s then Doubtful else Well),
        (if not s.connected then "no link"
         else if not (World.is_ready s) then "not ready"
         else Option.fold s.battery ~none:"" ~some:(fun share -> Printf.sprintf "%.0f%%" (100. *. share))),
        Printf.sprintf "%.5f, %.5f" s.position.latitude s.position.longitude )
  in
  { condition = (if has_failed then Trouble else condition); cells = [ Phrase.one_line v; task; time; battery; place ] }

let is_troubled row = row.condition <> Well

(* Trouble first; else in the order of picking. *)
let by_trouble rows =
  let are condition = List.filter (fun row -> row.condition = condition) rows in
  are Trouble @ are Doubtful @ are Well

(* {1 Lines} *)

let indented text = String.make 9 ' ' ^ text

let head b ~now rows =
  let count = List.length (List.filter is_troubled rows) in
  Printf.sprintf "%7s  %s, %d busy%s" (Phrase.time now)
    (Phrase.count (List.length b.bound) "vehicle")
    (Vehicle_map.cardinal b.running)
    (if count = 0 then "" else Printf.sprintf ", %d with trouble" count)

let place (at : Location.t) = Printf.sprintf "%s:%d" (Filename.basename (Location.file at)) (Location.line at)

let shortened n text = if Phrase.width text <= n then text else fst (Phrase.split (max 0 (n - 3)) text) ^ "..."

(* On a narrow terminal, the missing condition has a line of its own. *)
let of_waiting ~columns ({ what; at; lacking } : Waiting.t) =
  let at = Option.fold at ~none:"" ~some:(fun at -> place at ^ " ") in
  let head = indented (at ^ "waits for " ^ what) in
  match lacking with
  | None -> [ shortened columns head ]
  | Some lacking when Phrase.width head + 2 + Phrase.width lacking <= columns -> [ head ^ ": " ^ lacking ]
  | Some lacking -> [ shortened columns head; indented ("  " ^ lacking) ]

let rec first n = function x :: rest when n > 0 -> x :: first (n - 1) rest | _ -> []

(* The first [n] of [xs], or one less and a line for the others. *)
let fitting n xs more =
  let hidden = List.length xs - n in
  if hidden <= 0 then xs else first (n - 1) xs @ [ more (hidden + 1) ]

let table rows =
  let wider = List.map2 (fun width cell -> max width (Phrase.width cell)) in
  let widths = List.fold_left (fun widths row -> wider widths row.cells) [ 0; 0; 0; 0; 0 ] rows in
  let tint = function Trouble -> Some Tint.bad | Doubtful -> Some Tint.doubtful | Well -> None in
  let show { condition; cells } =
    (tint condition, indented (String.concat "  " (List.map2 Phrase.pad widths cells))) in
  List.map show rows

let lines b ~now ~estimate ~waiting ~rows ~columns ~colour =
  let vehicles = by_trouble (List.map (row b ~now ~estimate) b.bound) in
  let most_waits = max 1 (rows / 6) in
  let more n = [ indented (Printf.sprintf "and waits for %d more" n) ] in
  let waits = List.concat (fitting most_waits (List.map (of_waiting ~columns) waiting) more) in
  let room = max 1 (rows - 1 - List.length waits) in
  let hidden = List.length vehicles - room in
  let shown = if hidden <= 0 then vehicles else first (room - 1) vehicles in
  let others =
    if hidden <= 0 then [] else [ (Some Tint.faint, indented (Printf.sprintf "and %d more" (hidden + 1))) ] in
  let line (tint, text) =
    let text = fst (Phrase.split columns text) in
    Option.fold tint ~none:text ~some:(fun tint -> Tint.paint ~colour tint text)
  in
  if vehicles = [] && waits = [] then []
  else
    List.map line
      (((Some Tint.strong, head b ~now vehicles) :: List.map (fun text -> (None, text)) waits) @ table shown @ others)
