open Dolphin_environment

type t = {
  program : Program_file.t;
  fleet : Fleet_file.t;
  columns : unit -> int;
  print : string -> unit;
}

(* {1 What may be typed} *)

type command =
  | Take of int
  | Enter
  | Next of int
  | Undo of int
  | Goto of int
  | Goto_end
  | More
  | State
  | Variables
  | Show_run
  | Write of string
  | Help
  | Quit

let help =
  [ ("N", "take choice N");
    ("Enter", "take the only choice, or the one marked >");
    ("next [N]", "take the next step, or the next N, of the run ahead");
    ("undo [N]", "go back one step, or N; they are ahead then");
    ("goto N", "go to the state after N steps, back or ahead");
    ("goto end", "go to the last state of the run ahead");
    ("more", "show all choices");
    ("state", "show the state again");
    ("vars", "show the variables");
    ("run", "show the steps so far");
    ("write FILE", "write the run so far, for exec --follow or --trace");
    ("help", "show this");
    ("quit", "leave") ]

(* A command may be shortened to its first letter, or more. *)
let names = [ "next"; "undo"; "goto"; "more"; "state"; "vars"; "run"; "write"; "help"; "quit" ]

let full word =
  let is_beginning name =
    String.length word <= String.length name && String.sub name 0 (String.length word) = word in
  if word = "?" then Some "help" else List.find_opt is_beginning names

let unknown line = Error (Printf.sprintf "'%s' is not known here: type a number, or help" line)

let number line text make =
  match int_of_string_opt text with
  | Some n when n >= 0 -> Ok (make n)
  | Some _ | None -> Error (Printf.sprintf "'%s' needs a number, not '%s'" line text)

let parse line =
  let line = String.trim line in
  let word, rest =
    match String.index_opt line ' ' with
    | Some i -> (String.sub line 0 i, String.trim (String.sub line i (String.length line - i)))
    | None -> (line, "")
  in
  match int_of_string_opt word, full word, rest with
  | _ when line = "" -> Ok Enter
  | Some n, _, "" -> Ok (Take n)
  | None, Some "next", "" -> Ok (Next 1)
  | None, Some "next", n -> number "next" n (fun n -> Next n)
  | None, Some "undo", "" -> Ok (Undo 1)
  | None, Some "undo", n -> number "undo" n (fun n -> Undo n)
  | None, Some "goto", "end" -> Ok Goto_end
  | None, Some "goto", n -> number "goto" n (fun n -> Goto n)
  | None, Some "more", "" -> Ok More
  | None, Some "state", "" -> Ok State
  | None, Some "vars", "" -> Ok Variables
  | None, Some "run", "" -> Ok Show_run
  | None, Some "write", "" -> Error "'write' needs the name of a file"
  | None, Some "write", path -> Ok (Write path)
  | None, Some "help", "" -> Ok Help
  | None, Some "quit", "" -> Ok Quit
  | (Some _ | None), (Some _ | None), _ -> unknown line

(* {1 What is shown} *)

let say s text = List.iter s.print (Walk_view.wrapped ~columns:(s.columns ()) ~head:"" text)
let view s : Walk_view.t = { program = s.program; columns = s.columns () }
let show s lines = List.iter s.print lines

(* The number of choices that are shown unless all are asked for: a pick may have millions. *)
let most = 20

let rec take_while_shown n (choices : Manual_run.choice Seq.t) =
  if n = 0 then ([], match choices () with Nil -> false | Cons _ -> true)
  else
    match choices () with
    | Nil -> ([], false)
    | Cons (choice, rest) ->
      let shown, is_more = take_while_shown (n - 1) rest in
      (choice :: shown, is_more)

let unclear s (fault : Dolphin_semantics.Fault.t) =
  say s "The possible steps here cannot be listed:";
  show s (String.split_on_char '\n' (Format.asprintf "%a" Error.pp (Program_file.unsettled s.program fault)))

let show_choices ?(most = most) s r =
  let v = view s in
  match take_while_shown most (Manual_run.choices r) with
  | [], _ -> ()
  | choices, is_more ->
    List.iteri (fun i x -> show s (Walk_view.choice v (i + 1) ~is_next:(Manual_run.is_next r x) r x)) choices;
    if is_more then s.print "      and more, which 'more' shows"
  | exception Environment.Unclear fault -> unclear s fault

let is_stuck r =
  match (Manual_run.configuration r).control with
  | Ended _ -> false
  | Script _ | Waiting _ | Executing _ -> (
      match Manual_run.is_stuck r with stuck -> stuck | exception Environment.Unclear _ -> false)

let title r =
  let ahead = List.length (Manual_run.ahead r) in
  Printf.sprintf "state %d%s" (Manual_run.length r) (if ahead = 0 then "" else Printf.sprintf ", %d ahead" ahead)

