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
  | Failed -> "the program halted or failed, or got stuck; what went wrong is told on standard error."
  | Violated -> "a run breaks what was asked of all runs; a shortest one is shown."
  | Inconclusive -> "a bound was met, or Ctrl-C: what was explored breaks nothing, but there is more."
  | Bad_input -> "the program, the fleet or the command line is not right; nothing was started."
  | Platform_trouble -> "not the program is in trouble but what is around it: the platform, or where the output goes."
  | Bug -> "a fault of $(mname) itself. Please report it."
  | Interrupted ->
    "the run was interrupted: by Ctrl-C, by a request to terminate, or because nobody reads its log any more."

let info statuses = List.map (fun s -> Cmdliner.Cmd.Exit.info (code s) ~doc:(meaning s)) statuses
