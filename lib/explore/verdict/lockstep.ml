open Dolphin_semantics
open Dolphin_environment

type run = { steps : Transition.t list; cycle : Transition.t list }
type state = Configuration.t * Environment.t
type pair = { image : state; real : state; taken : Transition.t list (* latest first *) }

exception Out_of_step

let equal (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'

(* Transitions may differ only in the environment's memory, so there may be several ways; almost always there is one. *)
let step ~tick options world program ~image (t : Transition.t) pair =
  let choices program (c, e) = List.of_seq (Environment.choices_like t options program world e c) in
  let images = choices image pair.image and reals = choices program pair.real in
  if List.compare_lengths images reals <> 0 then raise_notrace Out_of_step;
  let follow ((t' : Transition.t), e) ((real : Transition.t), real_e) =
    tick ();
    if t'.rules = t.rules && Label.equal t'.label t.label && Configuration.equal t'.next t.next then begin
      if real.rules <> t.rules then raise_notrace Out_of_step;
      Some { image = (t'.next, e); real = (real.next, real_e); taken = real :: pair.taken }
    end
    else None
  in
  List.filter_map Fun.id (List.map2 follow images reals)

(* Of equal ones the first goes on. *)
let distinct pairs =
  let is_new kept p = not (List.exists (fun q -> equal p.image q.image) kept) in
  List.rev (List.fold_left (fun kept p -> if is_new kept p then p :: kept else kept) [] pairs)

let through ~tick options world program ~image steps pairs =
  let next pairs t = distinct (List.concat_map (step ~tick options world program ~image t) pairs) in
  List.fold_left next pairs steps

let start program image =
  { image = (Configuration.initial image, Environment.initial);
    real = (Configuration.initial program, Environment.initial); taken = [] }

let most_rounds = 2_000

let around ~tick options world program ~image cycle pair =
  let back p = equal p.image pair.image in
  let round p =
    let ends = through ~tick options world program ~image cycle [ { p with taken = [] } ] in
    Option.map (fun next -> (next, List.rev next.taken)) (List.find_opt back ends)
  in
  let same p q = equal p.real q.real in
  let found (before, cycle) = { steps = List.rev_append pair.taken before; cycle } in
  Option.map found (Rounds.closed ~most:most_rounds ~equal:same round pair)

let follow ~tick options world program ~image ~ends_alike run =
  match through ~tick options world program ~image run.steps [ start program image ], run.cycle with
  | exception Out_of_step -> None
  | [], _ -> None
  | pair :: _, [] -> (
      let found = { steps = List.rev pair.taken; cycle = [] } in
      match List.rev run.steps, pair.taken with
      | image :: _, real :: _ -> if ends_alike image real then Some found else None
      | [], _ | _, [] -> Some found)
  | pairs, cycle -> (
      match List.find_map (around ~tick options world program ~image cycle) pairs with
      | found -> found
      | exception Out_of_step -> None)
