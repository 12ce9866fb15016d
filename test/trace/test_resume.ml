open Dolphin_trace

let case name test = Alcotest.test_case name `Quick test
let show verdict = Format.asprintf "@[<v>%a@]" Journal_verdict.pp verdict

(* A journal without the traces of two consoles: the written samples, and the date of the second. *)
let story journal =
  let is_told line =
    match Entry.of_string line with
    | Ok (Header _ | Event _ | Transition _ | End _) -> true
    | Ok (Partial _ | Label _ | Vehicle _ | Note _ | Act _ | Resumed _) | Error _ -> false
  in
  List.filter is_told (Runs.lines journal)

(* A supplier forgets what it has handed out when it is started again. *)
let has_supplier (r : Runs.t) = Sys.file_exists ("../../examples/" ^ r.name ^ ".py")

let resumes (r : Runs.t) ~at text =
  match Runs.resume r text with
  | Error why -> Alcotest.failf "%s, resumed at %d: %s" r.name at why
  | Ok joined ->
    (match Runs.check_text r joined with
     | Run _ -> ()
     | verdict -> Alcotest.failf "%s, resumed at %d: %s" r.name at (show verdict));
    if story joined <> story r.journal && not (has_supplier r) then begin
      let differs a b = a <> b in
      let rec first a b =
        match a, b with
        | x :: a, y :: b -> if differs x y then (x, y) else first a b
        | x :: _, [] -> (x, "nothing")
        | [], y :: _ -> ("nothing", y)
        | [], [] -> ("", "")
      in
      let expected, found = first (story r.journal) (story joined) in
      Alcotest.failf "%s, resumed at %d, goes on otherwise:\n%s\nnot\n%s" r.name at found expected
    end

(* In virtual time a run that was broken off, wherever that was, goes on as if nothing had happened. The console died
   after line [i], and in the middle of the next one. *)
let at_line (r : Runs.t) i =
  let lines = Runs.lines r.journal in
  let whole = Runs.text (List.filteri (fun j _ -> j < i) lines) in
  let next = List.nth lines i in
  resumes r ~at:i (whole ^ String.sub next 0 (i mod (String.length next + 1)))

(* [most] of the [n] lines, evenly. *)
let sample ~most n = List.sort_uniq Int.compare (List.init most (fun k -> 1 + (k * (n - 2) / max 1 (most - 1))))

let examples () =
  let go name =
    let r = Runs.run ~period:60. name in
    let n = List.length (Runs.lines r.journal) in
    List.iter (at_line r) (sample ~most:(if has_supplier r then 3 else 10) n)
  in
  List.iter go Runs.examples

(* Cut at any byte, a journal is resumed from its last whole line, or refused. *)
let at_each_byte () =
  let r = Runs.run ~period:60. "tuple_space" in
  let header = 1 + String.index r.journal '\n' in
  let read length =
    let cut = String.sub r.journal 0 length in
    match Dolphin_runtime.Resumption.read r.program ~hash:r.hash (Journal.of_string cut) with
    | Ok past ->
      if past.kept > length || r.journal.[past.kept - 1] <> '\n' then
        Alcotest.failf "cut at %d, it goes on at %d" length past.kept
    | Error (No_run (Unreadable _)) when length < header -> ()
    | Error (Over _) when length = String.length r.journal -> ()
    | Error trouble -> Alcotest.failf "cut at %d: %a" length Dolphin_runtime.Resumption.pp_trouble trouble
  in
  for length = 0 to String.length r.journal do read length done

(* {1 Lines of the platform that are missing} *)

(* The run's lines with some notes of the platform among them: each with whether it is such a note. *)
let with_notes random (r : Runs.t) =
  let numbering = Journal.numbering ~notes:0 in
  let one line =
    let entry = Result.get_ok (Entry.of_numbered_string line) |> fst in
    let note _ =
      let note = Entry.Note { time = Entry.time entry; vehicle = "v"; note = `Assoc [ ("asked", `String "p") ] } in
      (Journal.line numbering note, true)
    in
    let whole = (Journal.line numbering entry, false) in
    let number = match entry with Transition _ -> Random.State.int random 3 | _ -> 0 in
    whole :: List.init number note
  in
  let header, rest = match Runs.lines r.journal with h :: rest -> (h, rest) | [] -> assert false in
  (header, false) :: List.concat_map one rest

let read_lines (r : Runs.t) lines =
  Dolphin_runtime.Resumption.read r.program ~hash:r.hash (Journal.of_string (Runs.text lines))

(* A run that breaks off, at a random line, without one of its notes is refused, unless nothing follows that note: then
   the console may have died before it. *)
let missing_notes () =
  let random = Random.State.make [| 33 |] and r = Runs.run ~period:60. "tuple_space" in
  let refused = ref 0 in
  for _ = 1 to 300 do
    let lines = with_notes random r in
    let kept = 2 + Random.State.int random (List.length lines - 3) in
    let lines = List.filteri (fun i _ -> i < kept) lines in
    let notes = List.filter (fun i -> snd (List.nth lines i)) (List.init kept Fun.id) in
    (match read_lines r (List.map fst lines) with
     | Ok past -> if past.notes > List.length notes then Alcotest.fail "notes that are not there are counted"
     | Error trouble -> Alcotest.failf "whole: %a" Dolphin_runtime.Resumption.pp_trouble trouble);
    if notes <> [] then begin
      let first = List.nth notes (Random.State.int random (List.length notes)) in
      let also = Random.State.bool random in
      let is_gone i = i = first || (also && i > first && List.mem i notes && Random.State.bool random) in
      let gone = List.map is_gone (List.init kept Fun.id) in
      let unless_gone (line, _) gone = if gone then None else Some line in
      let left = List.filter_map Fun.id (List.map2 unless_gone lines gone) in
      let follows = List.exists (fun i -> i > first && not (List.nth gone i)) (List.init kept Fun.id) in
      match read_lines r left with
      | Error (No_run (Unreadable _)) when follows -> incr refused
      | Ok _ when not follows -> ()
      | Ok _ -> Alcotest.failf "without line %d of %d it is resumed" first kept
      | Error trouble -> Alcotest.failf "without line %d: %a" first Dolphin_runtime.Resumption.pp_trouble trouble
    end
  done;
  if !refused < 100 then Alcotest.failf "only %d runs were refused" !refused

(* {1 Acts of operators} *)

let draw_act random : Act.t =
  let deeds =
    [| Act.Start; Resume; Answer { question = "how many?"; text = "2" }; Post "go:1"; Stop { all = false };
       Stop { all = true }; Take_helm None; Take_helm (Some "rui"); Leave_helm |]
  in
  { operator = "ana"; role = "steer"; deed = deeds.(Random.State.int random (Array.length deeds)) }

(* The lines with acts of operators among them, wherever no event waits for its transition, and not after the end. *)
let with_acts random lines =
  let rec go = function
    | line :: rest -> (
        match Entry.of_string line with
        | Ok ((Header _ | Vehicle _ | Transition _ | Note _ | Act _ | Resumed _) as entry) ->
          let act _ = Entry.to_string (Act { time = Entry.time entry; act = draw_act random }) in
          (line :: List.init (Random.State.int random 3) act) @ go rest
        | Ok (Partial _ | Label _ | Event _ | End _) | Error _ -> line :: go rest)
    | [] -> []
  in
  go lines

(* A run with the acts of operators in its journal is the same run: it checks, and goes on as the one without. *)
let with_operators () =
  let one random name =
    let r = Runs.run ~period:60. name in
    let lines = Runs.lines r.journal in
    let whole = Runs.text (with_acts random lines) in
    (match Runs.check_text r whole with
     | Run _ -> ()
     | verdict -> Alcotest.failf "%s with operators: %s" name (show verdict));
    if not (has_supplier r) then begin
      let at = 1 + Random.State.int random (List.length lines - 1) in
      resumes r ~at (Runs.text (with_acts random (List.filteri (fun i _ -> i < at) lines)))
    end
  in
  let with_seed seed = List.iter (one (Random.State.make [| seed |])) Runs.examples in
  List.iter with_seed (Test_support.Property.seeds ~usual:35)

let () = Alcotest.run "resume" 
    [ ( "resume",
        [ case "after a sample of the lines of all examples" examples; case "cut at each byte" at_each_byte;
          case "without some notes of the platform" missing_notes;
          case "with acts of operators" with_operators ] ) ]
