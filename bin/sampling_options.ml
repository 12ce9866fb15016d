open Cmdliner
open Dolphin_app

type t = { runs : int option; until : float option; jobs : int option; json : bool }

let s_many = "MANY RUNS"

(* {1 Options} *)

let natural = Options.whole ~docv:"N" "not a whole number greater than 0"

let runs =
  let doc = "Make $(docv) simulated runs with different seeds, and say what became of all of them." in
  Arg.(value & opt (some natural) None & info [ "runs" ] ~docs:s_many ~docv:"N" ~doc)

let until =
  let accuracy = Options.number ~docv:"X" "a number between 0 and 0.5" (fun x -> x > 0. && x < 0.5) in
  let doc =
    "Make runs until the share of those that complete is known to within $(docv), such as 0.01, with 95 % confidence; \
     with $(b,--runs), $(i,N) at most. It looks after 100 runs, and then each time when there are a quarter more; all \
     looks together have that confidence, so that intervals are a little wider than with $(b,--runs) alone."
  in
  Arg.(value & opt (some accuracy) None & info [ "until" ] ~docs:s_many ~docv:"X" ~doc)

let jobs =
  let doc = "Use $(docv) processes, by default as many as there are processors. The answer does not depend on it." in
  Arg.(value & opt (some natural) None & info [ "jobs" ] ~docs:s_many ~docv:"N" ~doc)

let json =
  Arg.(value & flag & info [ "json" ] ~docs:s_many ~doc:"With $(b,--runs): print the answer as one JSON object.")

let wanted =
  let make runs until jobs json =
    match runs, until with
    | None, None when jobs <> None || json -> Error (`Msg "--jobs and --json go with --runs or --until")
    | None, None -> Ok None
    | _, _ -> Ok (Some { runs; until; jobs; json })
  in
  Term.term_result ~usage:true Term.(const make $ runs $ until $ jobs $ json)

(* {1 Runs} *)

let progress ~live ~most =
  let told = ref 0. in
  fun n ->
    let now = Unix.gettimeofday () in
    if live && now -. !told > 0.1 then begin
      told := now;
      let most = Option.fold most ~none:"" ~some:(Printf.sprintf " of %d") in
      Printf.eprintf "\r%d%s runs\027[K%!" n most
    end

let run t ~drawing ~seed ~answers program fleet =
  let live = Unix.isatty Unix.stderr && not t.json in
  let interrupted = ref false in
  let interrupt = Sys.Signal_handle (fun _ -> interrupted := true) in
  List.iter (fun signal -> Sys.set_signal signal interrupt) [ Sys.sigint; Sys.sigterm ];
  let settings : Sampling.settings =
    { seed; runs = t.runs; until = t.until; jobs = Option.value t.jobs ~default:(Processors.count ()); answers }
  in
  let sampled =
    Sampling.run ~interrupted:(fun () -> !interrupted) ~progress:(progress ~live ~most:t.runs) settings program fleet in
  if live then prerr_string "\r\027[K";
  let draw program s drawing =
    Drawing.write_text drawing
      ~svg:(fun () -> Sampling_picture.svg program s)
      ~html:(fun () -> Sampling_picture.html program s)
  in
  let status (s : Sampling.t) =
    let drawn = Option.fold drawing ~none:(Ok ()) ~some:(draw program s) in
    if t.json then print_endline (Yojson.Safe.to_string (Sampling_report.to_json program s))
    else Sampling_report.print program s;
    let status : Exit_status.t = match s.stop with Interrupted _ -> Interrupted | All | Known -> Done in
    Result.map (fun () -> status) drawn
  in
  Result.bind sampled status
