type t = Done | Failed | Violated | Bad_input | Platform_trouble | Inconclusive | Bug | Interrupted

let of_verdict : Dolphin_checker.Verdict.t -> t = function
  | Holds -> Done
  | Violated -> Violated
  | Inconclusive -> Inconclusive

let code = function
  | Done -> 0
  | Failed | Violated -> 1
  | Bad_input -> 2
  | Platform_trouble | Inconclusive -> 3
  | Bug -> 125
  | Interrupted -> 130

let exit_interrupted () = Unix._exit (code Interrupted)

let meaning = function
  | Done -> "all is well."
  | Failed -> "the program halted or failed, or got stuck; the reason is on standard error."
  | Violated -> "a run violates a property; a shortest such run is shown."
  | Inconclusive -> "a bound was met, or Ctrl-C: no violation in the explored part, but there is more to explore."
  | Bad_input -> "the program, the fleet or the command line is not right; nothing was started."
  | Platform_trouble -> "the platform or the output failed, not the program."
  | Bug -> "a fault of $(mname) itself. Please report it."
  | Interrupted ->
    "the run was interrupted by Ctrl-C, by a request to terminate, or because its log has no reader any more."

(* Every command has an output that may fail. *)
let info statuses =
  let statuses = if List.mem Platform_trouble statuses then statuses else Platform_trouble :: statuses in
  List.map (fun s -> Cmdliner.Cmd.Exit.info (code s) ~doc:(meaning s)) statuses
