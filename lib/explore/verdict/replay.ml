open Dolphin_semantics
open Dolphin_environment

let choices space (c, outside) = Space.choices space outside c

let take space state leads ~from ~into =
  match List.find_opt leads (choices space state) with
  | Some choice -> choice
  | None -> Fmt.invalid_arg "Replay: no transition from state %d to state %d" from into

let equal (c, outside) (c', outside') = Environment.compare outside outside' = 0 && Configuration.equal c c'

(* {1 Through states that stand for others}

   Of what stands for others in a task, the first state of the task and the script after it are fixed: the permutations
   in between are found from the end. *)

let permutation space i j =
  match List.assoc_opt j (Space.steps space i) with
  | Some permutation -> permutation
  | None -> Fmt.invalid_arg "Replay.permutation: no step from state %d to state %d" i j

(* The permutation of each of [states], which follow each other in the task; [last] is that of the last one. *)
let rec permutations space last = function
  | [] -> []
  | [ i ] -> [ (i, last) ]
  | i :: (j :: _ as rest) -> (
      match permutations space last rest, permutation space i j with
      | ((_, p) :: _ as found), Some q -> (i, Task_group.compose p q) :: found
      | _, _ -> Fmt.invalid_arg "Replay.permutations: state %d" i)

(* The states of [states] in the task that the first one is of, with the symmetry, and those after. *)
let rec task space = function
  | i :: rest -> (
      match Space.view space i with
      | Up_to (g, state) ->
        let states, _, after = task space rest in
        ((i, state) :: states, Some g, after)
      | Exact _ -> ([], None, i :: rest))
  | [] -> ([], None, [])

let follow space g start ~from states after =
  let numbers = List.map fst states in
  let final = List.nth numbers (List.length numbers - 1) in
  let last =
    match after with
    | w :: _ -> Option.value (permutation space final w) ~default:(Task_group.identity g)
    | [] -> Task_group.identity g
  in
  let step (state, from, found) ((i, representative), (_, p)) =
    let wanted = Task_group.apply g p representative in
    let leads ((t : Transition.t), e) = Space.quotient_state space g t.next e = Some wanted in
    let (t, e) = take space state leads ~from ~into:i in
    ((t.next, e), i, (t, e) :: found)
  in
  let state, last, found =
    List.fold_left step (start, from, []) (List.combine states (permutations space last numbers))
  in
  (state, last, List.rev found)

(* {1 In the names of the space} *)

let is_end (c : Configuration.t) =
  match c.control with Ended _ -> true | Script _ | Waiting _ | Executing _ -> false

(* An end by an error may have another text than that of the state that stands for it. *)
let ends_in_same_way property ((t : Transition.t), _) = Property.broken_by_end t.rules t.next = property && is_end t.next

let leads_to space i state =
  let is_it ((t : Transition.t), e) = equal (t.next, e) state || equal (Space.canonical space t.next e) state in
  fun found ->
    match List.find_opt is_it found with
    | Some choice -> Some choice
    | None -> List.find_opt (ends_in_same_way (Space.breaks space i)) found

(* Transitions from state to state, each from where the one before led to, or from what stands for that. The result is
   latest first. *)
let in_names_of space states =
  let rec go state from found = function
    | [] -> found
    | i :: rest as states -> (
        match Space.view space i with
        | Exact (c, outside) -> (
            match leads_to space i (c, outside) (choices space state) with
            | Some choice -> go (c, outside) i (choice :: found) rest
            | None -> Fmt.invalid_arg "Replay: no transition from state %d to state %d" from i)
        | Up_to _ -> (
            match task space states with
            | inside, Some g, after ->
              let state, last, inside = follow space g state ~from inside after in
              go state last (List.rev_append inside found) after
            | _, None, _ -> invalid_arg "Replay.in_names_of"))
  in
  match states with
  | [] -> []
  | i :: rest -> (
      match Space.view space i with
      | Exact (c, outside) -> List.rev (go (c, outside) i [] rest)
      | Up_to _ -> invalid_arg "Replay: a run that starts inside of a task")

(* {1 Runs} *)

(* The transitions that are the like of others, from [state] on, and where they lead. *)
let real space state images =
  let step (state, found) (((image : Transition.t), e) as choice) =
    let t, e =
      if not (Space.has_vehicle_symmetry space) then choice
      else
        let wanted = Space.canonical space image.next e in
        let is_it ((t : Transition.t), e) = equal (Space.canonical space t.next e) wanted in
        let offered = choices space state in
        match List.find_opt is_it offered with
        | Some choice -> choice
        | None -> (
            match List.find_opt (ends_in_same_way (Property.broken_by_end image.rules image.next)) offered with
            | Some choice when is_end image.next -> choice
            | Some _ | None -> invalid_arg "Replay: a configuration of the orbit has no such transition")
    in
    ((t.next, e), t :: found)
  in
  let state, found = List.fold_left step (state, []) images in
  (state, List.rev found)

let from_start space states =
  match Space.view space 0 with
  | Exact (c, outside) -> real space (c, outside) (in_names_of space states)
  | Up_to _ -> invalid_arg "Replay: a run that starts inside of a task"

let through space states = snd (from_start space states)

let around space ~stem states =
  let state, stem = from_start space stem in
  let images = in_names_of space states in
  (* Until it is where it was after some round: [rounds] has where they began, latest first. *)
  let rec go state rounds =
    let next, steps = real space state images in
    let rounds = (state, steps) :: rounds in
    if List.exists (fun (before, _) -> equal before next) rounds then (next, List.rev rounds) else go next rounds
  in
  let back, rounds = go state [] in
  let rec divide before = function
    | (state, _) :: _ as cycle when equal state back -> (List.rev before, cycle)
    | round :: rest -> divide (round :: before) rest
    | [] -> invalid_arg "Replay.around"
  in
  let before, cycle = divide [] rounds in
  (stem @ List.concat_map snd before, List.concat_map snd cycle)

let shortest space i =
  let rec back i states = if i = 0 then 0 :: states else back (Space.parent space i) (i :: states) in
  back i []
