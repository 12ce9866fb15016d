open Cmdliner
open Dolphin_app
open Dolphin_conformance
module Safe_print = Dolphin_display.Safe_print

(* {1 The report} *)

(* Cases, and what an implementation replies, may have anything in their texts. *)
let print format = Safe_print.printf format

let report verbose ({ case; verdict; passed } : Corpus.judged) =
  let kinds = List.sort_uniq compare (List.map (fun (f : Judge.failure) -> f.kind) verdict.failures) in
  let suffix = match kinds with [] -> "" | kinds -> ": " ^ String.concat ", " kinds in
  if passed then (if verbose then print "passed %s%s\n" case.path suffix)
  else begin
    print "failed %s%s\n" case.path suffix;
    print "  %s\n" case.title;
    List.iter (fun (f : Judge.failure) -> print "  %s: %s\n" f.kind f.why) verdict.failures;
    if case.fails <> [] then
      print "  this case is wrong on purpose, in %s, and that was not noticed\n" (String.concat ", " case.fails)
  end;
  flush stdout

let report_matrix wanted matrix =
  if not wanted then true
  else begin
    Safe_print.format "%a@." Matrix.pp matrix;
    match Matrix.untaken matrix with
    | [] -> true
    | rules -> Safe_print.format "no case is about %s@." (String.concat ", " rules); false
  end

let judge_with ask ~named ~with_matrix ~verbose cases : (Exit_status.t, Error.t) result =
  match Dialogue.hello ask with
  | exception Dialogue.Trouble why ->
    Error (Error.Bad_input ("the implementation does not speak the step protocol: " ^ why))
  | name ->
    if named then (print "%s\n" name; flush stdout);
    let judged, matrix = Corpus.judge ask (report verbose) cases in
    let complete = report_matrix with_matrix matrix in
    let passed, failed = List.partition (fun (j : Corpus.judged) -> j.passed) judged in
    Safe_print.printf "%d passed, %d failed\n" (List.length passed) (List.length failed);
    Ok (if failed = [] && complete then Done else Violated)

type asked = { paths : string list; command : string option; timeout : float; with_matrix : bool; verbose : bool }

let run { paths; command; timeout; with_matrix; verbose } =
  let judge cases =
    Corpus.with_implementation ~name:("dolphin " ^ Version.number) ~timeout command (fun ask ->
        judge_with ask ~named:(command <> None) ~with_matrix ~verbose cases)
  in
  match Report.result (Result.bind (Corpus.load paths) judge) with
  | status -> status
  | exception Sys.Break -> Exit_status.Interrupted

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
  let doc = "Give up on the implementation if it does not reply within $(docv) seconds." in
  Arg.(value & opt float 10. & info [ "impl-timeout" ] ~docv:"SECONDS" ~doc)

let matrix =
  let doc =
    "Print a line for each rule of the semantics: the number of cases that use it, and the cases about it. A rule \
     without a case about it is a failure."
  in
  Arg.(value & flag & info [ "matrix" ] ~doc)

let verbose =
  let doc = "Print cases that pass, too." in
  Arg.(value & flag & info [ "v"; "verbose" ] ~doc)

let asked =
  let open Options.Syntax in
  let+ paths = paths
  and+ command = implementation
  and+ timeout = timeout
  and+ with_matrix = matrix
  and+ verbose = verbose in
  { paths; command; timeout; with_matrix; verbose }

let man =
  [ `S Manpage.s_description;
    `P "$(tname) judges an implementation of Dolphin's semantics by the cases of a corpus. A case is a small program \
        with its world and its expectations: that the program is rejected, one of its runs, the outcomes of all its \
        runs, possible and impossible steps, earliest and latest dates. The expectations in $(i,must-fail/) are \
        wrong: these cases pass if that is noticed.";
    `P "For each case that fails, the expected and the actual result are printed; the last line counts the cases. \
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
  let info =
    Cmd.info "conform" ~docs:Options.s_others ~doc:"judge an implementation by a corpus of cases" ~man ~exits
  in
  Cmd.v info Term.(const run $ asked)
