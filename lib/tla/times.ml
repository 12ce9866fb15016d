open Dolphin_semantics
module Bounds = Dolphin_time.Bounds
module Durations = Dolphin_time.Durations
module Links = Dolphin_time.Links
module Faults = Dolphin_environment.Faults

type t = { durations : Durations.t; tick : int; horizon : int }

(* A name that no program has. *)
let nobody = "\000"

let by_name (durations : Durations.t) v name =
  durations.task v (durations.place v) { name; plan = None; task_site = Fault.unknown_site }

let ids world = List.map (fun (s : World.vehicle_state) -> s.id) (World.vehicles world)

let rec divisor a b = if b = 0 then a else divisor b (a mod b)

let has_links links = Links.count links > 0 || Links.late links <> []

let tick (durations : Durations.t) ~(faults : Faults.t) ~plans program world =
  let longest found : Bounds.t -> int = function
    | Within { least; most } -> divisor (divisor found least) most
    | Some_time | Never -> found
  in
  let if_possible limit bounds found = if Faults.is_possible limit then longest found bounds else found in
  let of_vehicle found v = List.fold_left (fun found name -> longest found (by_name durations v name)) found plans in
  let dates = Result.value (Dated_code.named program) ~default:Dated_code.no_dates in
  let of_dates = List.fold_left (fun found n -> divisor found (1000 * n)) 0 dates.once in
  let of_plans = List.fold_left of_vehicle of_dates (ids world) in
  let links = Durations.links_with faults durations in
  let of_links =
    if has_links links then
      let changes = List.fold_left (fun found (_, ms) -> divisor found ms) of_plans (Links.changes links) in
      longest (longest changes durations.announced) durations.silence
    else of_plans
  in
  match if_possible faults.join durations.announced (if_possible faults.loss durations.silence of_links) with
  | 0 -> 1_000
  | n -> n

let too_long = {|Assert(FALSE, "a time of more than 24 days, in milliseconds, is too large for TLC")|}
let milliseconds n : Tla.t = if n > Tla.greatest then Name too_long else Integer n

let bounds : Bounds.t -> Tla.t = function
  | Within { least; most } -> Tuple [ milliseconds least; milliseconds most ]
  | Some_time -> Tuple [ Integer 0; Integer (-1) ]
  | Never -> Tuple []

(* The most frequent case comes last. *)
let cases clauses usual =
  match List.filter (fun (_, value) -> value <> usual) clauses with
  | [] -> Format.asprintf "%a" Tla.pp usual
  | clauses ->
    let clause (condition, value) = Format.asprintf "%s -> %a" condition Tla.pp value in
    Format.asprintf "CASE %s\n    [] OTHER -> %a" (String.concat "\n    [] " (List.map clause clauses)) Tla.pp usual

let lasts t plans world =
  let of_plan v name =
    let text x = Format.asprintf "%a" Tla.pp (Tla.String x) in
    (Printf.sprintf "v = %s /\\ p = %s" (text v) (text name), bounds (by_name t.durations v name))
  in
  let clauses = List.concat_map (fun v -> List.map (of_plan v) plans) (ids world) in
  cases clauses (match ids world with v :: _ -> bounds (by_name t.durations v nobody) | [] -> bounds Some_time)

let posts t keys =
  let of_key k = (Format.asprintf "k = %a" Tla.pp (Tla.String k), bounds (t.durations.posted k)) in
  cases (List.map of_key keys) (bounds Some_time)

let undated =
  {|Assert(FALSE, "now() is used other than in comparisons with constants: its effect on time is unknown here")|}

let daily =
  {|Assert(FALSE, "timeOfDay() is compared, which has dates on every day: its effect on time is unknown here")|}

let code_dates program : Tla.t =
  match Dated_code.named program with
  | Ok { once; daily = [] } -> Tuple (List.map (fun n -> Tla.Integer n) once)
  | Ok { daily = _ :: _; _ } -> Name daily
  | Error _ -> Name undated

let links l : Tla.t = Tuple (List.map (fun (v, ms) -> Tla.Tuple [ String v; milliseconds ms ]) (Links.changes l))

let definitions t ~faults ~plans program world =
  let known = Durations.links_with faults t.durations in
  let text = Format.asprintf "%a" Tla.pp in
  [ ("Links", text (links known));
    ("SilentAtFirst", text (Tuple (List.map (fun v -> Tla.String v) (Links.late known))));
    ("Lasts(v, p)", lasts t plans world); ("Posts(k)", posts t program.Core.inputs);
    ("CodeDates", Format.asprintf "%a" Tla.pp (code_dates program)) ]

(* Whole numbers: the simulator's time-out, and that of links. *)
let values t =
  let exactly : Bounds.t -> int = function Within { most; _ } -> min most Tla.greatest | Some_time | Never -> 0 in
  [ ("TickLength", t.tick); ("Announced", exactly t.durations.announced); ("Silence", exactly t.durations.silence);
    ("Horizon", t.horizon) ]
