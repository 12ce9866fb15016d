(* usage: mutants.exe drawn              COUNT mistakes (40), drawn by SEED (random), in files whose paths begin with
                                         one of FOLDERS (all)
          mutants.exe at FILE[:LINE]     every mistake there
          mutants.exe by-hand [TEXT...]  those of [Mistake] whose names or files contain one of these texts, or all
          mutants.exe --check            only that each of these can be made: the text that it replaces occurs once

   The exit status of [by-hand] is 0 if each is noticed by the test that must notice it. The other two report. *)

(* {1 By hand} *)

(* The positions at which [part] starts in [text]. *)
let occurrences part text =
  let n = String.length part in
  let rec from i found =
    if i + n > String.length text then List.rev found
    else from (i + 1) (if String.equal (String.sub text i n) part then i :: found else found)
  in
  from 0 []

let applied (mistake : Mistake.t) text =
  match occurrences mistake.find text with
  | [ i ] ->
    let after = i + String.length mistake.find in
    Ok (String.sub text 0 i ^ mistake.replace ^ String.sub text after (String.length text - after))
  | [] -> Error "the text that it replaces is not there"
  | _ :: _ :: _ -> Error "the text that it replaces is there more than once"

let chosen = function
  | [] -> Mistake.all
  | parts ->
    let is_of (m : Mistake.t) part = occurrences part m.name <> [] || occurrences part m.file <> [] in
    List.filter (fun m -> List.exists (is_of m) parts) Mistake.all

let check () =
  let is_wrong (mistake : Mistake.t) =
    match applied mistake (Working_copy.read mistake.file) with
    | Ok _ -> false
    | Error why -> Printf.printf "%s: %s: %s\n" mistake.file mistake.name why; true
  in
  if List.filter is_wrong Mistake.all <> [] then exit 1

let judged_by_hand copy (mistake : Mistake.t) =
  match applied mistake (Working_copy.source copy mistake.file) with
  | Error why -> "TROUBLE, " ^ why
  | Ok text -> (
      match Working_copy.judge copy ~file:mistake.file text ~tests:[ mistake.noticed_by ] with
      | Noticed _ -> "noticed"
      | Passed -> "NOT NOTICED"
      | Not_built -> "TROUBLE, it does not build")

let by_hand parts =
  let mistakes = chosen parts in
  let each copy unnoticed (mistake : Mistake.t) =
    let verdict = judged_by_hand copy mistake in
    Printf.printf "%-12s %s: %s\n%!" verdict mistake.file mistake.name;
    if String.equal verdict "noticed" then unnoticed else unnoticed + 1
  in
  let unnoticed = Working_copy.with_copy (fun copy -> List.fold_left (each copy) 0 mistakes) in
  Printf.printf "%d of %d mistakes noticed\n" (List.length mistakes - unnoticed) (List.length mistakes);
  if unnoticed > 0 then exit 1

(* {1 By syntax} *)

let judge copy (d : Drawn.t) =
  let source = Working_copy.source copy d.file in
  let text = Mutation.apply d.mutation source in
  let tests = Option.fold ~none:[] ~some:(fun (row : Judges.t) -> row.tests) (Judges.of_file d.file) in
  let verdict = Working_copy.judge copy ~file:d.file text ~tests in
  let kind = d.mutation.kind in
  let print word more = Printf.printf "%-9s %s:%d: %s%s\n%!" word d.file d.mutation.line (Mutation.name kind) more in
  (match verdict with
   | Noticed test -> print "noticed" (", by " ^ test)
   | Not_built -> print "not built" ""
   | Passed -> print "SURVIVED" (Printf.sprintf ": %s\n%s" (Mutation.meaning kind) (Mutation.difference source text)));
  verdict

let judge_all mistakes =
  if mistakes = [] then (print_endline "no place for a mistake there"; exit 2);
  let verdicts = Working_copy.with_copy (fun copy -> List.map (judge copy) mistakes) in
  let count is = List.length (List.filter is verdicts) in
  let noticed = count (function Working_copy.Noticed _ -> true | Passed | Not_built -> false) in
  let survived = count (fun verdict -> verdict = Passed) in
  Printf.printf "%d of %d mistakes noticed; %d drawn, %d survived, the others do not build\n" noticed (noticed + survived)
    (List.length verdicts) survived

let variable name = Option.value (Sys.getenv_opt name) ~default:""
let number name ~default = match int_of_string_opt (variable name) with Some n -> n | None -> default ()

let begins_with prefix file =
  String.length file >= String.length prefix && String.equal prefix (String.sub file 0 (String.length prefix))

let drawn () =
  let new_seed () = Random.self_init (); Random.int 1_000_000 in
  let seed = number "SEED" ~default:new_seed and count = number "COUNT" ~default:(fun () -> 40) in
  let folders = List.filter (( <> ) "") (String.split_on_char ' ' (variable "FOLDERS")) in
  let is_wanted file = folders = [] || List.exists (fun folder -> begins_with folder file) folders in
  Printf.printf "SEED=%d COUNT=%d\n%!" seed count;
  judge_all (Drawn.draw ~seed ~count ~is_wanted)

let () =
  match List.tl (Array.to_list Sys.argv) with
  | [ "--check" ] -> check ()
  | [ "drawn" ] -> drawn ()
  | [ "at"; place ] -> judge_all (Drawn.at place)
  | "by-hand" :: parts -> by_hand parts
  | _ -> prerr_endline "usage: mutants.exe drawn | at FILE[:LINE] | by-hand [TEXT...] | --check"; exit 2
