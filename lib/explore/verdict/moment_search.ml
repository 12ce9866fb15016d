open Dolphin_semantics
open Dolphin_environment

type start = Configuration.t * Environment.t

(* {1 Moments} *)

(* Dates only grow. *)
let stays : World.assumption -> bool = function
  | Claim (text, holds) -> Sensor_comparison.is_kept_by_growth ~of_operand:"now()" (text, holds)
  | Late _ | Missing _ | Sensed _ | Placed _ -> false

let once_time_has_passed moment = List.sort_uniq World.compare_assumption (List.filter stays moment)

(* The other outcomes of a look. *)
let others world (a : World.assumption) : World.assumption list =
  let state v = World.find v world in
  let besides same = List.filter (fun x -> not (same x)) in
  match a with
  | Claim (text, holds) -> [ Claim (text, not holds) ]
  | Sensed (s, v, x) -> (
      match Option.bind (state v) (World.sensor world s) with
      | Some (One_of xs) ->
        let same y = Value.compare x y = 0 in
        List.map (fun y -> World.Sensed (s, v, y)) (besides same xs)
      | Some (Shows _ | Anything) | None -> [])
  | Placed (v, p) -> (
      match Option.map (World.position world) (state v) with
      | Some (One_of ps) ->
        let same q = Dolphin_geo.Position.compare p q = 0 in
        List.map (fun q -> World.Placed (v, q)) (besides same ps)
      | Some (Shows _ | Anything) | None -> [])
  | Late _ | Missing _ -> []

(* The moments that begin with [moment] and exclude each step that [c] can make by itself: looks that a step needs get
   another outcome, one by one. A step whose outcomes cannot be listed counts as excluded: more moments are tried then
   than there are. *)
let rec idle program world (c : Configuration.t) moment =
  let supposed = World.suppose moment world in
  let listed, _ = Transition.internal_listed program supposed c in
  let rec look steps =
    match steps () with
    | Seq.Nil -> `No_step
    | Seq.Cons ((t : Transition.t), rest) -> (
        match t.assumed with
        | [] -> `Step
        | a :: _ -> ( match look rest with `Step -> `Step | `No_step | `Look _ -> `Look a))
  in
  match look listed with
  | `No_step -> [ moment ]
  | `Step -> []
  | `Look a -> List.concat_map (fun a -> idle program world c (a :: moment)) (others supposed a)

(* The moments of [c] once time has passed without an event, which takes a moment that excludes all steps: of each, the
   comparisons of the date that stay true. *)
let after_wait program world (c : Configuration.t) moment =
  match c.control with
  | Waiting _ -> [ once_time_has_passed moment ]
  | Script _ | Ended _ -> []
  | Executing _ ->
    List.sort_uniq Looks.compare_moments (List.map once_time_has_passed (idle program world c moment))

(* The moments at which a step may come: an event when time has passed, any step once it has passed in vain. *)
let moments_before program world c moment (t : Transition.t) =
  let later = after_wait program world c moment in
  if Looks.is_event t then List.sort_uniq Looks.compare_moments (once_time_has_passed moment :: later)
  else moment :: later

(* {1 One run} *)

let agrees (program : Core.program) world c run =
  let concerns = Looks.at_one_moment program in
  let step (c, moments) (t : Transition.t) =
    let at moment = Looks.after concerns moment (Looks.of_transition t) in
    let from moment = List.concat_map at (moments_before program world c moment t) in
    (t.next, List.sort_uniq Looks.compare_moments (List.concat_map from moments))
  in
  let looks = List.exists (fun t -> Looks.is_look concerns (Looks.of_transition t)) run in
  (not looks) || snd (List.fold_left step (c, [ Looks.beginning ]) run) <> []

(* {1 All runs} *)

type found = { runs : (Property.t * Transition.t list) list; whole : bool }
type pair = { c : Configuration.t; outside : Environment.t; moment : Looks.moment }

module Table = Hashtbl.Make (struct
    type t = pair

    let equal a b =
      Environment.compare a.outside b.outside = 0
      && Looks.compare_moments a.moment b.moment = 0
      && Configuration.equal a.c b.c

    let hash p = Configuration.hash p.c + Environment.hash p.outside + (17 * List.length p.moment)
  end)

type t = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  concerns : Looks.concerns;
  conditions : Condition.t list;
  came_by : (pair * Transition.t) option Table.t;  (* the pair before, with the step, at the first arrival *)
  queue : pair Queue.t;
  mutable sought : Property.t list;
  mutable runs : (Property.t * Transition.t list) list;
}

