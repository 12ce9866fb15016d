open Cmdliner
open Dolphin_app

(* Made here, or read where they were made. *)
type source = Made of { runs : int option; until : float option; jobs : int option } | Read of string

type output = People | Json | Each
type t = { source : source; output : output }

let s_many = "MANY RUNS"

(* {1 Options} *)

let natural = Options.whole ~docv:"N" "not a whole number greater than 0"

let runs =
  let doc = "Make $(docv) simulated runs with different seeds, and summarise their endings." in
  Arg.(value & opt (some natural) None & info [ "runs" ] ~docs:s_many ~docv:"N" ~doc)

let until =
  let accuracy = Options.number ~docv:"X" "a number between 0 and 0.5" (fun x -> x > 0. && x < 0.5) in
  let doc =
    "Make runs until the share of those that complete is known to within $(docv), such as 0.01, with 95 % confidence; \
     with $(b,--runs), $(i,N) at most. The share is checked after 100 runs, and then after every further quarter; all \
     checks together have that confidence, so intervals are a little wider than with $(b,--runs) alone."
  in
  Arg.(value & opt (some accuracy) None & info [ "until" ] ~docs:s_many ~docv:"X" ~doc)

let jobs =
  let doc = "Use $(docv) processes, by default as many as there are processors. The answer does not depend on it." in
  Arg.(value & opt (some natural) None & info [ "jobs" ] ~docs:s_many ~docv:"N" ~doc)

let json =
  Arg.(value & flag & info [ "json" ] ~docs:s_many ~doc:"With $(b,--runs): print the answer as one JSON object.")

let each =
  let doc =
    "With $(b,--runs): print a line of JSON for each run, in the order of seeds, instead of an answer about all of \
     them. The first line is a header. $(i,docs/time.md) describes the members."
  in
  Arg.(value & flag & info [ "each" ] ~docs:s_many ~doc)

let runs_from =
  let doc =
    "Make no runs, but count those that $(b,--each) printed into the file $(docv), or, if it is $(b,-), on standard \
     input: the outputs of several machines, concatenated in the order of their seeds. $(i,PROG), the fleet, \
     $(b,--set) and $(b,--answer) are those of the runs."
  in
  Arg.(value & opt (some string) None & info [ "runs-from" ] ~docs:s_many ~docv:"FILE" ~doc)

let wanted =
  let make runs until jobs json each from =
    match from, runs, until with
    | Some _, _, _ when runs <> None || until <> None || jobs <> None || each ->
      Error (`Msg "--runs-from makes no runs: it excludes --runs, --until, --jobs and --each")
    | None, None, None when jobs <> None || json || each ->
      Error (`Msg "--jobs, --json and --each go with --runs or --until")
    | None, None, None -> Ok None
    | _, _, _ when json && each -> Error (`Msg "--json is one answer, --each a line for each run: give one of them")
    | _, _, _ ->
      let source = match from with Some path -> Read path | None -> Made { runs; until; jobs } in
      Ok (Some { source; output = (if json then Json else if each then Each else People) })
  in
  Term.term_result ~usage:true Term.(const make $ runs $ until $ jobs $ json $ each $ runs_from)

(* {1 Runs} *)

let progress ~live ~most =
  let shown = ref 0. in
  fun n ->
    let now = Unix.gettimeofday () in
    if live && now -. !shown > 0.1 then begin
      shown := now;
      let most = Option.fold most ~none:"" ~some:(Printf.sprintf " of %d") in
      Printf.eprintf "\r%d%s runs\027[K%!" n most
    end

let heed_interruption () =
  let interrupted = ref false in
  let interrupt = Sys.Signal_handle (fun _ -> interrupted := true) in
  let open Dolphin_processes.Ending_signals in
  List.iter (fun signal -> Sys.set_signal signal interrupt) (requests @ others);
  fun () -> !interrupted

let sampled t ~seed ~answers program fleet =
  let header = Sample_lines.header ~version:Version.number ~answers program fleet in
  match t.source with
  | Read path -> Sampling.count ~answers (Sample_lines.read ~header path)
  | Made { runs; until; jobs } ->
    let live = Unix.isatty Unix.stderr && t.output = People in
    let print line = if t.output = Each then (print_string (line ()); print_char '\n') in
    let each ~seed sample = print (fun () -> Sample_lines.of_sample program ~seed sample) in
    print (fun () -> header);
    let settings : Sampling.settings =
      { seed = Option.value seed ~default:0; runs; until; jobs = Option.value jobs ~default:(Processors.count ());
        answers }
    in
    let progress = progress ~live ~most:runs in
    let s = Sampling.run ~interrupted:(heed_interruption ()) ~progress ~each settings program fleet in
    if live then prerr_string "\r\027[K";
    s

let check t ~drawing ~seed =
  match t with
  | { source = Read _; _ } when seed <> None -> Error (Error.Bad_input "--runs-from makes no runs: --seed has no use")
  | { output = Each; _ } when drawing <> None ->
    Error (Error.Bad_input "--each prints runs and draws none: use --runs-from to draw them")
  | _ -> Ok ()

let draw program s drawing =
  Drawing.write_text drawing
    ~svg:(fun () -> Sampling_picture.svg program s)
    ~html:(fun () -> Sampling_picture.html program s)

let print t program s =
  match t.output with
  | People -> Sampling_report.print program s
  | Json -> print_endline (Dolphin_json.Canonical.to_string (Sampling_report.to_json program s))
  | Each -> ()

let run t ~drawing ~seed ~answers program fleet =
  let status (s : Sampling.t) =
    let drawn = Option.fold drawing ~none:(Ok ()) ~some:(draw program s) in
    print t program s;
    let status : Exit_status.t = match s.stop with Interrupted _ -> Interrupted | All | Known -> Done in
    Result.map (fun () -> status) drawn
  in
  Result.bind (check t ~drawing ~seed) (fun () -> Result.bind (sampled t ~seed ~answers program fleet) status)
