open Dolphin_semantics
module Phrase = Dolphin_trace.Phrase

type t = {
  before : Core.platform_task Vehicle_map.t;  (* A before the transition: the tasks of stopped vehicles *)
  last : Configuration.t option;  (* before the transition *)
  unheard : Core.vehicle list;  (* bound vehicles without a link *)
  unready : (Core.vehicle * string) list;  (* bound vehicles that cannot be given a plan, and why *)
  bound : Core.vehicle list;
  members : Vehicle_set.t;  (* of [bound] *)
  column : int;  (* width of the column of actors *)
  stuck : bool;  (* the program was interrupted because it was stuck *)
}

(* {1 Lines} *)

type severity = Trouble | Said | Completed | Ordinary
type line = { about : Core.vehicle list; severity : severity; text : string }

let narrowest = 10
let widest = 24
let program = "program"
let start =
  { before = Vehicle_map.empty; last = None; unheard = []; unready = []; bound = []; members = Vehicle_set.empty;
    column = narrowest; stuck = false }

(* Further lines of a text stand below its first one. *)
let text_of l ~time actor text =
  let head = Printf.sprintf "%7s  %s  " (Phrase.time time) (Phrase.pad l.column (Phrase.one_line actor)) in
  let indentation = String.make (Phrase.width head) ' ' in
  match String.split_on_char '\n' (Phrase.harmless text) with
  | [] -> head
  | first :: rest -> String.concat "\n" ((head ^ first) :: List.map (fun text -> indentation ^ text) rest)

let question l ~time prompt = text_of l ~time program ("asks: " ^ prompt)
let remark l ~time text = { about = []; severity = Trouble; text = text_of l ~time program text }

(* An entry: its subject, its severity, its words. *)
type happening = { actor : string; others : Core.vehicle list; how : severity; words : string }

let of_program ?(others = []) ?(how = Ordinary) words = { actor = program; others; how; words }
let of_vehicle ?(how = Ordinary) actor words = { actor; others = []; how; words }

let line l ~time { actor; others; how; words } =
  let about = if actor = program then others else [ actor ] in
  { about; severity = how; text = text_of l ~time actor words }

let is_shown ~quiet ~only { about; severity; _ } =
  severity = Trouble || severity = Completed
  || ((severity = Said || not quiet) && (only = [] || List.exists (fun v -> List.mem v only) about))

let tint ~colour { severity; text; _ } =
  match severity with
  | Trouble -> Tint.paint ~colour Tint.bad text
  | Said | Completed -> Tint.paint ~colour Tint.strong text
  | Ordinary -> text

(* {1 Transitions} *)

let deed : Code.deed -> string = function
  | Posted pairs -> Format.asprintf "posts %a" Fmt.(list ~sep:(any ", ") Value.pp_tuple) pairs
  | Consumed pairs -> Format.asprintf "consumes %a" Fmt.(list ~sep:(any ", ") Value.pp_tuple) pairs
  | Said text -> "says: " ^ text
  | Released vs -> "releases " ^ Wording.vehicles vs
  | Set_connection_timeout (None, seconds) -> "sets the connection timeout to " ^ Wording.duration seconds
  | Set_connection_timeout (Some vs, seconds) ->
    Printf.sprintf "sets the connection timeout of %s to %s" (Wording.vehicles vs) (Wording.duration seconds)

let of_deed d =
  match (d : Code.deed) with
  | Posted _ | Consumed _ | Set_connection_timeout (None, _) -> of_program (deed d)
  | Said _ -> of_program ~how:Said (deed d)
  | Released others | Set_connection_timeout (Some others, _) -> of_program ~others (deed d)

let of_ending ~stuck : Configuration.ending -> happening = function
  | Completed -> of_program ~how:Completed "ends"
  | Halted "" -> of_program ~how:Trouble "halts"
  | Halted message -> of_program ~how:Trouble ("halts: " ^ message)
  | Failed fault -> of_program ~how:Trouble ("fails: " ^ fault.message)
  | Interrupted -> of_program ~how:Trouble (if stuck then "is stuck" else "is interrupted")

let task_of l v = match Vehicle_map.find_opt v l.before with Some p -> Phrase.one_line p.Core.name | None -> "its task"

