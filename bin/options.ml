open Cmdliner

module Syntax = struct
  let ( let+ ) term f = Term.(const f $ term)
  let ( and+ ) a b = Term.(const (fun a b -> (a, b)) $ a $ b)
end

let program =
  let doc = "The program, a file such as $(i,mission.dol)." in
  Arg.(required & pos 0 (some string) None & info [] ~docv:"PROG" ~doc)

let fleet =
  let doc = "The fleet, a file such as $(i,mission.fleet). By default the file beside $(i,PROG) with that ending." in
  Arg.(value & opt (some string) None & info [ "fleet" ] ~docv:"FLEET" ~doc)

let set_of doc =
  let parse text =
    match String.index_opt text '=' with
    | Some i when i > 0 -> Ok (String.sub text 0 i, String.sub text (i + 1) (String.length text - i - 1))
    | Some _ | None -> Error (`Msg (Printf.sprintf "'%s' is not written NAME=VALUE, as in n=5" text))
  in
  let setting = Arg.conv ~docv:"NAME=VALUE" (parse, fun ppf (x, value) -> Format.fprintf ppf "%s=%s" x value) in
  Arg.(value & opt_all setting [] & info [ "set" ] ~docv:"NAME=VALUE" ~doc)

let set_doc =
  "Give the program's parameter $(i,NAME) another value. May be repeated. $(mname) $(b,help) $(i,PROG) lists the \
   parameters."

let set = set_of set_doc

let set_range =
  set_of
    (set_doc
     ^ " For a whole number, $(i,VALUE) may be a range, such as $(b,1..8): then each value is analysed, and the answer \
        is a table, the least value for which all holds, and a run that violates a property with one less.")

let layers =
  let doc =
    Printf.sprintf
      "Draw the features of the map $(docv) below the ways: a coast, an area of work. As for $(b,map) of programs, it \
       is GeoJSON, KML, KMZ, GPX, a plan of QGroundControl or a mission of Neptus (%s). May be repeated."
      (String.concat ", " Dolphin_maps.Map_file.formats)
  in
  Arg.(value & opt_all string [] & info [ "layer" ] ~docv:"FILE" ~doc)

let drawing =
  let parse path = Result.map_error (fun why -> `Msg why) (Dolphin_app.Drawing.of_path path) in
  Arg.conv ~docv:"FILE" (parse, fun ppf d -> Format.pp_print_string ppf (Dolphin_app.Drawing.path d))

let whole ~docv what =
  let parse text =
    match int_of_string_opt text with
    | Some n when n > 0 -> Ok n
    | Some _ | None -> Error (`Msg (Printf.sprintf "'%s' is %s" text what))
  in
  Arg.conv ~docv (parse, Format.pp_print_int)

let between ~docv ~least ~most what =
  let parse text =
    match int_of_string_opt text with
    | Some n when n >= least && n <= most -> Ok n
    | Some _ | None -> Error (`Msg (Printf.sprintf "'%s' is not %s, from %d to %d" text what least most))
  in
  Arg.conv ~docv (parse, Format.pp_print_int)

let number ~docv what accepts =
  let parse text =
    match float_of_string_opt text with
    | Some x when accepts x -> Ok x
    | Some _ | None -> Error (`Msg (Printf.sprintf "'%s' is not %s" text what))
  in
  Arg.conv ~docv (parse, Format.pp_print_float)

let positive ~docv = number ~docv "a number greater than 0" (fun x -> x > 0. && x < infinity)

let workers ~doc =
  let cores = Dolphin_checker.Shared_memory.machine_cores () in
  let processes = whole ~docv:"N" "not a number from 1 on" in
  Arg.(value & opt processes cores & info [ "workers" ] ~docv:"N" ~absent:"the number of cores" ~doc)

let s_write = "WRITE A PROGRAM"
let s_prove = "KNOW WHAT IT MAY DO"
let s_run = "RUN IT"
let s_runs = "SEE WHAT HAPPENED"
let s_others = "FOR OTHER PROGRAMS"
let s_setup = "GET STARTED"

let exits = Exit_status.info

let see_also =
  [ `S Manpage.s_see_also;
    `P "The reference manual of the language, of fleets and of the supplier's protocol is $(i,docs/language.md); \
        $(i,examples/) has a program for every construct." ]

let from doc =
  let doc =
    doc
    ^ " $(docv) is the run's name or a prefix of it, $(b,latest), or the path of a journal; the run may continue \
       meanwhile. $(i,PROG) may differ from the run's program, if the run so far is the beginning of a run of \
       $(i,PROG) too: so a change is checked before the run is resumed with it. By default the fleet is that of the \
       run."
  in
  Arg.(value & opt (some string) None & info [ "from" ] ~docv:"RUN" ~doc)
