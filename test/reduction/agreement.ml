open Dolphin_semantics
open Dolphin_explore

type t = { whole : int; reduced : int; broken : Property.t list }

let ( let* ) = Result.bind

(* {1 Runs} *)

(* Where a run may be after these transitions: each is offered, with the same label and the same result. *)
let follow options program world states steps =
  let step states (t : Transition.t) =
    let is_it ((t' : Transition.t), _) =
      t'.rules = t.rules
      && Format.asprintf "%a" Label.pp t'.label = Format.asprintf "%a" Label.pp t.label
      && Configuration.equal t'.next t.next
    in
    let offered (c, e) = List.filter is_it (Environment.choices options program world e c) in
    List.concat_map (fun state -> List.map (fun ((t : Transition.t), e) -> (t.next, e)) (offered state)) states
  in
  List.fold_left step states steps

let same (c, e) (c', e') = Configuration.equal c c' && Environment.compare e e' = 0

let shows options program world property (run : Search.run) =
  let start = [ (Configuration.initial program, Environment.initial) ] in
  let there = follow options program world start run.steps in
  let stuck (c, e) =
    Environment.choices options program world e c = []
    && match c.Configuration.control with Ended _ -> false | Script _ | Waiting _ | Executing _ -> true
  in
  match (property : Property.t) with
  | No_deadlock -> List.exists stuck there
  | Termination ->
    let back = follow options program world there run.cycle in
    run.cycle <> [] && List.exists (fun s -> List.exists (same s) back) there
  | No_error | Assertions | Vehicles | No_halt | No_leftover -> (
      match List.rev run.steps with
      | [] -> false
      | last :: _ -> there <> [] && Property.broken_by_end last.rules last.next = Some property)
  | All_reached | Invariant _ | Formula _ -> false

(* {1 Verdicts} *)

let agrees options program world reference unreached (property, verdict) =
  let wrong what = Error (Printf.sprintf "%s: %s" (Property.name property) what) in
  match (verdict : Search.verdict), List.mem_assoc property reference with
  | Holds, false when property <> All_reached || unreached = [] -> Ok ()
  | Unreached pieces, _ when pieces = unreached -> Ok ()
  | Violated run, true -> if shows options program world property run then Ok () else wrong "this is no such run"
  | (Holds | Violated _), _ -> wrong "another verdict"
  | Unreached _, _ -> wrong "other pieces are reached"
  | Inconclusive _, _ -> wrong "inconclusive"

let check ?limit ?(reductions = [ Reduction.Partial_order; Symmetry; All ]) environment program world =
  match Reference.explore ?limit environment program world with
  | None | (exception Reading.Unsettled _) -> Ok None
  | Some graph ->
    let reference = Reference.broken graph in
    let search reduction = Search.run { Search.default with environment; reduction; search_again = 0 } program world in
    let whole = search Whole in
    let unreached =
      match List.assoc Property.All_reached whole.verdicts with
      | Unreached pieces -> pieces
      | Holds | Violated _ | Inconclusive _ -> []
    in
    let is_as_short (property, verdict) =
      match (verdict : Search.verdict), List.assoc_opt property reference with
      | Violated { shortest = true; steps; cycle = [] }, Some length -> List.length steps = length
      | _, _ -> true
    in
    let compare found reduction =
      let* _ = found in
      let named what = Error (String.concat ", " (Reduction.names reduction) ^ ": " ^ what) in
      let reduced = search reduction in
      let each found verdict =
        let* () = found in
        if is_as_short verdict then agrees environment program world reference unreached verdict
        else Error "there is a shorter run"
      in
      match List.fold_left each (Ok ()) reduced.verdicts with
      | Error what -> named what
      | Ok () -> if reduced.states > whole.states then named "more states than there are" else Ok reduced.states
    in
    let* reduced = List.fold_left compare (Ok 0) reductions in
    Ok (Some { whole = whole.states; reduced; broken = List.map fst reference })