let rec run_to t pair steps =
  match Table.find t.came_by pair with None -> steps | Some (before, step) -> run_to t before (step :: steps)

let note t property run =
  if List.mem property t.sought then begin
    t.runs <- (property, run ()) :: t.runs;
    t.sought <- List.filter (fun p -> p <> property) t.sought
  end

let choices t moment pair =
  let world = World.suppose moment t.world in
  List.of_seq (Environment.choices t.options t.program world pair.outside pair.c)

(* The steps at a pair, each with the moment before it. *)
let steps_of t pair =
  let at is_taken moment =
    let steps = List.filter (fun (step, _) -> is_taken step) (choices t moment pair) in
    List.map (fun (step, outside) -> (step, outside, moment)) steps
  in
  let is_own step = not (Looks.is_event step) in
  let later = after_wait t.program t.world pair.c pair.moment in
  (* If nothing need be known, all else is possible, too. *)
  let knows_nothing = function [] -> true | _ :: _ -> false in
  let each moments =
    if List.exists knows_nothing moments then [ Looks.beginning ] else List.sort_uniq Looks.compare_moments moments in
  List.concat_map (at is_own) (each (pair.moment :: later))
  @ List.concat_map (at Looks.is_event) (each (once_time_has_passed pair.moment :: later))

let judge t pair =
  let is_broken condition = Condition.eval t.program t.world condition pair.c = Fails in
  let of_condition condition =
    let property = Property.Invariant (Condition.to_string condition) in
    if List.mem property t.sought && is_broken condition then note t property (fun () -> run_to t pair [])
  in
  List.iter of_condition t.conditions;
  if List.mem Property.No_deadlock t.sought && not (Configuration.has_ended pair.c) then begin
    let choices = Environment.choices t.options t.program t.world pair.outside pair.c in
    if Environment.is_stuck t.options t.program pair.outside choices then
      note t No_deadlock (fun () -> run_to t pair [])
  end

let meet t ~limit origin pair =
  if not (Table.mem t.came_by pair) then begin
    if Table.length t.came_by >= limit then raise_notrace Exit;
    Table.add t.came_by pair origin;
    Queue.add pair t.queue;
    judge t pair
  end

let expand t ~limit pair =
  let go ((step : Transition.t), outside, moment) =
    let arrive moment = meet t ~limit (Some (pair, step)) { c = step.next; outside; moment } in
    let moments = Looks.after t.concerns moment (Looks.of_transition step) in
    if moments <> [] then
      Option.iter
        (fun property -> note t property (fun () -> run_to t pair [ step ]))
        (Property.broken_by_end t.program step.rules step.next);
    List.iter arrive moments
  in
  List.iter go (steps_of t pair)

let search ~tick ~limit ~conditions options program world (c, outside) sought =
  let t =
    { options; program; world; concerns = Looks.at_one_moment program; conditions; came_by = Table.create 1_000;
      queue = Queue.create (); sought; runs = [] }
  in
  let rec go () =
    match Queue.take_opt t.queue with
    | None -> true
    | Some _ when t.sought = [] -> true
    | Some pair ->
      tick ();
      expand t ~limit pair;
      go ()
  in
  let begin_at () = meet t ~limit None { c; outside; moment = Looks.beginning } in
  match begin_at (); go () with
  | whole -> { runs = t.runs; whole }
  | exception (Exit | Environment.Unclear _) -> { runs = t.runs; whole = false }
