(* usage: mutants.exe [TEXT...]: the mistakes whose names or files contain one of these texts, or all.

   The exit status is 0 if each is noticed by the test that must notice it.

   mutants.exe --check only checks that each can be made: the text that it replaces occurs once. *)

open Mistake

let read path =
  let channel = open_in_bin path in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

let write path text =
  let channel = open_out_bin path in
  output_string channel text;
  close_out channel

(* {1 One mistake} *)

(* The positions at which [part] starts in [text]. *)
let occurrences part text =
  let n = String.length part in
  let rec from i found =
    if i + n > String.length text then List.rev found
    else from (i + 1) (if String.equal (String.sub text i n) part then i :: found else found)
  in
  from 0 []

let applied mistake text =
  match occurrences mistake.find text with
  | [ i ] ->
    let after = i + String.length mistake.find in
    Ok (String.sub text 0 i ^ mistake.replace ^ String.sub text after (String.length text - after))
  | [] -> Error "the text that it replaces is not there"
  | _ :: _ :: _ -> Error "the text that it replaces is there more than once"

let shell format = Printf.ksprintf (fun command -> Sys.command command = 0) format

let build tree target = shell "dune build --root %s %s >%s/build.log 2>&1" tree target tree

(* A mistake may make a test run or wait without end, or take all memory. The limit is in seconds of CPU, so that
   other load makes no test fail. Random tests take their usual inputs, which are known to notice it. *)
let run tree target =
  let within = "unset SEED DOLPHIN_SEED; ulimit -v 4000000; ulimit -t 100; timeout 1000" in
  shell "cd %s/%s && (%s %s/_build/default/%s >%s/run.log 2>&1)" tree (Filename.dirname target) within tree target tree

type verdict = Noticed | Not_noticed | Trouble of string

let judged tree mistake =
  let path = Filename.concat tree mistake.file in
  let text = read path in
  let target = Printf.sprintf "test/%s.exe" mistake.noticed_by in
  let verdict =
    match applied mistake text with
    | Error why -> Trouble why
    | Ok wrong ->
      write path wrong;
      if not (build tree target) then Trouble "it does not build"
      else if run tree target then Not_noticed
      else Noticed
  in
  write path text;
  verdict

(* {1 All} *)

let chosen =
  match List.tl (Array.to_list Sys.argv) with
  | [] -> all
  | parts ->
    let is_of m part = occurrences part m.name <> [] || occurrences part m.file <> [] in
    List.filter (fun m -> List.exists (is_of m) parts) all

(* Tests that fail anyway would notice anything. *)
let sound tree =
  let targets = List.sort_uniq String.compare (List.map (fun m -> m.noticed_by) chosen) in
  let is_sound target =
    let target = Printf.sprintf "test/%s.exe" target in
    let sound = build tree target && run tree target in
    if not sound then Printf.printf "%s fails without any mistake\n%!" target;
    sound
  in
  List.for_all is_sound targets

let check () =
  let tell mistake why = Printf.printf "%s: %s: %s\n" mistake.file mistake.name why; true in
  let is_wrong mistake = Result.fold (applied mistake (read mistake.file)) ~ok:(fun _ -> false) ~error:(tell mistake) in
  if List.filter is_wrong all <> [] then exit 1

let make_all () =
  let tree = Filename.temp_file "mutants" "" in
  Sys.remove tree;
  Unix.mkdir tree 0o700;
  at_exit (fun () -> ignore (shell "rm -rf %s" tree));
  if not (shell "tar --exclude=./_build --exclude='./.[a-z]*' -cf - . | tar -xf - -C %s" tree && sound tree) then exit 2;
  let each unnoticed mistake =
    let tell what = Printf.printf "%-12s %s: %s\n%!" what mistake.file mistake.name in
    match judged tree mistake with
    | Noticed -> tell "noticed"; unnoticed
    | Not_noticed -> tell "NOT NOTICED"; unnoticed + 1
    | Trouble why -> tell ("TROUBLE, " ^ why); unnoticed + 1
  in
  let unnoticed = List.fold_left each 0 chosen in
  Printf.printf "%d of %d mistakes noticed\n" (List.length chosen - unnoticed) (List.length chosen);
  if unnoticed > 0 then exit 1

let () = match Array.to_list Sys.argv with [ _; "--check" ] -> check () | _ -> make_all ()
