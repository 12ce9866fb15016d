open Dolphin_syntax
open Dolphin_semantics
module Environment = Dolphin_environment.Environment
module Faults = Dolphin_environment.Faults
module Scenario_world = Dolphin_environment.Scenario_world
module Generate = Test_support.Generate
module Calls = Test_support.Calls
module Scenario = Dolphin_scenario.Scenario

type t = {
  name : string;
  source : string;
  program : Core.program;
  world : World.t;
  environment : Environment.options;
  plans : string list;
  prompts : string list;
  calls : string list;
}

(* {1 Random programs} *)

let answering = Calls.answering

let with_losses losses = { answering with faults = { Faults.none with loss = losses } }
let with_latecomers latecomers = { answering with faults = { Faults.none with join = latecomers } }

let all_once =
  { answering with faults = { Faults.none with fail = At_most 1; loss = At_most 1; join = At_most 1 } }

let interrupted (environment : Environment.options) =
  { environment with faults = { environment.faults with interrupt = true } }

let environments =
  [ ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with losses", with_losses Any_number);
    ("with a loss", with_losses (At_most 1));
    ("with latecomers", with_latecomers Any_number);
    ("with all faults once", all_once);
    ("with inputs", { answering with inputs = Test_support.Posts.inputs });
    ("with interruptions", interrupted answering) ]

let of_generated name world environment ast =
  let program = Test_support.Posts.declared environment (Generate.compile ast) in
  { name; source = Generate.print ast; program; world; environment; plans = [];
    prompts = [ "how many?" ]; calls = Calls.names }

let generated title programs world ~seed n =
  let rand = Random.State.make [| seed |] in
  let one i =
    let calling = i mod 3 = 2 in
    let ast = QCheck2.Gen.generate1 ~rand (if calling then Calls.within programs else programs) in
    let looped = QCheck2.Gen.(generate1 ~rand (frequencyl [ (3, false); (1, true) ])) in
    let kind, environment = List.nth environments (i mod List.length environments) in
    let also is_so what = if is_so then ", " ^ what else "" in
    let name =
      Printf.sprintf "%s %d, %s%s%s" title (i + 1) kind (also calling "with calls") (also looped "for ever")
    in
    of_generated name world environment (if looped then Generate.for_ever ast else ast)
  in
  List.init n one

(* TLC computes no rests. *)
let random = generated "random" (Generate.without_rests Generate.program) Generate.world
let sensing = generated "with sensors" (Generate.without_rests Generate.sensing_program) Generate.open_world

(* {1 Examples} *)

let read path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let compiled ?place path source =
  let explain ds = Format.asprintf "%a" (Fmt.list (Diagnostic.pp ~source)) ds in
  let result =
    Result.bind (Test_support.Pure_run.read ~file:path source) (Elaborate.program_at ~place ~source_name:path)
  in
  match result with Ok (program, _) -> program | Error ds -> failwith (explain ds)

let scenario_beside path =
  let fleet = Scenario.beside path in
  if not (Sys.file_exists fleet) then Scenario.default
  else
    match Scenario.read ~file:fleet (read fleet) with
    | Ok scenario -> scenario
    | Error ds -> failwith (Format.asprintf "%a" (Fmt.list (Diagnostic.pp ~source:(read fleet))) ds)

let in_scenario name source program (scenario : Scenario.t) faults =
  { name; source; program; world = Scenario_world.world scenario;
    environment = Scenario_world.environment ~answers:[] ~faults program scenario;
    plans = List.map (fun (p : Scenario.plan) -> p.name) scenario.plans;
    prompts = List.map (fun (a : Scenario.answer) -> a.prompt) scenario.answers;
    calls = List.map (fun (r : Scenario.reply) -> r.call) scenario.replies }

let example directory kinds file =
  let path = Filename.concat directory file in
  let source = read path in
  let scenario = scenario_beside path in
  let program = compiled ?place:scenario.plans_at path source in
  List.map (fun (kind, faults) -> (in_scenario (file ^ kind) source program scenario faults, scenario)) kinds

let with_fleets kinds directory =
  let files = List.filter (fun f -> Filename.check_suffix f ".dol") (Array.to_list (Sys.readdir directory)) in
  List.concat_map (example directory kinds) (List.sort compare files)

let examples_with kinds directory = List.map fst (with_fleets kinds directory)

let examples =
  examples_with [ ("", Faults.none); (", with failures", { Faults.none with fail = Any_number }) ]

(* Of a supplier whose every call may fail. *)
let unreliably_supplied c =
  let replies call = List.map (fun round -> round @ [ Error "nobody is there" ]) (c.environment.replies call) in
  if c.calls = [] then None
  else Some { c with name = c.name ^ ", with calls that fail"; environment = { c.environment with replies } }

let faulty_examples directory =
  List.filter_map unreliably_supplied (examples_with [ ("", Faults.none) ] directory)
  @ examples_with
    [ (", with losses", { Faults.none with loss = Any_number });
      (", with a latecomer", { Faults.none with join = At_most 1 });
      (", with all faults once", { Faults.none with fail = At_most 1; loss = At_most 1; join = At_most 1 });
      (", with interruptions", { Faults.none with interrupt = true });
      (", with a failure and interruptions", { Faults.none with fail = At_most 1; interrupt = true }) ]
    directory

(* {1 Programs by their texts} *)

let of_text name source world environment =
  { name; source; program = compiled "small.dol" source; world; environment; plans = []; prompts = [ "how many?" ];
    calls = Calls.names }

let in_fleet name source scenario faults =
  in_scenario name source (compiled "small.dol" source) scenario faults
