open Dolphin_semantics

type context = { options : Environment.options; program : Core.program; world : World.t; space : Space.t }

let choices x (c, outside) = Environment.choices x.options x.program x.world outside c

let take x state leads ~from ~into =
  match List.find_opt leads (choices x state) with
  | Some choice -> choice
  | None -> Fmt.invalid_arg "Replay.between: no transition from state %d to state %d" from into

let is_state (c, outside) ((t : Transition.t), e) = Environment.compare e outside = 0 && Configuration.equal t.next c

(* {1 Through states that stand for others}

   Of what stands for others, the first state of the task and the script after it are fixed: the permutations in between
   are found from the end. *)

let permutation x i j =
  match List.assoc_opt j (Space.steps x.space i) with
  | Some permutation -> permutation
  | None -> Fmt.invalid_arg "Replay.permutation: no step from state %d to state %d" i j

(* The permutation of each of [states], which follow each other in the task; [last] is that of the last one. *)
let rec permutations x last = function
  | [] -> []
  | [ i ] -> [ (i, last) ]
  | i :: (j :: _ as rest) -> (
      match permutations x last rest, permutation x i j with
      | ((_, p) :: _ as found), Some q -> (i, Symmetry.compose p q) :: found
      | _, _ -> Fmt.invalid_arg "Replay.permutations: state %d" i)

(* The states of [states] in the task that the first one is of, with the symmetry, and those after. *)
let rec task x = function
  | i :: rest -> (
      match Space.view x.space i with
      | Up_to (g, state) ->
        let states, _, after = task x rest in
        ((i, state) :: states, Some g, after)
      | Exact _ -> ([], None, i :: rest))
  | [] -> ([], None, [])

let follow x g start ~from states after =
  let numbers = List.map fst states in
  let final = List.nth numbers (List.length numbers - 1) in
  let last =
    match after with
    | w :: _ -> Option.value (permutation x final w) ~default:(Symmetry.identity g)
    | [] -> Symmetry.identity g
  in
  let step (state, from, found) ((i, folded), (_, p)) =
    let wanted = Symmetry.apply g p folded in
    let leads ((t : Transition.t), e) = Space.folded x.space g t.next e = Some wanted in
    let (t, e) = take x state leads ~from ~into:i in
    ((t.next, e), i, t :: found)
  in
  let state, last, found =
    List.fold_left step (start, from, []) (List.combine states (permutations x last numbers))
  in
  (state, last, List.rev found)

(* {1 Runs} *)

(* An end by an error may have another text than that of the state that stands for it. *)
let ends_as x i state =
  let like ((t : Transition.t), _) =
    Property.broken_by_end t.rules t.next = Space.breaks x.space i
    && match t.next.control with Ended _ -> true | Script _ | Waiting _ | Executing _ -> false
  in
  List.find_opt like (choices x state)

let between options program world space states =
  let x = { options; program; world; space } in
  let rec go state from = function
    | [] -> []
    | i :: rest as states -> (
        match Space.view space i with
        | Exact (c, outside) ->
          let is_it = is_state (c, outside) in
          let t, e =
            match List.find_opt is_it (choices x state), ends_as x i state with
            | Some choice, _ | None, Some choice -> choice
            | None, None -> take x state is_it ~from ~into:i
          in
          t :: go (t.next, e) i rest
        | Up_to _ -> (
            match task x states with
            | inside, Some g, after ->
              let state, last, found = follow x g state ~from inside after in
              found @ go state last after
            | _, None, _ -> invalid_arg "Replay.between"))
  in
  match states with
  | [] -> []
  | i :: rest -> (
      match Space.view space i with
      | Exact (c, outside) -> go (c, outside) i rest
      | Up_to _ -> invalid_arg "Replay.between: a run that starts inside of a task")

let shortest space i =
  let rec back i states = if i = 0 then 0 :: states else back (Space.parent space i) (i :: states) in
  back i []
