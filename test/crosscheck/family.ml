type constant = { name : string; parameters : string list; definition : string }

let configuration = "Family.cfg"
let by_rule = "FamilyByRule.cfg"
let refinement = "FamilyRefinement.cfg"
let refined = "MCRefinement"
let dates = "FamilyDates.cfg"
let timed = "MCTimed"

(* {1 The constants as definitions} *)

let applied name = function [] -> name | parameters -> Printf.sprintf "%s(%s)" name (String.concat ", " parameters)
let of_program i name = Printf.sprintf "%s_%d" name i

(* For each constant without parameters, the tuple of its values, which TLC computes once. *)
let definition count (c : constant) =
  let all = List.init count (fun i -> of_program (i + 1) c.name) in
  match c.parameters with
  | [] -> Printf.sprintf "All%s == << %s >>\n%s == All%s[which]\n" c.name (String.concat ", " all) c.name c.name
  | parameters ->
    let case i name = Printf.sprintf "which = %d -> %s" (i + 1) (applied name parameters) in
    Printf.sprintf "%s == CASE %s\n" (applied c.name parameters) (String.concat "\n  [] " (List.mapi case all))

let programs_module programs =
  let of_one i constants =
    let one c = Printf.sprintf "%s == %s\n" (applied (of_program (i + 1) c.name) c.parameters) c.definition in
    List.map one constants
  in
  let lookups = match programs with [] -> [] | first :: _ -> List.map (definition (List.length programs)) first in
  String.concat ""
    ([ "---- MODULE Programs ----\nEXTENDS Integers, Sequences, TLC\nVARIABLE which\n" ]
     @ List.concat (List.mapi of_one programs)
     @ lookups @ [ "====\n" ])

(* {1 The specification without constants} *)

let begins prefix line =
  String.length line >= String.length prefix && String.sub line 0 (String.length prefix) = prefix

(* [CONSTANTS] and the lines that follow, up to an empty one, are gone. *)
let without_constants lines =
  let rec outside = function
    | "CONSTANTS" :: rest -> inside rest
    | line :: rest -> line :: outside rest
    | [] -> []
  and inside = function "" :: rest -> "" :: outside rest | _ :: rest -> inside rest | [] -> [] in
  outside lines

(* Assumptions on constants become an invariant ({!assumed}), since these are constants no longer. *)
let assumed = [ "PlacesOK"; "ProgramOK"; "FleetOK"; "EnvironmentOK" ]
let assumed_of_time = "TimedOK"

let without_assumptions lines =
  List.filter (fun line -> not (List.exists (fun name -> line = "ASSUME " ^ name) (assumed_of_time :: assumed))) lines

(* A state is of one program, and stays of it. *)
let of_one_program line =
  let variables = "vars == << " in
  if begins variables line then
    variables ^ "which, " ^ String.sub line (String.length variables) (String.length line - String.length variables)
  else if line = "Becomes(t) ==" then line ^ "\n  /\\ which' = which"
  else line

(* The lowest module of the specification extends nothing but standard ones: it extends the programs too. *)
let lowest = "DolphinValues.tla"

let extending_programs line = if begins "EXTENDS " line then line ^ ", Programs" else line

let model_module count =
  Printf.sprintf
    {|---- MODULE MC ----
EXTENDS DolphinChecking
FamilyInit == which \in 1 .. %d /\ CheckedInit
PrintFamily == PrintGraphOf(which, LabelAndEffects)
====
|}
    count

let taking next =
  Printf.sprintf
    "INIT FamilyInit\nNEXT %s\nCONSTANT Known <- ComputedOnce\nINVARIANT PrintFamily\nCHECK_DEADLOCK FALSE\n"
    next

(* The model module again, upon the module of the refinement. *)
let refined_module count =
  Printf.sprintf
    {|---- MODULE %s ----
EXTENDS DolphinRefinement
FamilyInit == which \in 1 .. %d /\ RefinedInit
====
|}
    refined count

let refining =
  "INIT FamilyInit\nNEXT RefinedNext\nCONSTANT Known <- ComputedOnce\nINVARIANTS NoneRefused Mapped AbstractInv TypeOK "
  ^ String.concat " " assumed ^ "\nCHECK_DEADLOCK FALSE\n"

let timed_module count =
  Printf.sprintf
    {|---- MODULE %s ----
EXTENDS Timed
FamilyInit == which \in 1 .. %d /\ TimedInit
PrintDates == DatesOf(which)
====
|}
    timed count

let dating =
  Printf.sprintf
    "INIT FamilyInit\nNEXT TimedNext\nVIEW TimedView\nCONSTANT Known <- ComputedOnce\nINVARIANTS PrintDates %s\n\
     CHECK_DEADLOCK FALSE\n"
    assumed_of_time

let files ~specification programs =
  if not (List.mem_assoc lowest specification) then Error ("there is no " ^ lowest ^ " in the specification")
  else
    let changed (name, text) =
      let lines = without_assumptions (without_constants (String.split_on_char '\n' text)) in
      let lines = List.map of_one_program lines in
      (name, String.concat "\n" (if name = lowest then List.map extending_programs lines else lines))
    in
    let is_abstract (name, _) = name = "Abstract.tla" in
    let abstract, specification = List.partition is_abstract specification in
    Ok
      ([ ("Programs.tla", programs_module programs);
         ("MC.tla", model_module (List.length programs));
         (refined ^ ".tla", refined_module (List.length programs));
         (timed ^ ".tla", timed_module (List.length programs));
         (configuration, taking "GraphNext"); (by_rule, taking "NextByRule"); (refinement, refining); (dates, dating) ]
       @ abstract @ List.map changed specification)