(* The vehicle and its deed, as far as the label has them. The effect [End] reports ends and their causes. *)
let of_label ?(stuck = false) (s : Transition.t) =
  let by_program ?how text = [ of_program ?how text ] in
  match s.label with
  | Done (v, name) -> [ of_vehicle v ("ends " ^ Phrase.one_line name) ]
  | Fail (v, name, why) ->
    [ of_vehicle ~how:Trouble v (Printf.sprintf "fails in %s: %s" (Phrase.one_line name) why) ]
  | Check [] when List.mem Rule.Repeat_again s.rules -> by_program "begins a further round: its condition does not hold"
  | Check [] when List.mem Rule.Repeat_until s.rules -> by_program "begins no further round: its condition holds"
  | Check [] -> by_program "sees that a condition holds"
  | Cut _ when List.mem Rule.Assure_cut s.rules -> by_program "sees that the condition of assure does not hold"
  | Cut ds -> by_program "sees that the condition of until holds" @ List.map of_deed ds
  | Check ds | Act ds -> List.map of_deed ds
  | Did d -> [ of_deed d ]
  | Time_out when List.mem Rule.Idle_end s.rules -> by_program "idled long enough"
  | Time_out when List.mem Rule.Within_cut s.rules -> by_program "stops a task that is not done within its time"
  | Time_out -> by_program "cuts a task short: its time is up"
  | Set_time seconds -> by_program ("allows a task " ^ Wording.duration seconds)
  | Allocate [] -> by_program "goes on with a task that it made"
  | Allocate vs -> List.map (fun v -> of_vehicle v "is given a task") vs
  | Broken why -> by_program ~how:Trouble ("has an error in a task: " ^ why)
  | Pause seconds -> by_program ("pauses for " ^ Wording.duration seconds)
  | Call what -> by_program ("calls " ^ what)
  | Reply what -> by_program ("is told " ^ what)
  | Interrupt when List.mem Rule.On_interrupt s.rules ->
    by_program ~how:Trouble ((if stuck then "is stuck" else "is interrupted") ^ ": executes onInterrupt")
  | Input (k, x) -> by_program (Format.asprintf "gets %a" Value.pp_tuple (k, x))
  | No_vehicles why when List.mem Rule.Pick_else s.rules -> by_program (why ^ "; goes on without")
  | Recruit v -> [ of_vehicle v "is recruited" ]
  | Start _ | Make | Silent | Pick _ | Bind _ | No_vehicles _ | Ask _ | Answer _ | No_answer | Resume | No_reply _
  | Execute | Cannot_execute _ | End | Halt _ | Fault _ | Interrupt -> []

let words (t : Transition.t) =
  match t.label with
  | Check _ | Cut _ | Act _ | Time_out | Set_time _ | Broken _ | Did _ ->
    String.concat "; " (List.map (fun happening -> Phrase.one_line happening.words) (of_label t))
  | _ -> ""

(* The first effects of a transition are those of the deeds in its label, which are reported already. *)
let told_by_label (label : Label.t) =
  let has_effect : Code.deed -> bool = function
    | Posted _ | Consumed _ -> false
    | Said _ | Released _ | Set_connection_timeout _ -> true
  in
  match label with
  | Did d -> if has_effect d then 1 else 0
  | Check ds | Act ds | Cut ds -> List.length (List.filter has_effect ds)
  | Recruit _ -> 1
  | Start _ | Done _ | Fail _ | Time_out | Set_time _ | Make | Allocate _ | Broken _ | Silent | Pick _
  | Bind _ | No_vehicles _ | Ask _
  | Answer _ | No_answer | Pause _ | Resume | Call _ | Reply _ | No_reply _ | Input _ | Execute | Cannot_execute _
  | End | Halt _ | Fault _ | Interrupt -> 0

let of_effect ~stuck l : Effect.t -> happening list = function
  | Start (v, p) -> [ of_vehicle v ("starts " ^ Phrase.one_line p.name) ]
  | Stop v -> [ of_vehicle v ("stops " ^ task_of l v) ]
  | Bind vs -> [ of_program ~others:vs ("picks " ^ Wording.vehicles vs) ]
  | Release vs -> [ of_deed (Released vs) ]
  | Say text -> [ of_deed (Said text) ]
  | Set_connection_timeout (vs, seconds) -> [ of_deed (Set_connection_timeout (vs, seconds)) ]
  | End e -> [ of_ending ~stuck e ]
  | Withdraw_question _ -> [ of_program "withdraws its question" ]
  | Set_timer _ | Cancel_timer _ | Put_question _ | Look_for _ | Ask _ | Call_host _ -> []

(* {2 Ends of tasks} *)

