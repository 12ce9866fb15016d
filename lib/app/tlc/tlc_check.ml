open Dolphin_tlc
open Dolphin_semantics
module Safe_print = Dolphin_display.Safe_print
module Property = Dolphin_explore.Property
module Environment = Dolphin_environment.Environment

module Run = Dolphin_tla.Tlc_questions

type settings = {
  mode : Invocation.mode;
  directory : string option;
  strict : bool;
  notice : string -> unit;
}

(* {1 Names} *)

let properties : (string * Property.t) list =
  [ ("NoDeadlock", No_deadlock); ("Termination", Termination); ("NoError", No_error); ("Assertions", Assertions);
    ("EnoughVehicles", Allocation); ("NoHalt", No_halt); ("NoLeftover", No_leftover) ]

let phrase name = match List.assoc_opt name properties with Some p -> Property.name p | None -> name

(* With a single temporal property: TLC does not name the violated one. *)
let violated : Tlc_message.violation -> string = function
  | Invariant name | Property name -> name
  | Temporal -> "Termination"
  | Deadlock -> "NoDeadlock"
  | Unnamed -> ""

(* Whether a run shows the reported violation: if labels leave a choice, such a run is wanted. *)
let shows name options program world ((c, e) : Dolphin_explore.Labelled.state) (steps : Transition.t list) =
  match List.assoc_opt name properties, List.rev steps with
  | Some No_deadlock, _ -> Environment.is_stuck options program e (Environment.choices options program world e c)
  | Some (Vehicles | Allocation), last :: _ -> (
      match Property.broken_by_end program last.rules c with
      | Some (Vehicles | Allocation) -> true
      | Some _ | None -> false)
  | Some ((No_error | Assertions | No_halt | No_leftover) as p), last :: _ ->
    Property.broken_by_end program last.rules c = Some p
  | (Some _ | None), _ -> true

(* {1 Printing} *)

let print_states (c : Outcome.counter_example) =
  let print i (step : Outcome.step) =
    Safe_print.printf "%4d  %s\n" (i + 1) (Option.value step.action ~default:"?");
    List.iter (fun line -> Safe_print.printf "      %s\n" line) (String.split_on_char '\n' step.state)
  in
  List.iteri print c.steps

(* All that the server of the distributed mode shows. *)
let print_last_step (c : Outcome.counter_example) =
  Safe_print.line
    "some property is violated: TLC's distributed mode does not name it, and shows only the last step. To see a run: \
     --run alone.";
  let label (step : Outcome.step) = Option.bind (Tlc_message.variable "label" step.state) Quoted.unescape in
  match List.rev_map label c.steps with
  | Some label :: _ -> Safe_print.printf "last step: %s\n" label
  | None :: _ | [] -> ()

let print_counter_example options (program : Program_file.t) world (c : Outcome.counter_example) =
  let name = violated c.violation in
  let question =
    match List.assoc_opt name properties with Some p -> Property.question p | None -> "it does not hold"
  in
  Safe_print.format "@.%s: a run in which %s@." (phrase name) question;
  let broken = shows name options program.program world in
  match Recovered.run options program.program world ~broken c with
  | exception Environment.Unclear fault ->
    Safe_print.format "Of this run the explorer cannot list what may happen: %s. The states of TLC:@." fault.message;
    print_states c
  | Ok { steps; cycle } ->
    Run_columns.print program ~steps ~cycle;
    if name = "NoDeadlock" then Run_columns.print_waiting program steps
  | Error trouble ->
    Safe_print.format "The explorer does not have this run: %a. --compare shows the difference. The states of TLC:@."
      Recovered.pp_trouble
      trouble;
    print_states c

let steps n = Dolphin_trace.Phrase.count n "step"

