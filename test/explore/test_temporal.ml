(* Formulas say of random programs what the built-in properties say; and runs that are shown are runs. *)

open Dolphin_syntax
open Dolphin_explore
module Generate = Test_support.Generate
module Property = Dolphin_explore.Property

let for_ever (program : Ast.program) =
  let comes_first (s : Ast.statement) =
    match s.it with Assign { value = { it = Builder _ | Integer _; _ }; _ } -> true | _ -> false
  in
  let first, rest = List.partition comes_first program in
  first @ [ { it = Ast.While (Generate.expression (Boolean true), rest); at = Location.none } ]

let case =
  let open QCheck2.Gen in
  triple Generate.program (frequencyl [ (2, false); (1, true) ]) bool

let print (program, looped, failing) =
  Printf.sprintf "%s, %s:\n%s" (if failing then "failing" else "as planned") (if looped then "for ever" else "once")
    (Generate.print program)

(* Each formula holds exactly if none of the properties is violated. *)
let agreements : (string * Property.t list) list =
  [ ("F ended", [ No_deadlock; Termination ]);
    ("G (ended -> G ended)", []);
    ("G !error", [ No_error; Vehicles; Assertions ]);
    ("G !halt", [ No_halt ]);
    ("(F ended) & G !(error | halt)", [ No_deadlock; Termination; No_error; Vehicles; Assertions; No_halt ]);
    ("F G ended", [ No_deadlock; Termination ]);
    ("G (start -> !{running('p') && running('q')} | running(p))", []);
    ("!done W start", []); ("!done(p) W start(p)", []); ("!(start | done) W bind", []) ]

let is_violated (o : Search.outcome) property =
  match List.assoc property o.verdicts with Search.Violated _ -> true | Holds | Unreached _ | Inconclusive _ -> false

(* Each transition leads on from where the one before led to. *)
let is_connected program options (run : Search.run) =
  let step states (t : Dolphin_semantics.Transition.t) =
    let leads ((t' : Dolphin_semantics.Transition.t), e) =
      if Dolphin_semantics.Configuration.equal t'.next t.next then Some (t'.next, e) else None
    in
    List.concat_map
      (fun (c, e) -> List.filter_map leads (Environment.choices options program Generate.world e c))
      states
  in
  let start = [ (Dolphin_semantics.Configuration.initial program, Environment.initial) ] in
  let there = List.fold_left step start run.steps in
  let back = List.fold_left step there run.cycle in
  let same (c, _) (c', _) = Dolphin_semantics.Configuration.equal c c' in
  there <> [] && List.exists (fun s -> List.exists (same s) back) there

let agrees (ast, looped, failing) =
  let program = Generate.compile (if looped then for_ever ast else ast) in
  let environment = if failing then Environment.failing Environment.default else Environment.default in
  let read text = match Temporal.of_string program text with Ok f -> f | Error why -> failwith why in
  let options = { Search.default with environment; max_states = Some 3_000 } in
  let o =
    Search.run { options with formulas = List.map (fun (text, _) -> read text) agreements } program Generate.world
  in
  let agree (text, properties) =
    match List.assoc (Property.Formula text) o.verdicts with
    | Inconclusive _ -> true
    | Holds -> not (List.exists (is_violated o) properties)
    | Violated run -> List.exists (is_violated o) properties && is_connected program environment run
    | Unreached _ -> false
  in
  List.for_all (fun a -> agree a || QCheck2.Test.fail_reportf "%s" (fst a)) agreements

let () =
  Alcotest.run "temporal"
    [ ( "random programs",
        [ Test_support.Property.case "formulas and properties agree" ~count:300 case ~print agrees ] ) ]
