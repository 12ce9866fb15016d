(* fleet N F [MAX_STATES]: explores the program of the peers' models, N vehicles, F = 1 with failures, and prints one
   line: states, transitions, depth, seconds of CPU, bytes a state as the explorer counts them. With REDUCTION=por,
   symmetry or all in the environment the search is reduced, with COMPRESS=yes states are compressed, with MEMORY=MIB
   and SPILL=DIR those beyond this memory are on disk. WORKERS=N is how many processes search; the seconds are of the
   first of them. CONTEXT (watch, ignore, during, until or then) is the construct around the task that is executed;
   plain has none. LTL is a formula to be checked as well: a second line has the number of states that this took, and
   the verdict. *)

open Dolphin_environment
open Dolphin_checker
open Dolphin_explore
module Pure_run = Test_support.Pure_run

let program n =
  let each format = List.init n (fun i -> Printf.sprintf format (i + 1)) in
  let branch i = Printf.sprintf "when { consume ready:%d } then imcPlan('rv%d')" (i + 1) (i + 1) in
  let around task =
    match Option.value (Sys.getenv_opt "CONTEXT") ~default:"plain" with
    | "plain" -> task
    | "watch" -> Printf.sprintf "(watch (%s) onError { message 'failed' ; halt 'failed' })" task
    | "ignore" -> Printf.sprintf "(watch (%s) onError { ignore() })" task
    | "during" -> Printf.sprintf "(during 1.hours run (%s))" task
    | "until" -> Printf.sprintf "(until { poll stop:1 } run (%s))" task
    | "then" -> Printf.sprintf "(%s) >> action { post done:1 }" task
    | context -> failwith ("no context: " ^ context)
  in
  let uuvs = String.concat " | " (each "UUVTask(%d)") and branches = String.concat "\n" (List.init n branch) in
  Printf.sprintf
    {|UUVs = pick { count %d; type 'UUV' }
UAV = pick { type 'UAV' }
def UUVTask(i) { imcPlan('survey' + i) >> action { post ready:i } >> imcPlan('sk' + i) }
execute %s
|}
    n
    (around (Printf.sprintf "(%s)[UUVs] | (allOf {\n%s\n})[UAV]" uuvs branches))

let formulas program =
  let formula text =
    match Temporal.of_string program text with Ok f -> f | Error why -> failwith (text ^ ": " ^ why)
  in
  List.map formula (Option.to_list (Sys.getenv_opt "LTL"))

let world n =
  let uuvs = List.init n (fun i -> Pure_run.vehicle ~payload:[] (Printf.sprintf "uuv-%d" (i + 1))) in
  Pure_run.world (uuvs @ [ Pure_run.vehicle ~kind:"UAV" ~payload:[] "uav" ])

let () =
  let argument i = if i < Array.length Sys.argv then Some (int_of_string Sys.argv.(i)) else None in
  let n = Option.value (argument 1) ~default:3 in
  let environment =
    if argument 2 = Some 1 then Environment.failing Environment.default else Environment.default
  in
  let report (p : Limits.progress) =
    Printf.eprintf "%s: %d states, %.0f a second, frontier %d, depth %d, %d MB\n%!" p.phase p.states p.rate p.frontier
      p.depth (p.memory / 1_000_000)
  in
  let progress = if Sys.getenv_opt "PROGRESS" = None then ignore else report in
  let reduction =
    match Sys.getenv_opt "REDUCTION" with
    | Some "por" -> Reduction.Partial_order
    | Some "symmetry" -> Symmetry
    | Some "all" -> All
    | Some _ | None -> Whole
  in
  let compress = Sys.getenv_opt "COMPRESS" <> None in
  let max_memory = Option.map (fun mib -> int_of_string mib lsl 20) (Sys.getenv_opt "MEMORY") in
  let limits = { Limits.none with max_states = argument 3; max_memory; progress } in
  let program = Pure_run.compile_exn (program n) in
  let formulas = formulas program in
  let spill = Sys.getenv_opt "SPILL" in
  let workers = Option.fold ~none:1 ~some:int_of_string (Sys.getenv_opt "WORKERS") in
  let options = { Search.default with environment; reduction; compress; spill; workers; limits; formulas } in
  let o = Search.run options program (world n) in
  Printf.printf "%d states, %d transitions, depth %d, %.2f s, %.1f bytes a state%s\n" o.states o.transitions o.depth
    (Sys.time ())
    (float_of_int o.bytes /. float_of_int o.states)
    (match o.stopped with None -> "" | Some bound -> Format.asprintf ", %a" Limits.pp_bound bound);
  let print_formula = function
    | (Property.Formula _, _) as verdict ->
      Format.printf "%d states for formulas; %a@." o.formula_states (Search.pp_verdict program) verdict
    | _ -> ()
  in
  List.iter print_formula o.verdicts
