open Dolphin_semantics

type t = No_deadlock | Termination | No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover | All_reached
       | Invariant of string
       | Formula of string
       | Apart of string

let all = [ No_deadlock; Termination; No_error; Assertions; Vehicles; Allocation; No_halt; No_leftover; All_reached ]

(* What was typed may have anything in it, also ends of lines, where names are one line. *)
let typed text =
  Dolphin_syntax.Character.printable (String.map (function '\n' | '\t' | '\r' -> ' ' | c -> c) text)

let name = function
  | No_deadlock -> "no deadlock"
  | Termination -> "termination"
  | No_error -> "no unhandled error"
  | Assertions -> "assertions"
  | Vehicles -> "vehicles for all picks"
  | Allocation -> "vehicles for all tasks"
  | No_halt -> "no halt"
  | No_leftover -> "no leftover tuples"
  | All_reached -> "all code reached"
  | Invariant text -> "invariant " ^ typed text
  | Formula text -> "formula " ^ typed text
  | Apart fence -> fence

let question = function
  | No_deadlock -> "nothing can happen any more, and the program has not ended"
  | Termination -> "the program may never end"
  | No_error -> "an unhandled error ends the program"
  | Assertions -> "an assertion fails"
  | Vehicles -> "vehicles are missing"
  | Allocation -> "a task cannot be executed"
  | No_halt -> "the program halts"
  | No_leftover -> "tuples are left when the program completes"
  | All_reached -> "no run reaches this"
  | Invariant _ -> "it does not hold"
  | Formula _ -> "it does not hold"
  | Apart _ -> "plans run side by side whose ways come nearer to each other"

let is_of_fair_runs = function
  | Termination | Formula _ -> true
  | No_deadlock | No_error | Assertions | Vehicles | Allocation | No_halt | No_leftover | All_reached | Invariant _
  | Apart _ -> false

let pp ppf p = Format.pp_print_string ppf (name p)

(* A program cannot know which inputs come, or take them all. *)
let leaves_tuples (program : Core.program) (c : Configuration.t) =
  List.exists (fun (k, _) -> not (List.mem k program.inputs)) (Tuples.bindings c.shared.tuples)

let broken_by_end (program : Core.program) rules (c : Configuration.t) =
  match c.control with
  | Ended (Failed fault) when Fault.is_assertion fault -> Some Assertions
  | Ended (Failed _) ->
    let has rule = List.exists (fun (r : Rule.t) -> r = rule) rules in
    Some (if has Pick_err then Vehicles else if has Alloc_err then Allocation else No_error)
  | Ended (Halted _) -> Some No_halt
  | Ended Completed when leaves_tuples program c -> Some No_leftover
  | Ended (Completed | Interrupted) | Script _ | Waiting _ | Executing _ -> None
