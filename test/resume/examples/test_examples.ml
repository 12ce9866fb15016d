(* Each example is resumed at each line of its journal. A console dies in the middle of that line, and another one goes
   on: the two write what one console writes that lives, on the same times. Time is virtual.

   Of a long journal a sample of lines is taken, at even distances. Of missions that adapt to events all lines are
   taken, and with DOLPHIN_RESUME=all, all programs. *)

open Dolphin_app

let lines_of path =
  let channel = open_in_bin path in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  List.filter (fun line -> line <> "") (String.split_on_char '\n' text)

let write path text =
  let channel = open_out_bin path in
  output_string channel text;
  close_out channel

let is_kind kind line =
  let mark = Printf.sprintf {|{"kind":"%s"|} kind in
  String.length line >= String.length mark && String.sub line 0 (String.length mark) = mark

let right = function Ok x -> x | Error e -> Alcotest.failf "%a" Error.pp e

(* {1 Runs} *)

let settings journal = { Run.simulated with recording = { Recording.nothing with journal = Some journal } }

let run (program : Program_file.t) journal =
  let fleet = right (Fleet_file.load_for ~program:program.path None) in
  let program = right (Program_file.within fleet program) in
  let interruption = Interruption.make () in
  ignore (right (Lwt_main.run (Run.start Run.unattended ~interruption (settings journal) program fleet)))

let resume program journal =
  let interruption = Interruption.make () in
  let run = Run.resume Run.unattended ~interruption (settings journal) ~changed:false ~fleet:None program journal in
  ignore (right (Lwt_main.run run))

(* {1 Where a console dies} *)

let few = 100
let adaptive = [ "escort"; "goals"; "replacement"; "retry"; "sampling"; "search" ]
let most name = if List.mem name adaptive || Sys.getenv_opt "DOLPHIN_RESUME" = Some "all" then max_int else 15_000

(* [some ~most lines is] is [is], or as many of them as make readers of all [lines] read [most], but a few. *)
let some ~most lines is =
  let many = List.length is in
  let wanted = min many (max 4 (most / Array.length lines)) in
  List.filteri (fun i _ -> (i + 1) * wanted / many > i * wanted / many) is

(* The lines, from 0, that a console dies in. Telemetry does not belong to the state: that of a long journal is left
   out. *)
let deaths ~most lines =
  let n = Array.length lines in
  some ~most lines (List.filter (fun i -> n <= few || not (is_kind "vehicle" lines.(i))) (List.init (n - 1) succ))

let torn lines i =
  let whole = Array.to_list (Array.sub lines 0 i) in
  String.concat "\n" whole ^ "\n" ^ String.sub lines.(i) 0 (String.length lines.(i) / 2)

(* A resumed run also has in its journal what it has heard of vehicles since the last lines on them. *)
let happened = List.filter (fun line -> not (is_kind "resumed" line || is_kind "vehicle" line))

let resumed_alike program journal lines i =
  write journal (torn lines i);
  resume program journal;
  let after = lines_of journal in
  let where = Printf.sprintf "%s, line %d" journal (i + 1) in
  if not (List.exists (is_kind "resumed") after) then Alcotest.failf "%s: nothing was resumed" where;
  if happened after <> happened (Array.to_list lines) then Alcotest.failf "%s: the run went on otherwise" where

let example path () =
  let name = Filename.remove_extension (Filename.basename path) in
  let program = right (Program_file.load path) in
  let journal = Filename.temp_file name ".run" in
  Sys.remove journal;
  run program journal;
  let lines = Array.of_list (lines_of journal) in
  List.iter (resumed_alike program journal lines) (deaths ~most:(most name) lines);
  Sys.remove journal

let programs folder =
  let folder = "../../../examples/" ^ folder in
  let files = List.sort String.compare (Array.to_list (Sys.readdir folder)) in
  let case file =
    Alcotest.test_case (Filename.chop_suffix file ".dol") `Quick (example (Filename.concat folder file)) in
  List.map case (List.filter (fun file -> Filename.check_suffix file ".dol") files)

let () =
  let group (name, folder) = (name, programs folder) in
  Alcotest.run "examples" (List.map group [ ("examples", "."); ("missions", "missions"); ("related", "related") ])
