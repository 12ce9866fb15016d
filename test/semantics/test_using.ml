open Dolphin_semantics
open Test_support
module Gen = QCheck2.Gen
module Ast = Generate.Ast

(* Tasks with [using lock: _] at any place, inside of cuts, handlers and rounds; nothing else touches this key. *)

let lock = "lock"
let pair x : Ast.argument = Named ({ it = lock; at = Dolphin_syntax.Location.none }, x)

let using t =
  let taken = Generate.code [ Generate.statement (Generate.call "consume" [ pair (Generate.expression Wildcard) ]) ] in
  let back = Generate.code [ Generate.statement (Generate.call "giveBack" []) ] in
  Generate.expression (Wait_for (taken, Generate.expression (Ensure (t, back))))

let failing = Gen.oneofl [ Ast.Completes; Ast.Fails ]

let rec task vehicles depth =
  let open Gen in
  let part () = task vehicles (depth - 1) in
  let split () =
    match vehicles with
    | first :: (_ :: _ as others) ->
      map2 (Generate.binary Parallel) (task [ first ] (depth - 1)) (task others (depth - 1))
    | [] | [ _ ] -> map2 (Generate.binary Parallel) (task vehicles (depth - 1)) (task [] (depth - 1))
  in
  if depth = 0 then Generate.task ~vehicles ~depth:1
  else
    let* shape =
      frequencyl
        [ (5, `Using); (2, `Until); (2, `During); (3, `Watch); (2, `Sequence); (3, `Parallel); (1, `Twice) ]
    in
    match shape with
    | `Using -> map using (part ())
    | `Until -> map3 (fun e g t -> Generate.expression (Until (e, g, t))) failing Generate.guard (part ())
    | `During ->
      let seconds = Generate.expression (Integer 5) in
      map2 (fun e t -> Generate.expression (During (e, seconds, t))) failing (part ())
    | `Watch ->
      let handler name = Generate.code [ Generate.statement (Generate.call name []) ] in
      map2 (fun t name -> Generate.expression (Watch (t, handler name))) (part ()) (oneofl [ "ignore"; "propagate"; "retry" ])
    | `Sequence -> map2 (Generate.binary Sequence) (part ()) (part ())
    | `Parallel -> split ()
    | `Twice ->
      let two = Some (Generate.expression (Integer 2)) in
      map (fun body -> Generate.expression (Repeat { rounds = two; body; until = None })) (part ())

let post x = Generate.statement (Generate.call "post" [ pair (Generate.expression (Integer x)) ])
let program = Gen.map (Generate.executing ~before:[ post 1; post 2 ]) (task Generate.vehicles 3)

(* {1 The invariant} *)

let is_lock (k, _) = String.equal k lock
let text (_, x) = Value.to_string x

(* The locks that tasks have, and will give back. *)
let taken (c : Configuration.t) =
  let given : Core.ensured -> _ = function Pair (k, x) -> Some (k, x) | Variable _ | Taken -> None in
  match c.control with
  | Executing (_, r) -> List.filter is_lock (List.filter_map given (Residual.ensured r))
  | Script _ | Waiting _ | Ended _ -> []

let there (c : Configuration.t) = List.map (fun x -> (lock, x)) (Tuples.values lock c.shared.tuples)

(* The program that halts leaves everything as it is. *)
let is_stopped (c : Configuration.t) (rules : Rule.t list) =
  match c.control with
  | Ended (Halted _) -> true
  | Ended (Failed _) -> List.mem Rule.Assert_err rules
  | Ended (Completed | Interrupted) | Script _ | Waiting _ | Executing _ -> false

let met = Hashtbl.create 8

let neither_lost_nor_doubled (s : Walk.step) =
  let all c = List.sort String.compare (List.map text (taken c @ there c)) in
  let next = s.transition.next in
  if Property.is_usual () && List.compare_lengths (taken next) (taken s.before) < 0 then
    List.iter (fun r -> Hashtbl.replace met r ()) s.transition.rules;
  all s.before <> [ "1"; "2" ] || all next = [ "1"; "2" ]
  || is_stopped next s.transition.rules
  || QCheck2.Test.fail_reportf "%a (%s): the locks are %s" Label.pp s.transition.label (Pure_run.rules s.transition)
    (String.concat ", " (all next))

let print (program, _) = Generate.print program

let conserved =
  Property.case ~count:3_000 "using neither loses nor doubles a pair" ~print (Gen.pair program Walk.choices)
    (fun (program, choices) ->
       List.for_all neither_lost_nor_doubled (Walk.run ~choices (Generate.compile program) Generate.world))

(* The walks end tasks that have a lock in each of these ways. *)
let every_end () =
  let all =
    [ Rule.Ensure_2; Ensure_err; Par_err; Until_cut; Assure_cut; During_cut; Within_cut; Watch_ignore; Interrupt ]
  in
  let missing = List.filter (fun r -> not (Hashtbl.mem met r)) all in
  Alcotest.(check (list string)) "ends with a lock that no walk met" [] (List.map Rule.name missing)

let () =
  Alcotest.run "using" [ ("pairs", [ conserved; Alcotest.test_case "every end was met" `Quick every_end ]) ]
