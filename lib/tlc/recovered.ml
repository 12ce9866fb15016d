open Dolphin_semantics
module Labelled = Dolphin_explore.Labelled

type run = { steps : Transition.t list; cycle : Transition.t list }

type trouble =
  | No_label of int
  | No_such_run of { after : string list; label : string }
  | Does_not_return of string list

let ( let* ) = Result.bind

let labels (c : Outcome.counter_example) =
  let rec all n = function
    | [] -> Ok []
    | (step : Outcome.step) :: rest -> (
        match Option.bind (Tlc_message.variable "label" step.state) Quoted.unescape with
        | None -> Error (No_label n)
        | Some label -> Result.map (fun rest -> label :: rest) (all (n + 1) rest))
  in
  all 1 c.steps

(* The first [n] of a list, and the rest. *)
let rec split n = function
  | x :: rest when n > 0 ->
    let first, rest = split (n - 1) rest in
    (x :: first, rest)
  | rest -> ([], rest)

(* How far the semantics can go along [labels]. *)
let missing follow start labels =
  let rec go n =
    match split n labels with
    | after, label :: _ when follow start after <> [] && follow start (after @ [ label ]) = [] ->
      No_such_run { after; label }
    | _, _ :: _ -> go (n + 1)
    | after, [] -> Does_not_return after
  in
  go 0

let run options program world ~broken (c : Outcome.counter_example) =
  let follow = Labelled.follow options program world and start = Labelled.start program in
  let* labels = labels c in
  let* () = if follow start labels = [] then Error (missing follow start labels) else Ok () in
  match c.repetition with
  | Once | Stays ->
    let runs = follow start labels in
    let wanted (state, steps) = broken state steps in
    let _, steps = Option.value (List.find_opt wanted runs) ~default:(List.hd runs) in
    Ok { steps; cycle = [] }
  | Back_to n -> (
      let before, around = split n labels in
      let close (there, steps) =
        List.find_map
          (fun (last, cycle) ->
             Option.map
               (fun t -> { steps; cycle = cycle @ [ t ] })
               (Labelled.back options program world last there))
          (follow there around)
      in
      match List.find_map close (follow start before) with
      | Some run -> Ok run
      | None -> Error (Does_not_return around))

let pp_labels ppf = function
  | [] -> Fmt.string ppf "nothing"
  | labels -> Fmt.(list ~sep:(any ", ") string) ppf labels

let pp_trouble ppf = function
  | No_label n -> Fmt.pf ppf "the state after step %d has no label" n
  | No_such_run { after; label } -> Fmt.pf ppf "after %a, the explorer cannot do %s" pp_labels after label
  | Does_not_return around -> 
    Fmt.pf ppf "%a: the explorer does not return to the beginning of this cycle" pp_labels around
