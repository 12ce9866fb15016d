open Dolphin_semantics
open Dolphin_runtime

type ending = Completed | Halted of string | Failed of Fault.t | Stuck of Core.site option
type task = { name : string; vehicle : Core.vehicle; site : Core.site }
type counts = { began : int; ended : int; failed : int; stopped : int }

type t = {
  seconds : float;
  ending : ending;
  tasks : (task * counts) list;
  handlers : (Core.site * int) list;
}

(* {1 Handlers} *)

(* How many handlers ran: each leaves its rule in the derivation. An assertion that breaks is the axiom if it stands in
   a task, and follows other rules if it stands in a handler. *)
let handlings (rules : Rule.t list) =
  let is_handling i : Rule.t -> bool = function
    | Watch_ignore | Watch_propagate | Watch_halt | Watch_retry | Watch_instead -> true
    | Assert_err -> i > 0
    | _ -> false
  in
  List.length (List.filter Fun.id (List.mapi is_handling rules))

let makes program world (c : Configuration.t) event (t : Transition.t) machine r step =
  let local =
    match event with
    | Some event -> Local_step.on_event program world c.shared step event
    | None -> Local_step.internal program world c.shared step
  in
  match local with
  | Decision.Decided (Some local) ->
    let made = Local_step.conclude machine r local in
    made.rules = t.rules && Label.equal made.label t.label && Configuration.equal made.next t.next
  | Decided None | Open _ | Unclear _ -> false

let handlers program world (c : Configuration.t) event (t : Transition.t) =
  match c.control, handlings t.rules with
  | Executing (machine, r), n when n > 0 -> (
      let watches (Task_rules.Step { around; _ }) =
        let site : Residual.surrounding -> Core.site option = function
          | Inside (In_watch handler) -> Some handler.code.lambda.lambda_site
          | Inside _ | Beside _ | Around _ -> None
        in
        List.filteri (fun i _ -> i < n) (List.rev (List.filter_map site around))
      in
      match Seq.filter (makes program world c event t machine r) (Task_rules.steps r) () with
      | Seq.Cons (step, _) -> watches step
      | Seq.Nil -> [])
  | (Executing _ | Script _ | Waiting _ | Ended _), _ -> []

(* {1 What is seen of a run} *)

type seen = {
  program : Core.program;
  mutable world : World.t;
  mutable configuration : Configuration.t;
  mutable time : float;
  mutable tasks : (task * counts) list;  (* the latest first *)
  mutable handled : (Core.site * int) list;
}

let none = { began = 0; ended = 0; failed = 0; stopped = 0 }

(* With [f] of the value of [key], at its place or in front. *)
let update key start f xs =
  if List.mem_assoc key xs then List.map (fun (k, x) -> if k = key then (k, f x) else (k, x)) xs
  else (key, f start) :: xs

let count seen v (p : Core.platform_task) f =
  seen.tasks <- update { name = p.name; vehicle = v; site = p.task_site } none f seen.tasks

let see_transition seen ~time ~cause (t : Transition.t) =
  let { Configuration.shared; _ } = seen.configuration in
  let running v f = Option.iter (fun p -> count seen v p f) (Vehicle_map.find_opt v shared.allocation) in
  let carry : Effect.t -> unit = function
    | Start (v, p) -> count seen v p (fun n -> { n with began = n.began + 1 })
    | Stop v -> running v (fun n -> { n with stopped = n.stopped + 1 })
    | _ -> ()
  in
  (match t.label with
   | Done (v, _) -> running v (fun n -> { n with ended = n.ended + 1 })
   | Fail (v, _, _) -> running v (fun n -> { n with failed = n.failed + 1 })
   | _ -> ());
  List.iter carry t.effects;
  List.iter
    (fun site -> seen.handled <- update site 0 succ seen.handled)
    (handlers seen.program seen.world seen.configuration cause t);
  seen.time <- time;
  seen.configuration <- t.next

let observer seen : Observer.t =
  { transition = see_transition seen;
    news = (fun ~time:_ state -> seen.world <- World.add state seen.world);
    unknown = (fun ~time:_ _ -> ()) }

let ending : Driver.outcome -> ending option = function
  | Ended Completed -> Some Completed
  | Ended (Halted message) -> Some (Halted message)
  | Ended (Failed fault) -> Some (Failed fault)
  | Ended Interrupted -> None
  | Stuck _ -> Some (Stuck None)
  | Spins site -> Some (Stuck (Some site))

let run ~seed ~answers (program : Program_file.t) (fleet : Fleet_file.t) =
  let seen =
    { program = program.program; world = World.nobody Dolphin_platform_sim.Simulator.Virtual.order;
      configuration = Configuration.initial program.program; time = 0.; tasks = []; handled = [] }
  in
  let front = { Run.unattended with observer = observer seen } in
  let settings = { Run.simulated with seed = Some seed; answers } in
  let of_outcome outcome =
    match ending outcome with
    | Some ending ->
      Ok { seconds = seen.time; ending; tasks = List.rev seen.tasks; handlers = List.rev seen.handled }
    | None -> Error (Error.Inconclusive "the run was interrupted")
  in
  Result.bind (Lwt_main.run (Run.start front ~interruption:(Interruption.make ()) settings program fleet)) of_outcome
