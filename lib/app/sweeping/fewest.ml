module Timed_analysis = Dolphin_time.Timed_analysis
module Search = Dolphin_explore.Search
module Property = Dolphin_explore.Property
module Limits = Dolphin_checker.Limits
module Scenario = Dolphin_scenario.Scenario
open Dolphin_semantics
module Safe_print = Dolphin_display.Safe_print

type trouble =
  | Property of Property.t * Search.outcome
  | Time of Timed_analysis.shortfall * Timed_analysis.outcome
  | Bound of Limits.bound

type vehicles = Core.vehicle list

type t =
  | Least of {
      vehicles : vehicles;
      outcome : Timed_analysis.outcome;
      without : (Core.vehicle * trouble) list;
      unsure : vehicles list;
    }
  | None_does of { all : trouble; unsure : vehicles list }
  | Interrupted of int

(* {1 One fleet} *)

let exploration (s : Time_analysis.settings) : Exploration.settings =
  { Exploration.plain with
    answers = s.answers; faults = s.faults; max_states = s.max_states; max_depth = s.max_depth;
    max_memory = s.max_memory; timeout = s.timeout }

let part (fleet : Fleet_file.t) vehicles =
  let is_part (v : Scenario.vehicle) = List.mem v.id vehicles in
  { fleet with scenario = { fleet.scenario with vehicles = List.filter is_part fleet.scenario.vehicles } }

let ( let* ) = Result.bind

(* Without formulas and invariants, nothing that is asked of an exploration can be wrong. *)
let explored ~interrupted ~progress settings program fleet =
  match Exploration.explore ~interrupted ~progress (exploration settings) program fleet with
  | Error e -> invalid_arg (String.concat "; " (Error.sentences e))
  | Ok o -> (
      match Exploration.verdict ~strict:false o, Exploration.counterexample ~strict:false o, o.stopped with
      | Violated, Some (property, _), _ -> Error (Property (property, o))
      | Inconclusive, _, Some bound -> Error (Bound bound)
      | (Violated | Inconclusive), _, _ | Holds, _, _ -> Ok ())

(* The time with these vehicles, or what stands against them. *)
let judge ~interrupted ~progress (settings : Time_analysis.settings) program fleet vehicles =
  let fleet = part fleet vehicles in
  let* () = explored ~interrupted ~progress settings program fleet in
  let outcome = Time_analysis.run ~interrupted ~progress settings program fleet in
  match Timed_analysis.shortfall ?deadline:settings.deadline outcome with
  | None -> Ok outcome
  | Some why -> Error (Time (why, outcome))

let is_open = function Bound _ | Time (Unknown, _) -> true | Property _ | Time _ -> false

(* {1 The least one} *)

let find ~interrupted ~progress settings program (fleet : Fleet_file.t) =
  let looked_at = ref 0 in
  let judge = judge ~interrupted ~progress settings program fleet in
  let all = List.map (fun (v : Scenario.vehicle) -> v.id) fleet.scenario.vehicles in
  let without vehicles v =
    match judge (List.filter (( <> ) v) vehicles) with Ok _ -> None | Error trouble -> Some (v, trouble) in
  let least vehicles outcome unsure =
    let is_smaller vs = List.compare_lengths vs vehicles < 0 in
    Least
      { vehicles; outcome; without = List.filter_map (without vehicles) vehicles;
        unsure = List.rev (List.filter is_smaller unsure) }
  in
  (* The last fleet is all of it. *)
  let rec of_size n unsure candidates =
    match candidates () with
    | _ when interrupted () -> Interrupted n
    | Seq.Nil -> of_size (n + 1) unsure (Sublists.of_length (n + 1) all)
    | Seq.Cons (vehicles, others) -> (
        incr looked_at;
        match judge vehicles with
        | _ when interrupted () -> Interrupted n
        | Ok outcome -> least vehicles outcome unsure
        | Error trouble when n = List.length all -> None_does { all = trouble; unsure = List.rev unsure }
        | Error trouble -> of_size n (if is_open trouble then vehicles :: unsure else unsure) others)
  in
  let found = of_size 0 [] (Sublists.of_length 0 all) in
  (found, !looked_at)

