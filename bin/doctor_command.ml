open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print

let tell ({ subject; found; advice; _ } : Doctor.finding) =
  let mark = if advice = None then "ok" else "--" in
  Safe_print.printf "%s  %-14s%s\n" mark subject found;
  Option.iter (Safe_print.printf "    %-14s%s\n" "") advice

let run () =
  Safe_print.printf "dolphin %s, built with OCaml %s, on %s (%d bits)\n" Version.number Sys.ocaml_version Sys.os_type
    Sys.word_size;
  let findings = Doctor.examine ~page:(Dolphin_console.Page.folder ()) in
  List.iter tell findings;
  let is_fatal ({ advice; is_needed; _ } : Doctor.finding) = advice <> None && is_needed in
  if List.exists is_fatal findings then Exit_status.Platform_trouble else Done

let man =
  [ `S Manpage.s_description;
    `P "$(tname) prints the version of $(mname), and the resources that it finds on this machine: clocks, sockets, \
        ports and addresses for hearing vehicles, the folder of runs, the page of the console, TLC. Each missing item \
        comes with its consequence and the remedy. $(tname) sends nothing." ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "doctor" ~docs:Options.s_setup ~doc:"report missing requirements of this machine" ~man
      ~exits:(Options.exits [ Done; Platform_trouble; Bug ])
  in
  Cmd.v info Term.(const run $ const ())
