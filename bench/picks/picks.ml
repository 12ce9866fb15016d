(* picks N FAULTS [MAX_STATES]: explores a program that picks vehicles from a fleet of N that are alike, and prints
   one line: states, transitions, depth, seconds of CPU. FAULTS is the possible faults: none, or faults as the
   command takes them. PROGRAM in the environment is which program: teams (three teams of three, side by side) or
   turns (a team of three, four times, one after the other). REDUCTION is none, por, symmetry or all, the default. *)

open Dolphin_environment
open Dolphin_checker
open Dolphin_explore
module Pure_run = Test_support.Pure_run

let teams =
  {|a = pick { count 3; type 'UUV' }
b = pick { count 3; type 'UUV' }
c = pick { count 3; type 'UUV' }
def fly(team, i) { return task('survey' + i)[team] | task('sample' + i)[team] | task('watch' + i)[team] }
execute fly(a, 1) | fly(b, 2) | fly(c, 3)
release a + b + c
|}

let turns =
  {|for (i in 1..4) {
  team = pick { count 3; type 'UUV' }
  execute task('survey')[team] | task('sample')[team] | task('watch')[team]
  message "${team} are back"
  release team
}
|}

(* Each at a place of its own. *)
let world n =
  let vehicle i = Pure_run.vehicle ~payload:[] ~north:(float i *. 50.) (Printf.sprintf "uuv-%d" (i + 1)) in
  Pure_run.world (List.init n vehicle)

let environment text =
  match if text = "none" then Ok Faults.none else Faults.of_string text with
  | Error why -> failwith why
  | Ok faults -> { Environment.default with faults }

let () =
  let n = int_of_string Sys.argv.(1) and environment = environment Sys.argv.(2) in
  let max_states = if Array.length Sys.argv > 3 then Some (int_of_string Sys.argv.(3)) else None in
  let program = match Sys.getenv_opt "PROGRAM" with Some "turns" -> turns | Some _ | None -> teams in
  let reduction =
    match Sys.getenv_opt "REDUCTION" with
    | Some "none" -> Reduction.Whole
    | Some "por" -> Partial_order
    | Some "symmetry" -> Symmetry
    | Some _ | None -> All
  in
  let options = { Search.default with environment; reduction; limits = { Limits.none with max_states } } in
  let o = Search.run options (Pure_run.compile_exn program) (world n) in
  Printf.printf "%d states, %d transitions, depth %d, %.2f s%s\n" o.states o.transitions o.depth (Sys.time ())
    (match o.stopped with None -> "" | Some bound -> Format.asprintf ", %a" Limits.pp_bound bound)
