open Cmdliner

let reporter =
  let report src level ~over k message =
    message @@ fun ?header:_ ?tags:_ format ->
    (* Names and texts of vehicles, fleets and clients are part of messages. *)
    let finish text =
      Format.eprintf "%s@." (Dolphin_trace.Phrase.harmless text);
      over ();
      k ()
    in
    Format.kasprintf finish ("%s %s: @[<h>" ^^ format ^^ "@]") (Logs.Src.name src) (Logs.level_to_string (Some level))
  in
  { Logs.report }

let set verbose chosen =
  let by_count = match verbose with [] -> Logs.Warning | [ _ ] -> Info | _ :: _ :: _ -> Debug in
  Logs.set_level (Option.value chosen ~default:(Some by_count));
  Logs.set_reporter reporter

let verbose =
  let doc =
    "Log on standard error what is started. Twice, as $(b,-vv), the same as $(b,--verbosity debug): also every event, \
     transition and effect of the run, and on a network every datagram to and from vehicles, the assumed states of \
     vehicles, and timers."
  in
  Arg.(value & flag_all & info [ "v"; "verbose" ] ~doc)

let level =
  let parse text = Logs.level_of_string text in
  let print ppf level = Format.pp_print_string ppf (Logs.level_to_string level) in
  let doc = "The amount of logging on standard error: $(b,quiet), $(b,error), $(b,warning) (the default), $(b,info) \
             or $(b,debug)." in
  Arg.(value & opt (some (conv ~docv:"LEVEL" (parse, print))) None & info [ "verbosity" ] ~docv:"LEVEL" ~doc)

let setup = Term.(const set $ verbose $ level)