let show_state s r =
  s.print "";
  s.print (title r);
  show s (Walk_view.state (view s) r);
  if is_stuck r then say s "Nothing can happen any more, and the program has not ended: a deadlock.";
  show_choices s r

(* {1 What is done} *)

let nth n r =
  let rec go n (choices : Manual_run.choice Seq.t) =
    match choices () with
    | Nil -> None
    | Cons (choice, rest) -> if n <= 1 then Some choice else go (n - 1) rest
  in
  if n < 1 then None else go n (Manual_run.choices r)

let take r n =
  match nth n r with
  | Some choice -> Ok (Manual_run.take choice r)
  | None -> Error (Printf.sprintf "no choice %d here" n)

let enter r =
  match take_while_shown 2 (Manual_run.choices r), Manual_run.next r with
  | ([ only ], _), _ -> Ok (Manual_run.take only r)
  | ([], _), _ -> Error "nothing can happen here: 'undo' goes back, 'quit' leaves"
  | _, Some r -> Ok r
  | _, None -> Error "there are several choices: type the number of one"

let goto r n =
  match Manual_run.goto n r with
  | Some r -> Ok r
  | None ->
    let last = Manual_run.length r + List.length (Manual_run.ahead r) in
    Error (Printf.sprintf "no state %d: the last one is %d" n last)

let forward r n =
  match Manual_run.goto (Manual_run.length r + n) r with
  | Some r -> Ok r
  | None ->
    let steps = Dolphin_trace.Phrase.count (List.length (Manual_run.ahead r)) "step" in
    Error (Printf.sprintf "not as many steps ahead: %s" (if Manual_run.ahead r = [] then "nothing is" else steps))

let back r n =
  if n > Manual_run.length r then Error "this is as far back as it goes"
  else goto r (Manual_run.length r - n)

let is_picture path =
  List.mem (String.lowercase_ascii (Filename.extension path)) [ ".svg"; ".html"; ".htm" ]

let write s r path =
  if is_picture path then say s (Printf.sprintf "'%s' is the name of a picture, but JSON would be written" path)
  else
    let steps = Manual_run.steps r in
    match
      Witness_file.write s.program s.fleet path { breaks = ""; description = "a walk"; steps; cycle = [] }
    with
    | Ok () -> say s (Printf.sprintf "%s: %s" path (Dolphin_trace.Phrase.count (List.length steps) "step"))
    | Error e -> List.iter (say s) (Error.sentences e)

let show_help s =
  let line (typed, meaning) =
    Walk_view.wrapped ~columns:(s.columns ()) ~head:("  " ^ Dolphin_trace.Phrase.pad 12 typed) meaning in
  show s (List.concat_map line help);
  say s "Words may be shortened, to one letter if you like."

type outcome = Moved of (Manual_run.t, string) result | Told | Left

let perform s r command =
  match command with
  | Take n -> Moved (take r n)
  | Enter -> Moved (enter r)
  | Next n -> Moved (forward r n)
  | Undo n -> Moved (back r n)
  | Goto n -> Moved (goto r n)
  | Goto_end -> Moved (forward r (List.length (Manual_run.ahead r)))
  | More -> show_choices ~most:max_int s r; Told
  | State -> show_state s r; Told
  | Variables -> show s (Walk_view.variables (view s) r); Told
  | Show_run -> show s (Walk_view.run (view s) r); Told
  | Write path -> write s r path; Told
  | Help -> show_help s; Told
  | Quit -> Left

let rec go ~read s r =
  match read (Printf.sprintf "%d> " (Manual_run.length r)) with
  | None -> ()
  | Some line -> (
      match Result.map (perform s r) (parse line) with
      | Error why | Ok (Moved (Error why)) -> say s why; go ~read s r
      | Ok (Moved (Ok r)) -> show_state s r; go ~read s r
      | Ok Told -> go ~read s r
      | Ok Left -> ()
      | exception Environment.Unclear fault -> unclear s fault; go ~read s r)

(* {1 A walk} *)

let ( let* ) = Result.bind

let recorded s path r =
  let* witness = Witness_file.read path in
  let misfit why = Error.Bad_input (Printf.sprintf "%s does not fit %s: %s" path s.program.path why) in
  let* r = Result.map_error misfit (Manual_run.recorded witness r) in
  if witness.property <> "" then say s ("breaks: " ^ witness.property);
  say s "'next' takes the steps of the recorded run, 'goto N' and 'goto end' go to its states.";
  Ok r

let run ~read ~print ~columns (program : Program_file.t) (fleet : Fleet_file.t) ~answers ~faults ~trace =
  let s = { program; fleet; columns; print } in
  let world : Manual_run.world =
    { program = program.program; world = Scenario_world.world fleet.scenario;
      options = Scenario_world.environment ~answers ~faults program.program fleet.scenario }
  in
  let start = Manual_run.start world in
  let* r = Option.fold ~none:(Ok start) ~some:(fun path -> recorded s path start) trace in
  show_state s r;
  go ~read s r;
  Ok ()
