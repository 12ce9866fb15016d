open Cmdliner
open Dolphin_app

let tell ({ subject; found; advice; _ } : Doctor.finding) =
  let mark = if advice = None then "ok" else "--" in
  Printf.printf "%s  %-14s%s\n" mark subject found;
  Option.iter (Printf.printf "    %-14s%s\n" "") advice

let run () =
  Printf.printf "dolphin %s, built with OCaml %s, on %s (%d bits)\n" Version.number Sys.ocaml_version Sys.os_type
    Sys.word_size;
  let findings = Doctor.examine () in
  List.iter tell findings;
  let is_fatal ({ advice; is_needed; _ } : Doctor.finding) = advice <> None && is_needed in
  if List.exists is_fatal findings then Exit_status.Platform_trouble else Done

let man =
  [ `S Manpage.s_description;
    `P "$(tname) tells of what version $(mname) is, and what of this machine it can use: clocks, sockets, ports \
        and addresses by which vehicles are heard, the folder of runs, TLC. Below what is missing stands what that \
        means, and what to do. It sends nothing." ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "doctor" ~docs:Options.s_setup ~doc:"tell what is missing on this machine" ~man
      ~exits:(Options.exits [ Done; Platform_trouble; Bug ])
  in
  Cmd.v info Term.(const run $ const ())