let verdict : t -> Sweep.verdict = function
  | Least { unsure = []; _ } -> Holds
  | Least _ | Interrupted _ -> Inconclusive
  | None_does { all; unsure } -> if is_open all || unsure <> [] then Inconclusive else Violated

(* {1 Output} *)

let told = function
  | Property (property, _) -> Property.name property ^ ": violated"
  | Time (why, _) -> Time_sweep.shortfall why
  | Bound bound -> Format.asprintf "inconclusive: %a" Limits.pp_bound bound

let print_run ?deadline program = function
  | Property (_, o) -> Exploration_report.print_violations ~strict:false program o
  | Time (Fails, { failing = Some run; _ }) -> Time_report.print_failing program run
  | Time (_, o) -> Time_report.print_run ?deadline program o
  | Bound _ -> ()

let say format = Printf.ksprintf Run_columns.say format
let names = function [] -> "no vehicles" | vehicles -> String.concat ", " vehicles

let print ?deadline program (fleet : Fleet_file.t) (found, looked_at) =
  let all = List.length fleet.scenario.vehicles in
  let fleets = Dolphin_trace.Phrase.count looked_at "fleet" in
  let tell_unsure = List.iter (fun vs -> say "inconclusive: %s" (names vs)) in
  match found with
  | Least { vehicles; outcome; without; unsure } ->
    say "fewest: %d of %d vehicles: %s" (List.length vehicles) all (names vehicles);
    tell_unsure unsure;
    List.iter (fun (v, trouble) -> say "without %s: %s" v (told trouble)) without;
    Safe_print.printf "%s looked at\n" fleets;
    let first = List.find_opt (fun (_, trouble) -> not (is_open trouble)) without in
    Option.iter (fun (v, trouble) -> Safe_print.printf "\nwithout %s:" v; print_run ?deadline program trouble) first;
    Safe_print.printf "\nwith %s:" (names vehicles);
    Time_report.print_run ?deadline program outcome
  | None_does { all = trouble; unsure } ->
    let is_sure = verdict found = Violated in
    Safe_print.printf "no fleet of these %d vehicles %s\n" all (if is_sure then "will do" else "is known to do");
    tell_unsure unsure;
    say "with all of them: %s" (told trouble);
    say "%s looked at" fleets;
    print_run ?deadline program trouble
  | Interrupted n ->
    Safe_print.printf "interrupted: of fewer than %s none is known to do; %s looked at\n"
      (Dolphin_trace.Phrase.count n "vehicle") fleets

let to_json ?deadline program (found, looked_at) : Yojson.Safe.t =
  let list vehicles = `List (List.map (fun v -> `String v) vehicles) in
  let outcome = function
    | Property (_, o) -> [ ("explored", Exploration_report.to_json program o) ]
    | Time (_, o) -> [ ("timed", Time_report.to_json ?deadline program o) ]
    | Bound _ -> []
  in
  let trouble t = `Assoc (("why", `String (told t)) :: outcome t) in
  let found =
    match found with
    | Least { vehicles; outcome; without; unsure } ->
      [ ("fewest", `Int (List.length vehicles)); ("vehicles", list vehicles);
        ("timed", Time_report.to_json ?deadline program outcome);
        ("without", `Assoc (List.map (fun (v, t) -> (v, trouble t)) without));
        ("unsure", `List (List.map list unsure)) ]
    | None_does { all; unsure } ->
      [ ("fewest", `Null); ("all", trouble all); ("unsure", `List (List.map list unsure)) ]
    | Interrupted n -> [ ("fewest", `Null); ("at least", `Int n) ]
  in
  `Assoc (found @ [ ("fleets", `Int looked_at) ])