let length (c : Outcome.counter_example) =
  let n = steps (List.length c.steps) in
  match c.repetition with
  | Once -> "after " ^ n
  | Stays -> Printf.sprintf "after %s, without end" n
  | Back_to 0 -> Printf.sprintf "%s that can repeat without end" (steps (List.length c.steps + 1))
  | Back_to k ->
    Printf.sprintf "after %s, %s that can repeat without end" (steps k) (steps (List.length c.steps - k + 1))

(* TLC stops at the first violation, except of temporal properties: these it checks when it has all states, and now
   and then before. Properties of the specification rather than of the program are only shown if they do not hold. *)
let print_verdicts names (program : Program_file.t) (o : Outcome.t) =
  let broken = match o.verdict with Violated c -> Some (violated c.violation, length c) | _ -> None in
  let all_states = match o.verdict with Violated { violation = Temporal; _ } -> o.queue = 0 | _ -> false in
  let holds name =
    if name = "Termination" && program.program.goes_round then
      "holds of runs that do not stay in the rounds of one task: dolphin explore judges those"
    else "holds"
  in
  let print name =
    match broken, o.verdict with
    | Some (broken, how), _ when broken = name -> Safe_print.printf "%s: violated %s\n" (phrase name) how
    | _, _ when not (List.mem_assoc name properties) -> ()
    | None, Holds -> Safe_print.printf "%s: %s\n" (phrase name) (holds name)
    | Some _, _ when all_states -> Safe_print.printf "%s: %s\n" (phrase name) (holds name)
    | Some _, _ -> Safe_print.printf "%s: not decided: TLC stops at a violation\n" (phrase name)
    | None, _ -> Safe_print.printf "%s: not decided\n" (phrase name)
  in
  List.iter print names

let print_counts (o : Outcome.t) =
  let depth = match o.depth with Some d -> Printf.sprintf ", depth %d" d | None -> "" in
  let left = if o.queue > 0 then Printf.sprintf ", %d not looked at" o.queue else "" in
  Safe_print.printf "%d distinct states, %d generated%s%s\n" o.distinct o.generated left depth

let print names options program world (o : Outcome.t) =
  Option.iter Safe_print.line o.version;
  print_verdicts names program o;
  print_counts o;
  match o.verdict with
  | Violated ({ violation = Unnamed; _ } as c) -> print_last_step c
  | Violated c -> print_counter_example options program world c
  | Holds | Unfinished | Gave_up _ | Failed _ -> ()

let verdict : Outcome.verdict -> Exploration.verdict = function
  | Holds -> Holds
  | Violated _ -> Violated
  | Unfinished | Gave_up _ | Failed _ -> Inconclusive

(* Workers may be started before or after the server; without any, nothing is computed. *)
let tell_workers installation ~notice : Invocation.mode -> unit = function
  | Local _ -> ()
  | Server { host; port } ->
    let command = String.concat " " (Invocation.worker installation ~host ~port) in
    notice ("workers join by:\n  " ^ command)

let run installation s model options program world =
  let files = List.map (fun (f : Dolphin_tla.Model.file) -> (f.name, f.text)) (Run.files ~strict:s.strict model) in
  let all = Run.properties ~strict:s.strict in
  (* TLC's distributed mode cannot check temporal properties. *)
  let configuration, checked =
    match s.mode with
    | Local _ -> (Run.check, all)
    | Server _ -> (Run.check_states, List.filter (fun (p : Run.property) -> not p.of_runs) all)
  in
  tell_workers installation ~notice:s.notice s.mode;
  Tlc_session.in_directory s.directory files @@ fun directory ->
  let ended = Tlc_session.run installation s.mode ~directory ~main:Run.main ~configuration ignore in
  let print outcome = print (List.map (fun (p : Run.property) -> p.name) checked) options program world outcome in
  match ended with
  | Error _ as error -> error
  | Ok (Ended outcome) -> print outcome; Ok (verdict outcome.verdict)
  | Ok (Interrupted outcome) ->
    print outcome;
    (match verdict outcome.verdict with
     | Violated -> Ok Violated
     | Holds | Inconclusive -> Error (Error.Inconclusive "interrupted before TLC was done"))
