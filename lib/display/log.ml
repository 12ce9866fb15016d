open Dolphin_semantics
module Phrase = Dolphin_trace.Phrase

type t = {
  before : Core.platform_task Vehicle_map.t;  (* A before the transition: what a vehicle that is stopped was doing *)
  unheard : Core.vehicle list;  (* bound vehicles without a link *)
  unready : (Core.vehicle * string) list;  (* bound vehicles that cannot be given a plan, and why *)
  bound : Core.vehicle list;
  column : int;  (* width of the column of actors *)
}

(* {1 Lines} *)

let narrowest = 10
let widest = 24
let program = "program"
let start = { before = Vehicle_map.empty; unheard = []; unready = []; bound = []; column = narrowest }

(* Further lines of a text stand below its first one. *)
let line l ~time actor text =
  let head = Printf.sprintf "%7s  %s  " (Phrase.time time) (Phrase.pad l.column (Phrase.one_line actor)) in
  let indentation = String.make (Phrase.width head) ' ' in
  match String.split_on_char '\n' (Phrase.harmless text) with
  | [] -> head
  | first :: rest -> String.concat "\n" ((head ^ first) :: List.map (fun text -> indentation ^ text) rest)

let question l ~time prompt = line l ~time program ("asks: " ^ prompt)
let remark l ~time text = line l ~time program text

(* {1 What transitions say} *)

let deed : Code.deed -> string = function
  | Posted pairs -> Format.asprintf "posts %a" Fmt.(list ~sep:(any ", ") Value.pp_tuple) pairs
  | Consumed pairs -> Format.asprintf "consumes %a" Fmt.(list ~sep:(any ", ") Value.pp_tuple) pairs
  | Said text -> "says: " ^ text
  | Released vs -> "releases " ^ Wording.vehicles vs
  | Set_connection_timeout (None, seconds) -> "sets the connection timeout to " ^ Wording.duration seconds
  | Set_connection_timeout (Some vs, seconds) ->
    Printf.sprintf "sets the connection timeout of %s to %s" (Wording.vehicles vs) (Wording.duration seconds)

let ending ~stuck : Configuration.ending -> string = function
  | Completed -> "ends"
  | Halted "" -> "halts"
  | Halted message -> "halts: " ^ message
  | Failed fault -> "fails: " ^ fault.message
  | Interrupted -> if stuck then "is stuck" else "is interrupted"

let task_of l v = match Vehicle_map.find_opt v l.before with Some p -> Phrase.one_line p.Core.name | None -> "its task"

(* Who did what, as far as the label tells. Ends and what leads to them are told by the effect [End]. *)
let of_label (s : Transition.t) =
  let by_program text = [ (program, text) ] in
  let deeds ds = List.map (fun d -> (program, deed d)) ds in
  match s.label with
  | Done (v, name) -> [ (v, "ends " ^ Phrase.one_line name) ]
  | Fail (v, name, why) -> [ (v, Printf.sprintf "fails in %s: %s" (Phrase.one_line name) why) ]
  | Check [] -> by_program "sees that a condition holds"
  | Cut ds -> by_program "sees that the condition of until holds" @ deeds ds
  | Check ds | Act ds -> deeds ds
  | Did d -> deeds [ d ]
  | Time_out when List.mem Rule.Idle_end s.rules -> by_program "idled long enough"
  | Time_out -> by_program "cuts a task short: its time is up"
  | Set_time seconds -> by_program ("allows a task " ^ Wording.duration seconds)
  | Broken why -> by_program ("has an error in a task: " ^ why)
  | Pause seconds -> by_program ("pauses for " ^ Wording.duration seconds)
  | Call what -> by_program ("calls " ^ what)
  | Reply what -> by_program ("is told " ^ what)
  | Start _ | Silent | Pick _ | Bind _ | No_vehicles _ | Ask _ | Answer _ | No_answer | Resume | No_reply _
  | Execute | Cannot_execute _ | End | Halt _ | Fault _ | Interrupt -> []

(* The first effects of a transition are those of the deeds in its label, which are told already. *)
let told_by_label (label : Label.t) =
  let has_effect : Code.deed -> bool = function
    | Posted _ | Consumed _ -> false
    | Said _ | Released _ | Set_connection_timeout _ -> true
  in
  match label with
  | Did d -> if has_effect d then 1 else 0
  | Check ds | Act ds | Cut ds -> List.length (List.filter has_effect ds)
  | Start _ | Done _ | Fail _ | Time_out | Set_time _ | Broken _ | Silent | Pick _ | Bind _ | No_vehicles _ | Ask _
  | Answer _ | No_answer | Pause _ | Resume | Call _ | Reply _ | No_reply _ | Execute | Cannot_execute _ | End
  | Halt _ | Fault _ | Interrupt -> 0

let of_effect ~stuck l : Effect.t -> (string * string) list = function
  | Start (v, p) -> [ (v, "starts " ^ Phrase.one_line p.name) ]
  | Stop v -> [ (v, "stops " ^ task_of l v) ]
  | Bind vs -> [ (program, "picks " ^ Wording.vehicles vs) ]
  | Release vs -> [ (program, deed (Released vs)) ]
  | Say text -> [ (program, deed (Said text)) ]
  | Set_connection_timeout (vs, seconds) -> [ (program, deed (Set_connection_timeout (vs, seconds))) ]
  | End e -> [ (program, ending ~stuck e) ]
  | Set_timer _ | Cancel_timer _ | Look_for _ | Ask _ | Call_host _ -> []

let transition ?(stuck = false) l ~time (s : Transition.t) =
  let bound = s.next.shared.bound in
  let wider column v = max column (min widest (Phrase.width v)) in
  let column = if bound == l.bound then l.column else List.fold_left wider l.column bound in
  let l = { l with column } in
  let further = List.filteri (fun i _ -> i >= told_by_label s.label) s.effects in
  let happenings = of_label s @ List.concat_map (of_effect ~stuck l) further in
  let lines = List.map (fun (actor, text) -> line l ~time actor text) happenings in
  ({ l with before = s.next.shared.allocation; bound }, lines)

let link l ~time (state : World.vehicle_state) =
  let was_heard = not (List.mem state.id l.unheard) in
  if state.connected = was_heard then (l, [])
  else if state.connected then
    let unheard = List.filter (fun v -> v <> state.id) l.unheard in
    ({ l with unheard }, [ line l ~time state.id "has its link back" ])
  else ({ l with unheard = state.id :: l.unheard }, [ line l ~time state.id "loses its link" ])

(* Of a vehicle without a link nobody knows. *)
let readiness l ~time (state : World.vehicle_state) =
  let before = List.assoc_opt state.id l.unready in
  if (not state.connected) || before = state.unready then (l, [])
  else
    let others = List.remove_assoc state.id l.unready in
    match state.unready with
    | Some why -> ({ l with unready = (state.id, why) :: others }, [ line l ~time state.id why ])
    | None -> ({ l with unready = others }, [ line l ~time state.id "is ready again" ])

let news l ~time (state : World.vehicle_state) =
  if not (List.mem state.id l.bound) then (l, [])
  else
    let l, of_link = link l ~time state in
    let l, of_readiness = readiness l ~time state in
    (l, of_link @ of_readiness)
