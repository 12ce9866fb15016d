open Dolphin_plans
open Dolphin_syntax
open Dolphin_charts

type t = {
  path : string;
  source : string;
  parameters : Parameters.t list;
  set : (string * string) list;
  ast : Ast.program;
  program : Dolphin_semantics.Core.program;
  warnings : Diagnostic.t list;
  without_place : Diagnostic.t list Lazy.t;
  plans : place:Dolphin_geo.Position.t option -> (Ast.expression * Dolphin_plans.Inline_plan.t) list;
}

let ( let* ) = Result.bind
let wrong source result = Result.map_error (fun found -> Error.Bad_text { source; found }) result

let parse path =
  let* source = Text_file.read path in
  wrong source (Parse.program ~file:path source)

let no_fleet path =
  if Filename.extension path <> ".fleet" then Ok ()
  else
    Error
      (Error.Bad_input
         (Printf.sprintf "%s: this is a fleet: name a program, and the fleet by --fleet %s" path path))

let load ?(set = []) ?(may_read = Text_file.anything) path =
  let* source = Text_file.read path in
  let* () = no_fleet path in
  let read = Text_file.read_named ~may_read in
  let { Include.text = source; _ }, parsed = Include.program ~read ~file:path source in
  let* ast = wrong source parsed in
  let parameters = Parameters.of_program ast in
  let* ast = Result.map_error (fun why -> Error.Bad_input why) (Parameters.set set ast) in
  let charts = Charts.read read ast in
  let chart = Charts.value charts in
  let elaborated = Dolphin_semantics.Elaborate.program_with_charts ~chart ~source_name:path ast in
  let* program, warnings = wrong source elaborated in
  Ok { path; source = source ^ Charts.identity charts; parameters; set; ast; program; warnings;
       without_place = lazy (Dolphin_semantics.Elaborate.plans_without_place ~chart ast);
       plans = (fun ~place -> Dolphin_semantics.Elaborate.known_plans ~chart ~place ast) }

(* Of the inputs of vehicles one to which the fleet gives another value. *)
let unfit_input (fleet : Fleet_file.t) (program : Dolphin_semantics.Core.program) =
  let is_unfit (i : Dolphin_scenario.Scenario.input) =
    not (List.for_all (List.for_all (Typed_input.is_of_kind program i.key)) i.rounds) in
  let why (i : Dolphin_scenario.Scenario.input) =
    Printf.sprintf "%s: input '%s' takes a vehicle, as in input '%s', vehicles('x8-02')"
      (Option.value fleet.path ~default:"the fleet") i.key i.key
  in
  Option.map why (List.find_opt is_unfit fleet.scenario.inputs)

let within (fleet : Fleet_file.t) p =
  let program, to_compare = Dolphin_scenario.Scenario.within fleet.scenario p.program in
  let p = { p with program; warnings = p.warnings @ fleet.warnings } in
  let plans = p.plans ~place:program.place in
  let broken =
    if to_compare = [] then [] else Dolphin_semantics.Fence_declarations.broken (Fences.make to_compare) plans in
  match (if program.place = None then Lazy.force p.without_place else []) @ broken, unfit_input fleet program with
  | [], None -> Ok p
  | [], Some why -> Error (Error.Bad_input why)
  | found, _ -> Error (Error.Bad_text { source = p.source; found })

let load_recorded ~set ~recorded path =
  match set, recorded with
  | [], Some recorded -> load ~set:recorded path
  | _ :: _, Some recorded when recorded <> set ->
    Error (Error.Bad_input "the recorded run has parameters of its own: leave out --set")
  | _, (Some _ | None) -> load ~set path

let load_with_fleet ~set ?recorded ~fleet path =
  let* program = load_recorded ~set ~recorded path in
  let* fleet = Fleet_file.load_for ~program:path fleet in
  let* program = within fleet program in
  Ok (program, fleet)

let header p = Dolphin_trace.Header.source ~set:p.set ~path:p.path p.source

let location p site = Dolphin_semantics.(Fault.location p.program (Fault.make site ""))
let at p site = Option.map (Fmt.str "%a" Location.pp) (location p site)

let line p site =
  let short at = Printf.sprintf "%s:%d" (Filename.basename (Location.file at)) (Location.line at) in
  Option.fold (location p site) ~none:"" ~some:short

let diagnostic p (fault : Dolphin_semantics.Fault.t) =
  let at = Option.value (Dolphin_semantics.Fault.location p.program fault) ~default:Location.none in
  Diagnostic.error at fault.message ?hint:(Dolphin_semantics.Fault.hint p.program fault)

let unsettled p fault = Error.Unsettled { source = p.source; fault = diagnostic p fault }
