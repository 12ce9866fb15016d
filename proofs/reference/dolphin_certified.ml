(* dolphin_certified FILE: checks the certificate of [dolphin explore --certify FILE]. *)

open Dolphin_environment
open Dolphin_app
module Property = Dolphin_explore.Property

let ( let* ) = Result.bind

let unchanged (recorded : Dolphin_trace.Header.source) (found : Dolphin_trace.Header.source option) =
  match found with
  | Some found when found.hash = recorded.hash -> Ok ()
  | Some _ | None -> Error (Error.Bad_input (recorded.path ^ " has changed since the certificate was written"))

let check path =
  let* certificate = State_certificate.read path in
  let { State_certificate.header = { program; fleet; answers; faults; holds; _ }; edges } = certificate in
  let fleet_path = Option.map (fun (f : Dolphin_trace.Header.source) -> f.path) fleet in
  let* read, world = Program_file.load_with_fleet ~set:program.set ~fleet:fleet_path program.path in
  let* () = unchanged program (Some (Program_file.header read)) in
  let* () = Option.fold fleet ~none:(Ok ()) ~some:(fun fleet -> unchanged fleet (Fleet_file.header world)) in
  let core = read.program in
  let options = Scenario_world.environment ~answers ~faults core world.scenario in
  match Certification.check options core (Scenario_world.world world.scenario) ~holds edges with
  | exception Environment.Unclear fault -> Error (Program_file.unsettled read fault)
  | Refuted { state; why } ->
    Printf.printf "%s: not certified: state %d: %s\n" path state why;
    Ok 1
  | Certified most ->
    let transitions = Array.fold_left (fun n edges -> n + List.length edges) 0 edges in
    Printf.printf "%s: %d states, %d transitions: as the rules have them\n" path (Array.length edges) transitions;
    List.iter (fun property -> Printf.printf "%s: certified\n" (Property.name property)) holds;
    Option.iter (Printf.printf "termination: certified: no run has more than %d transitions\n") most;
    Ok 0

let usage = "usage: dolphin_certified FILE, where dolphin explore PROG --certify FILE wrote FILE"

let () =
  match Sys.argv with
  | [| _; "--help" |] -> print_endline usage
  | [| _; path |] -> (
      match
        let checked = check path in
        flush stdout;
        checked
      with
      | Ok status -> exit status
      | Error e ->
        Format.eprintf "dolphin_certified: %a@." Error.pp e;
        exit 2
      | exception Sys_error why ->
        prerr_endline ("dolphin_certified: the output cannot be written: " ^ why);
        (* The output at exit would be tried once more. *)
        Unix._exit 3)
  | _ ->
    prerr_endline usage;
    exit 2
