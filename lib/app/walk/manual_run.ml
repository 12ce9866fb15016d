open Dolphin_semantics
open Dolphin_environment
module Witness = Dolphin_trace.Witness

type world = { program : Core.program; world : World.t; options : Environment.options }
type choice = Transition.t * Environment.t
type state = { configuration : Configuration.t; outside : Environment.t }

(* [past] has each state with the step that was taken there, the latest first. *)
type t = { world : world; past : (state * choice) list; now : state; ahead : choice list }

let initial world = { configuration = Configuration.initial world.program; outside = Environment.initial }
let start world = { world; past = []; now = initial world; ahead = [] }
let configuration r = r.now.configuration
let outside r = r.now.outside
let length r = List.length r.past
let ahead r = r.ahead
let steps r = List.rev_map (fun (_, (t, _)) -> t) r.past

let choices_of { program; world; options } state =
  Environment.choices options program world state.outside state.configuration

let choices r = choices_of r.world r.now

let is_stuck r = Environment.is_stuck r.world.options r.world.program r.now.outside (choices r)

(* {1 Moves} *)

let after ((t : Transition.t), outside) = { configuration = t.next; outside }
let is_step (t : Transition.t) (t' : Transition.t) = Label.equal t.label t'.label && Configuration.equal t.next t'.next

let assumes (t : Transition.t) assumed = List.compare World.compare_assumption t.assumed assumed = 0

let same ((t : Transition.t), e) ((t' : Transition.t), e') =
  is_step t t' && assumes t t'.assumed && Environment.compare e e' = 0

let is_next r choice = match r.ahead with next :: _ -> same next choice | [] -> false

let take choice r =
  let ahead = if is_next r choice then List.tl r.ahead else [] in
  { r with past = (r.now, choice) :: r.past; now = after choice; ahead }

let undo r =
  match r.past with
  | [] -> None
  | (now, choice) :: past -> Some { r with past; now; ahead = choice :: r.ahead }

let next r = match r.ahead with [] -> None | choice :: _ -> Some (take choice r)

let rec goto n r =
  let there = length r in
  if n = there then Some r else Option.bind (if n < there then undo r else next r) (goto n)

(* {1 Recorded runs} *)

(* The choice that [t] is, under the same assumptions if there is one: the outside may have fewer. *)
let choice_of world state (t : Transition.t) =
  let find p = Environment.find p (choices_of world state) in
  match find (fun ((t' : Transition.t), _) -> is_step t t' && assumes t t'.assumed) with
  | Some _ as choice -> choice
  | None -> find (fun (t', _) -> is_step t t')

let misfit number why = Error (Printf.sprintf "step %d cannot be taken: %s" number why)

let rec find_choices world state number = function
  | [] -> Ok []
  | (t : Transition.t) :: rest -> (
      match choice_of world state t with
      | Some choice ->
        Result.map (List.cons choice) (find_choices world (after choice) (number + 1) rest)
      | None ->
        misfit number
          (Format.asprintf "%a does not happen in this world; its --faults and answers may be other ones" Label.pp
             t.label)
      | exception Environment.Unclear fault -> misfit number fault.message)

let recorded witness r =
  match Witness.follow r.world.program r.world.world witness with
  | Error (_, { number; why }) -> misfit number why
  | Ok (steps, cycle) ->
    let start = start r.world in
    Result.map (fun ahead -> { start with ahead }) (find_choices r.world start.now 1 (steps @ cycle))
