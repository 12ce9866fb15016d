open Dolphin_semantics
open Dolphin_runtime
module Names = Map.Make (String)

(* The order to a vehicle, and the notes on it; no notes, if it was not sent yet. A console before this one may have
   sent a [doubtful] order all the same: the end of its journal may be lost. *)
type request = { order : Execution.order; notes : Durable_note.t list; doubt : Execution.doubt }

(* The action for a vehicle when it is heard of. *)
type intent =
  | Nothing
  | Run of { request : request; before : request option;  (* is to be halted first *) deadline : float }
  | Halt of request

type t = intent Names.t

let none = Names.empty
let mem = Names.mem

let rec order_of (task : Core.platform_task) : (Execution.order, string) result =
  match task.plan with
  | None | Some (Maneuvers _) when not (Door.is_plain task.name) ->
    Error "the plan's name has control characters: vehicles would report another name"
  | None -> Ok { plan = task.name; specification = None }
  | Some (Maneuvers plan) -> Ok { plan = task.name; specification = Some (Plan_message.of_plan plan) }
  | Some (Rest r) -> order_of { task with plan = Some r.plan }
  | Some (Mission _) -> Error "IMC vehicles take no missions of items: describe the plan by imcPlan { ... }"

(* An order that is known to be over, or was certainly never sent, need not be halted. *)
let halt v request x =
  match Durable_note.knowledge ~plan:request.order.plan request.notes, request.doubt with
  | None, Never_sent | Some { over = true; _ }, _ -> Names.add v Nothing x
  | None, (Lost_note | Lost_note_of_repetition) | Some _, _ -> Names.add v (Halt request) x

(* As after an order to stop. *)
let linger x (v, (plan, request)) =
  let order = { Execution.plan; specification = None } in
  let notes : Durable_note.t list = [ Taken { request }; Asked { plan; request; before = None } ] in
  let request = { order; notes; doubt = Never_sent } in
  let is_over (r : request) =
    match Durable_note.knowledge ~plan:r.order.plan r.notes with None -> true | Some k -> k.over in
  match Names.find_opt v x with
  | None | Some Nothing -> Names.add v (Halt request) x
  | Some (Run ({ request = { notes = []; _ }; before; _ } as run)) when Option.fold before ~none:true ~some:is_over ->
    Names.add v (Run { run with before = Some request }) x
  | Some (Run _ | Halt _) -> x

let resume ~deadline ~lingering (outstanding : History.outstanding) =
  (* An impossible order was never sent. *)
  let request (c : History.commanded) =
    match order_of c.task with
    | Ok order ->
      let doubt : Execution.doubt = if c.is_again then Lost_note_of_repetition else Lost_note in
      Some { order; notes = List.filter_map Durable_note.of_json c.notes; doubt }
    | Error _ -> None
  in
  (* The end of the request before may have been noted during this one. *)
  let before (c : History.commanded) =
    let is_over = function Durable_note.Over _ -> true | Asked _ | Taken _ | Runs _ | May_run _ -> false in
    let later = Option.fold ~none:[] ~some:(fun r -> List.filter is_over r.notes) (request c) in
    let with_ends r = { r with notes = later @ r.notes } in
    Option.map with_ends (Option.bind c.before request)
  in
  let expect x (v, (c : History.commanded)) =
    match request c with
    | None -> Names.add v Nothing x
    | Some request when c.is_stopped -> halt v request x
    | Some request -> Names.add v (Run { request; before = before c; deadline = deadline v }) x
  in
  let bound = List.fold_left (fun x v -> Names.add v Nothing x) none outstanding.bound in
  List.fold_left linger (List.fold_left expect bound outstanding.tasks) lingering

let start ~deadline v order x =
  let before =
    match Names.find_opt v x with
    | None | Some Nothing -> None
    | Some (Halt request) -> Some request
    | Some (Run { request; before; _ }) -> if request.notes = [] then before else Some request
  in
  Names.add v (Run { request = { order; notes = []; doubt = Never_sent }; before; deadline }) x

let stop v x =
  match Names.find_opt v x with
  | Some (Run { request = { notes = []; _ }; before = Some before; _ }) -> halt v before x
  | Some (Run { request; _ }) -> halt v request x
  | Some (Nothing | Halt _) | None -> x

let stop_all x = Names.fold (fun v _ x -> stop v x) x x

let heard v x =
  let adopt ~stopped { order; notes; doubt } = Execution.Adopt { order; stopped; notes; doubt } in
  let inputs : Execution.input list =
    match Names.find_opt v x with
    | None | Some Nothing -> []
    | Some (Halt request) -> [ adopt ~stopped:true request ]
    | Some (Run { request = { notes = []; _ } as request; before = Some before; _ }) ->
      [ adopt ~stopped:true before; adopt ~stopped:false request ]
    | Some (Run { request; _ }) -> [ adopt ~stopped:false request ]
  in
  (inputs, Names.remove v x)

let postpone seconds x =
  let later = function
    | Run r -> Run { r with deadline = r.deadline +. seconds }
    | (Nothing | Halt _) as intent -> intent
  in
  Names.map later x

let give_up ~now x =
  let is_late = function Run { deadline; _ } -> deadline <= now | Nothing | Halt _ -> false in
  let late = Names.filter (fun _ intent -> is_late intent) x in
  let halt_late v intent x = match intent with Run { request; _ } -> halt v request x | Nothing | Halt _ -> x in
  let note (v, intent) =
    match intent with
    | Run { request; _ } ->
      let may_run (k : Durable_note.knowledge) =
        Durable_note.May_run { plan = request.order.plan; request = k.request } in
      (v, Option.map may_run (Durable_note.knowledge ~plan:request.order.plan request.notes))
    | Nothing | Halt _ -> (v, None)
  in
  (List.map note (Names.bindings late), Names.fold halt_late late x)

let due x =
  let earlier _ intent time =
    match intent with Run { deadline; _ } -> Float.min deadline time | Nothing | Halt _ -> time
  in
  Names.fold earlier x infinity

let halting v x =
  match Names.find_opt v x with Some (Halt { order; _ }) -> Some order.plan | Some (Nothing | Run _) | None -> None

let halts x =
  let add v intent found =
    match intent with Halt { order; _ } -> (v, order.plan) :: found | Nothing | Run _ -> found
  in
  Names.fold add x []
