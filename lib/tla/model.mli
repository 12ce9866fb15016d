(** The TLA+ model of one program in one world: the input with which TLC explores it, by the specification in
    [spec/]. There the program is a table of expressions, which the specification runs itself. Only geometry is
    computed here.

    {[
      open Dolphin_semantics
      open Dolphin_environment

      let program =
        let text = "v = pick { count 1 }\nexecute v: task('survey1')" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let world = Scenario_world.world Dolphin_scenario.Scenario.default

      let () =
        match Dolphin_tla.Model.of_program ~environment:Environment.default world program with
        | Ok files -> assert (List.exists (fun (f : Dolphin_tla.Model.file) -> f.name = "MC.tla") files)
        | Error _ -> assert false
    ]} *)

open Dolphin_semantics
module Environment = Dolphin_environment.Environment

(** A file of the model. *)
type file = { name : string;  (** without a directory *) text : string }

val of_program :
  ?plans:string list ->
  ?prompts:string list ->
  ?calls:string list ->
  ?times:Times.t ->
  environment:Environment.options ->
  World.t ->
  Core.program ->
  (file list, Dolphin_syntax.Diagnostic.t list) result
(** [of_program ~plans ~prompts ~calls ~times ~environment w p] is the model of [p] in [w]: the specification's
    modules, [MC.tla] with the program and the world as constants, and configurations, all for one directory.
    [MC.cfg] checks the properties; [Told.cfg] does too, and prints runs by an [ALIAS]; [Graph.cfg] prints the graph;
    [Coverage.cfg] has an action for each rule. With [times], also [MCTimed.tla] and [Timed.cfg], which prints when
    runs end, and tasks start and end. An error lists the parts that cannot be translated, in the order of the text.
    [environment] is asked about the plans, prompts and calls of the host that are listed here; its answer for a name
    that is in no list holds for all others. *)

val unfit_replies :
  environment:Environment.options -> calls:string list -> World.t -> Core.program -> (string * string) list
(** [unfit_replies ~environment ~calls w p] is those of [calls] with a reply that TLA+ cannot express, each with why.
    {!of_program} refuses them too, but without a place. *)
