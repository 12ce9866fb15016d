open Cmdliner
open Dolphin_results
open Dolphin_conformance

let ( let* ) = Result.bind

(* {1 Cases} *)

let is_case path = Filename.check_suffix path ".json"

(* Files as they are; of directories all cases inside, but for schemas. *)
let rec files path =
  if not (Sys.file_exists path) then Error (path ^ ": there is no such file or directory")
  else if not (Sys.is_directory path) then Ok [ path ]
  else
    let inside name =
      let path = Filename.concat path name in
      if Sys.is_directory path then if name = "schema" then Ok [] else files path
      else Ok (if is_case path then [ path ] else [])
    in
    let entries = Sys.readdir path in
    Array.sort String.compare entries;
    Results.concat_map inside (Array.to_list entries)

let read path =
  let* source = Text_file.read path in
  Result.map_error (fun why -> Printf.sprintf "%s: %s" path why) (Case.of_string ~path source)

let load paths =
  let* files = Results.concat_map files paths in
  let* cases = Results.map read files in
  if cases = [] then Error (String.concat ", " paths ^ ": there are no cases here") else Ok cases

(* {1 Implementations} *)

(* This very one, spoken to as others are but for the text. *)
let ourselves () : Dialogue.ask =
  let oracle = ref (Oracle.start ~name:("dolphin " ^ Version.number)) in
  fun request ->
    let after, reply = Oracle.answer !oracle request in
    oracle := after;
    Ok reply

let with_implementation command timeout f =
  match command with
  | None -> f (ourselves ())
  | Some command ->
    let implementation = Implementation.make ~timeout command in
    let finally () = Implementation.close implementation in
    (* It leads a session of its own, so Ctrl-C is for us alone, and we end it. *)
    List.iter (fun s -> Sys.set_signal s (Signal_handle (fun _ -> raise Sys.Break))) [ Sys.sigint; Sys.sigterm ];
    Fun.protect ~finally (fun () -> f (Implementation.ask implementation))

(* {1 The report} *)

let report verbose (case : Case.t) (verdict : Judge.verdict) passed =
  let kinds = List.sort_uniq compare (List.map (fun (f : Judge.failure) -> f.kind) verdict.failures) in
  let suffix = match kinds with [] -> "" | kinds -> ": " ^ String.concat ", " kinds in
  if passed then (if verbose then Printf.printf "passed %s%s\n" case.path suffix)
  else begin
    Printf.printf "failed %s%s\n" case.path suffix;
    Printf.printf "  %s\n" case.title;
    List.iter (fun (f : Judge.failure) -> Printf.printf "  %s: %s\n" f.kind f.why) verdict.failures;
    if case.fails <> [] then
      Printf.printf "  this case is wrong on purpose, in %s, and that was not noticed\n" (String.concat ", " case.fails)
  end;
  flush stdout

let judge_all verbose ask cases =
  let judge (passed, failed, matrix) (case : Case.t) =
    let verdict = Judge.judge ask case in
    let fine = Judge.passes case verdict in
    report verbose case verdict fine;
    let matrix =
      if case.fails <> [] then matrix
      else
        let name = Filename.(concat (basename (dirname case.path)) (remove_extension (basename case.path))) in
        Matrix.add ~name ~covers:case.covers ~taken:verdict.rules matrix
    in
    if fine then (passed + 1, failed, matrix) else (passed, failed + 1, matrix)
  in
  List.fold_left judge (0, 0, Matrix.empty) cases

let tell_matrix wanted matrix =
  if not wanted then true
  else begin
    Format.printf "%a@." Matrix.pp matrix;
    match Matrix.untaken matrix with
    | [] -> true
    | rules -> Format.printf "no case is about %s@." (String.concat ", " rules); false
  end

let bad why =
  Report.complain why;
  Exit_status.Bad_input

let judge_with ask ~named ~with_matrix ~verbose cases =
  match Dialogue.hello ask with
  | exception Dialogue.Trouble why -> bad ("the implementation does not speak the step protocol: " ^ why)
  | name ->
    if named then Printf.printf "%s\n%!" name;
    let passed, failed, matrix = judge_all verbose ask cases in
    let complete = tell_matrix with_matrix matrix in
    Printf.printf "%d passed, %d failed\n" passed failed;
    if failed = 0 && complete then Exit_status.Done else Exit_status.Violated

let run paths command timeout with_matrix verbose =
  match load paths with
  | Error why -> bad why
  | Ok cases -> (
      let judge ask = judge_with ask ~named:(command <> None) ~with_matrix ~verbose cases in
      match with_implementation command timeout judge with
      | status -> status
      | exception Sys.Break -> Exit_status.Interrupted)

(* {1 The command} *)

let paths =
  let doc = "Cases, or directories of cases. By default $(b,conformance), the corpus that comes with Dolphin." in
  Arg.(value & pos_all string [ "conformance" ] & info [] ~docv:"CASES" ~doc)

let implementation =
  let doc =
    "Judge the program that the shell command $(docv) starts, instead of Dolphin itself. It reads requests of the step \
     protocol from its standard input, and writes replies on its standard output."
  in
  Arg.(value & opt (some string) None & info [ "impl" ] ~docv:"CMD" ~doc)

let timeout =
  let doc = "Give the implementation up if it does not reply within $(docv) seconds." in
  Arg.(value & opt float 10. & info [ "impl-timeout" ] ~docv:"SECONDS" ~doc)

let matrix =
  let doc =
    "Print a line for each rule of the semantics: how many of the cases take it, and which ones are about it. A rule \
     that no case is about is a failure."
  in
  Arg.(value & flag & info [ "matrix" ] ~doc)

let verbose =
  let doc = "Tell of cases that pass, too." in
  Arg.(value & flag & info [ "v"; "verbose" ] ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) judges an implementation of Dolphin's semantics by the cases of a corpus. A case is a small program \
        with its world, and says what must be so: that the program is rejected, which run it has, which outcomes all \
        of its runs have, what it may and may not do. Cases in $(i,must-fail/) say what is not so: they pass if that \
        is noticed.";
    `P "For each case that fails it is told what was expected and what was seen; the last line counts. \
        $(i,conformance/INTERPRETING.md) describes cases and the step protocol.";
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname)\n  $(mname) $(tname) conformance/cases/until --verbose\n\
         \  $(mname) $(tname) --impl 'python3 my_dolphin.py'" ]
  @ Options.see_also

let exits =
  [ Cmd.Exit.info 0 ~doc:"all cases pass.";
    Cmd.Exit.info 1 ~doc:"some do not; or with $(b,--matrix), no case is about some rule.";
    Cmd.Exit.info 2 ~doc:"a case cannot be read, or the implementation does not speak the step protocol." ]
  @ Options.exits [ Bug; Interrupted ]

let command =
  let info = Cmd.info "conform" ~doc:"judge an implementation by a corpus of cases" ~man ~exits in
  Cmd.v info Term.(const run $ paths $ implementation $ timeout $ matrix $ verbose)
