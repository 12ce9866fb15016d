open Dolphin_trace

(* Mutants that are not journals of runs any more, by their mutation. *)
let wanted = 2000
let show verdict = Format.asprintf "@[<v>%a@]" Journal_verdict.pp verdict

(* {1 Mutants} *)

type mutant = {
  text : string;
  harmless : bool;  (* it may still be the journal of a run *)
  what : string;
}

let kind line =
  match Entry.of_string line with
  | Ok (Header _) -> `Header
  | Ok (Vehicle _) -> `Vehicle
  | Ok (Event _) -> `Event
  | Ok (Transition _) -> `Transition
  | Ok (End _) -> `End
  | Ok (Partial _ | Label _ | Note _ | Act _ | Resumed _) -> `Other
  | Error _ -> `Nothing

let pick random xs = xs.(Random.State.int random (Array.length xs))

(* Lines with nothing but times and places of sightings may go, come and change; and the last one may be missing. *)
let drop random lines =
  let i = Random.State.int random (Array.length lines) in
  let kept = List.filteri (fun j _ -> j <> i) (Array.to_list lines) in
  { text = Runs.text kept; harmless = (match kind lines.(i) with `Vehicle | `End -> true | _ -> false);
    what = Printf.sprintf "line %d dropped" (i + 1) }

let double random lines =
  let i = Random.State.int random (Array.length lines) in
  let copies j line = if j = i then [ line; line ] else [ line ] in
  let twice = List.concat (List.mapi copies (Array.to_list lines)) in
  { text = Runs.text twice; harmless = kind lines.(i) = `Vehicle; what = Printf.sprintf "line %d doubled" (i + 1) }

let swap random lines =
  let i = Random.State.int random (Array.length lines - 1) in
  let swapped = Array.copy lines in
  swapped.(i) <- lines.(i + 1);
  swapped.(i + 1) <- lines.(i);
  let is_vehicle j = kind lines.(j) = `Vehicle in
  { text = Runs.text (Array.to_list swapped); harmless = is_vehicle i || is_vehicle (i + 1);
    what = Printf.sprintf "lines %d and %d swapped" (i + 1) (i + 2) }

(* Another line of the same kind in its place. *)
let replace random lines =
  let i = Random.State.int random (Array.length lines) in
  let alike = List.filter (fun line -> kind line = kind lines.(i) && line <> lines.(i)) (Array.to_list lines) in
  let replaced = Array.copy lines in
  if alike <> [] then replaced.(i) <- pick random (Array.of_list alike);
  { text = Runs.text (Array.to_list replaced); harmless = alike = [] || kind lines.(i) = `Vehicle;
    what = Printf.sprintf "line %d replaced" (i + 1) }

(* One character of a line becomes another one. Times, and all circumstances, may be different. *)
let alter random lines =
  let i = Random.State.int random (Array.length lines) in
  let line = lines.(i) in
  let j = Random.State.int random (String.length line) in
  let c = pick random [| '0'; '7'; 'x'; '"'; '}'; ' '; ','; 'a'; '-' |] in
  let altered = String.mapi (fun k old -> if k = j then c else old) line in
  let without_time line =
    match Entry.of_string line with
    | Ok (Transition t) -> Some (Entry.to_string (Transition { t with time = 0.; ways = [] }))
    | Ok (Event e) -> Some (Entry.to_string (Event { e with time = 0. }))
    | Ok (End e) -> Some (Entry.to_string (End { e with time = 0. }))
    | Ok (Header _ | Partial _ | Label _ | Vehicle _ | Note _ | Act _ | Resumed _) -> Some ""
    | Error _ -> None
  in
  (* The reason of a vehicle's failure is its own affair, but later lines repeat it; the same holds for answers. *)
  let replaced = Array.copy lines in
  replaced.(i) <- altered;
  { text = Runs.text (Array.to_list replaced); harmless = without_time line = without_time altered;
    what = Printf.sprintf "line %d altered at %d: %s" (i + 1) (j + 1) altered }

(* {1 Showing them} *)

(* Everything that can be read of a journal, however strange, can be shown and drawn. *)
let show_all text =
  let reader = Journal.of_string text and builder = Summary.create () in
  let rec entries found =
    match Journal.next reader with
    | Line { entry; _ } -> Summary.add builder entry; entries (entry :: found)
    | Torn _ | End_of_file | Wrong _ -> List.rev found
  in
  let found = entries [] in
  let ppf = Format.formatter_of_buffer (Buffer.create 4096) in
  Table.print ppf found;
  List.iter (Table.print_transitions ppf) found;
  ignore (Picture.html (Summary.finish builder))

(* {1 The trial} *)

(* A mutant that may still be a run is rejected or not, as it happens to be; of all others, none may pass. *)
let trial () =
  let random = Random.State.make [| 20260301 |] in
  let names = List.filter (fun name -> not (Sys.file_exists ("../../examples/" ^ name ^ ".py"))) Runs.examples in
  (* Short ones: many mutants of many programs test more than some of long journals. *)
  let is_short (r : Runs.t) = String.length r.journal < 40_000 in
  let runs = Array.of_list (List.filter is_short (List.map (fun name -> Runs.run ~period:1e9 name) names)) in
  let rejected = ref 0 and passed = ref [] and doubtful = ref 0 and still_runs = ref 0 in
  while !rejected + List.length !passed < wanted do
    let run = pick random runs in
    let lines = Array.of_list (Runs.lines run.journal) in
    let m = (pick random [| drop; double; swap; replace; alter; alter |]) random lines in
    let verdict = Runs.check_text run m.text in
    if !rejected mod 10 = 0 then show_all m.text;
    if m.harmless then begin
      incr doubtful;
      if Journal_verdict.is_legal verdict then incr still_runs
    end
    else if Journal_verdict.is_legal verdict then
      passed := Printf.sprintf "%s, %s: %s" run.name m.what (show verdict) :: !passed
    else incr rejected
  done;
  let figures =
    Printf.sprintf "of %d mutants that are no runs %d were rejected; of %d that may be, %d are" wanted !rejected
      !doubtful !still_runs
  in
  print_endline figures;
  if !passed <> [] then Alcotest.failf "%s\n%s" figures (String.concat "\n" !passed)

let () = Alcotest.run "mutants" [ ("mutants", [ Alcotest.test_case "2000 mutants" `Quick trial ]) ]