let may_end : Rule.t -> bool = function
  | Ensure_2 | Ensure_err | Par_err | Until_cut | Assure_cut | Until_err | During_cut | Within_cut | Interrupt
  | On_interrupt -> true
  | _ -> false

let same (k, x) (k', x') = String.equal k k' && Value.compare (Value.normal x) (Value.normal x') = 0

(* [pairs] without one of each of [others]. *)
let rec less pairs others =
  match pairs with
  | [] -> []
  | pair :: rest -> (
      match List.partition (same pair) others with
      | _ :: fewer, different -> less rest (fewer @ different)
      | [], _ -> pair :: less rest others)

(* The pairs that the label has posted, and taken. *)
let pairs_of_label (label : Label.t) =
  let of_deed (posted, taken) : Code.deed -> _ = function
    | Posted pairs -> (pairs @ posted, taken)
    | Consumed pairs -> (posted, pairs @ taken)
    | Said _ | Released _ | Set_connection_timeout _ -> (posted, taken)
  in
  match label with
  | Did d -> of_deed ([], []) d
  | Check ds | Act ds | Cut ds -> List.fold_left of_deed ([], []) ds
  | _ -> ([], [])

(* Those of the pairs that tasks of [before] ensure that came into N by [s], and not by its label. *)
let ensured (before : Configuration.t) (s : Transition.t) =
  match before.control with
  | Executing (_, r) when List.exists may_end s.rules ->
    let pair : Core.ensured -> _ = function Pair (k, x) -> Some (k, x) | Variable _ | Taken -> None in
    let owed = List.filter_map pair (Residual.ensured r) in
    let keys = List.sort_uniq String.compare (List.map fst owed) in
    let pairs (c : Configuration.t) =
      List.concat_map (fun k -> List.map (fun x -> (k, x)) (Tuples.values k c.shared.tuples)) keys in
    let posted, taken = pairs_of_label s.label in
    let came = less (pairs s.next) (posted @ less (pairs before) taken) in
    List.filter (fun pair -> List.exists (same pair) owed) came
  | _ -> []

let of_ensured = function
  | [] -> []
  | pairs -> [ of_program (deed (Posted pairs) ^ ", as ensured") ]

(* {2 All of it} *)

let transition ?(stuck = false) l ~time (s : Transition.t) =
  let bound = s.next.shared.bound in
  let wider column v = max column (min widest (Phrase.width v)) in
  let column = if bound == l.bound then l.column else List.fold_left wider l.column bound in
  let stuck = l.stuck || (stuck && s.label = Interrupt) in
  let l = { l with column; stuck } in
  let further = List.filteri (fun i _ -> i >= told_by_label s.label) s.effects in
  let ended = of_ensured (Option.fold l.last ~none:[] ~some:(fun before -> ensured before s)) in
  let happenings = of_label ~stuck s @ ended @ List.concat_map (of_effect ~stuck l) further in
  let lines = List.map (line l ~time) happenings in
  let members = if bound == l.bound then l.members else Vehicle_set.of_list bound in
  ({ l with before = s.next.shared.allocation; last = Some s.next; bound; members }, lines)

let link l ~time (state : World.vehicle_state) =
  let was_heard = not (List.mem state.id l.unheard) in
  if state.connected = was_heard then (l, [])
  else if state.connected then
    let unheard = List.filter (fun v -> v <> state.id) l.unheard in
    ({ l with unheard }, [ line l ~time (of_vehicle state.id "has its link back") ])
  else
    ( { l with unheard = state.id :: l.unheard },
      [ line l ~time (of_vehicle ~how:Trouble state.id "loses its link") ] )

(* The state of a vehicle without a link is unknown. *)
let readiness l ~time (state : World.vehicle_state) =
  let before = List.assoc_opt state.id l.unready in
  if (not state.connected) || before = state.unready then (l, [])
  else
    let others = List.remove_assoc state.id l.unready in
    match state.unready with
    | Some why ->
      ({ l with unready = (state.id, why) :: others }, [ line l ~time (of_vehicle ~how:Trouble state.id why) ])
    | None -> ({ l with unready = others }, [ line l ~time (of_vehicle state.id "is ready again") ])

let news l ~time (state : World.vehicle_state) =
  if not (Vehicle_set.mem state.id l.members) then (l, [])
  else
    let l, of_link = link l ~time state in
    let l, of_readiness = readiness l ~time state in
    (l, of_link @ of_readiness)
