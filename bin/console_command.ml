open Cmdliner
open Dolphin_app
open Lwt.Infix
module Safe_print = Dolphin_display.Safe_print
module Access = Dolphin_console.Access
module Certificate = Dolphin_console.Certificate
module Console = Dolphin_console.Console
module Folder = Dolphin_console.Folder
module Operators = Dolphin_console.Operators
module Page = Dolphin_console.Page

let ( let* ) = Result.bind
let trouble result = Result.map_error (fun why -> Error.Bad_input why) result

(* On a desktop; without one, the address is printed. *)
let open_browser address =
  let is_set name = match Sys.getenv_opt name with Some "" | None -> false | Some _ -> true in
  if Unix.isatty Unix.stdout && (is_set "DISPLAY" || is_set "WAYLAND_DISPLAY") then
    try
      let null = Unix.openfile "/dev/null" [ O_RDWR; O_CLOEXEC ] 0 in
      ignore (Unix.create_process "xdg-open" [| "xdg-open"; address |] null null null);
      Unix.close null
    with Unix.Unix_error _ -> ()

let last_words = "interrupted twice: ended at once; vehicles not yet ordered to stop keep running"

let serve settings ~port ~browser =
  let* console =
    Result.map_error
      (fun why -> Error.Unavailable (Printf.sprintf "port %d cannot be had: %s" port why))
      (Console.start settings ~port)
  in
  let root = Folder.root settings.folder in
  let tell (role, link) =
    if role = "" then Safe_print.printf "The console of %s is at %s\n" root link
    else
      let whom = if String.contains role ' ' then role else "whoever " ^ role in
      Safe_print.printf "The console of %s, for %s: %s\n" root whom link
  in
  (* Before the address is printed: a reader of it may interrupt at once. *)
  let interruption = Interruption.make () in
  let again () =
    if Console.busy console && not (Run.is_simulated settings.run) then Report.complain last_words;
    Exit_status.exit_interrupted ()
  in
  Interruption.on_signals ~again interruption;
  let links = Console.links console in
  List.iter tell links;
  flush stdout;
  (* The arguments of a process are seen by all users of this machine: no token is among them. *)
  (match links with [ (_, link) ] when browser -> open_browser link | _ -> ());
  Lwt_main.run (Interruption.promise interruption >>= fun () -> Console.close console);
  Ok Exit_status.Done

(* A fleet that cannot be read is reported now, and not at the first run. *)
let check_fleet = function None -> Ok () | Some path -> Result.map ignore (Fleet_file.load (Some path))

(* Other machines reach it by TLS, unless that is not wanted. *)
let certificate_of listen files no_tls =
  match listen, files, no_tls with
  | None, None, false -> Ok None
  | None, _, _ -> Error (Error.Bad_input "--certificate and --no-tls go with --listen: other machines cannot connect")
  | Some _, None, true -> Ok None
  | Some _, Some _, true -> Error (Error.Bad_input "--certificate does not go with --no-tls")
  | Some _, None, false -> Result.map Option.some (Certificate.own ~name:(Console.name listen))
  | Some _, Some (certificate, key), false -> Result.map Option.some (Certificate.load ~certificate ~key)

(* The address, the certificate and the operators of the server. *)
type listening = {
  listen : Unix.inet_addr option;  (** [None]: 127.0.0.1 *)
  certificate : (string * string) option;  (** and its key, in files *)
  no_tls : bool;
  operators : string option;  (** a file *)
  proxy_header : string option;
}

(* Any client could write the header that a proxy writes: only this machine may connect. *)
let check_proxy { listen; operators; proxy_header; _ } =
  match proxy_header, operators, listen with
  | None, _, _ -> Ok ()
  | Some _, None, _ ->
    Error (Error.Bad_input "--proxy-user-header goes with --operators: their names are in the header")
  | Some _, Some _, Some address when not (Access.is_loopback address) ->
    Error
      (Error.Bad_input
         "--proxy-user-header goes with 127.0.0.1 or ::1 alone: elsewhere every client could send that header")
  | Some _, Some _, _ -> Ok ()

type asked = {
  folder : string;
  sim : string option;
  fleet : string option;
  run : Run.settings;  (** the names of its network are those of [definition] once it is read *)
  definition : string option;
  tiles : string option;
  listening : listening;
  port : int;
  browser : bool;
}

let run () { folder; sim; fleet; run; definition; tiles; listening; port; browser } =
  let { listen; certificate = files; no_tls; operators; proxy_header } = listening in
  let fleet = match fleet, sim with Some _, _ -> fleet | None, sim -> sim in
  Report.result
    (let* folder = trouble (Folder.make folder) in
     let* definition = Definition_file.load definition in
     let run = { run with network = Option.map (Imc_options.with_names definition) run.network } in
     let* () =
       if sim <> None && not (Run.is_simulated run) then
         Error
           (Error.Bad_input "vehicles of a network (--imc, --platform) are not simulated: --sim does not go with them")
       else check_fleet fleet
     in
     let* () = check_proxy listening in
     let* certificate = certificate_of listen files no_tls in
     let* operators =
       match listen, operators with
       | None, Some _ when proxy_header = None ->
         Error (Error.Bad_input "--operators goes with --listen: on 127.0.0.1 every client steers")
       | _, Some path -> Operators.load path
       | _, None -> Ok (Operators.anonymous ())
     in
     let settings =
       { Console.folder; run; fleet; dolphin = Sys.executable_name; page = Page.load (Page.folder ()); tiles; listen;
         certificate; operators; proxy_header; version = Version.number; workers = Dolphin_console.Worker_pool.limits }
     in
     serve settings ~port ~browser)

let folder =
  let doc = "The folder whose programs, fleets and journals are shown, by default the current one." in
  Arg.(value & pos 0 string "." & info [] ~docv:"DIR" ~doc)

let sim =
  let doc =
    "Run programs on the simulated fleet that the file $(docv) describes, unless the page names another. By default \
     each runs on that in the file beside it with the ending $(b,.fleet), or else on the built-in one."
  in
  Arg.(value & opt (some string) None & info [ "sim" ] ~docv:"FLEET" ~doc)

let port =
  let doc = "Serve port $(docv); 0 is any that is free." in
  let port = Options.between ~docv:"PORT" ~least:0 ~most:0xFFFF "a port" in
  Arg.(value & opt port 8642 & info [ "port" ] ~docv:"PORT" ~doc)

let tiles =
  let doc =
    "Show a map below the vehicles, of tiles from $(docv), such as $(b,https://tile.example/{z}/{x}/{y}.png). By default \
     the page loads nothing from elsewhere."
  in
  let parse url = Result.map_error (fun why -> `Msg why) (Dolphin_console.Access.check_tiles url) in
  let url = Arg.conv ~docv:"URL" (parse, Format.pp_print_string) in
  Arg.(value & opt (some url) None & info [ "tiles" ] ~docv:"URL" ~doc)

let listen =
  let doc =
    "Serve the address $(docv) of this machine, for other machines, instead of 127.0.0.1: $(b,0.0.0.0) is all of \
     them. Two links are printed, each with a token: one to steer, one to watch. Connections are encrypted by TLS, by \
     a self-signed certificate, made by $(b,openssl) and kept: its fingerprint is at the end of the links, and in the \
     browser's warning about it."
  in
  let parse text =
    match Unix.inet_addr_of_string text with
    | address -> Ok address
    | exception Failure _ -> Error (`Msg (Printf.sprintf "'%s' is not an address such as 192.168.1.5" text)) in
  let print ppf address = Format.pp_print_string ppf (Unix.string_of_inet_addr address) in
  Arg.(value & opt (some (conv ~docv:"ADDRESS" (parse, print))) None & info [ "listen" ] ~docv:"ADDRESS" ~doc)

let certificate =
  let doc =
    "With $(b,--listen): the certificate and the private key of TLS, in two files in PEM, such as \
     $(b,console.crt,console.key)."
  in
  Arg.(value & opt (some (pair file file)) None & info [ "certificate" ] ~docv:"CERT,KEY" ~doc)

let no_tls =
  let doc =
    "With $(b,--listen): connections are not encrypted. Tokens and all else can be read on the way: for use within a \
     VPN or a tunnel."
  in
  Arg.(value & flag & info [ "no-tls" ] ~doc)

let operators =
  let doc =
    "With $(b,--listen) or $(b,--proxy-user-header): print a link for each operator of $(docv), which has lines of a \
     name, a role ($(b,watch), $(b,answer), $(b,steer), $(b,admin)), perhaps with duties ($(b,answer,pilot)), and \
     perhaps a token of at least 16 characters that stays the same. Only its owner may be able to read it. The log and \
     the journal have the names with what operators do."
  in
  Arg.(value & opt (some file) None & info [ "operators" ] ~docv:"FILE" ~doc)

let proxy_header =
  let doc =
    "Take the name of an operator of $(b,--operators) from the header $(docv) of each request, such as \
     $(b,X-Forwarded-User), instead of a token. A reverse proxy on this machine sets it, and has to remove that of its \
     clients. Only on 127.0.0.1 or ::1."
  in
  let parse text = Result.map_error (fun why -> `Msg why) (Dolphin_console.Access.check_proxy_header text) in
  let name = Arg.conv ~docv:"HEADER" (parse, Format.pp_print_string) in
  Arg.(value & opt (some name) None & info [ "proxy-user-header" ] ~docv:"HEADER" ~doc)

let listening =
  let open Options.Syntax in
  let+ listen = listen
  and+ certificate = certificate
  and+ no_tls = no_tls
  and+ operators = operators
  and+ proxy_header = proxy_header in
  { listen; certificate; no_tls; operators; proxy_header }

let no_browser =
  let doc = "Open no browser." in
  Arg.(value & flag & info [ "no-browser" ] ~doc)

let supplier =
  let doc = "The command that starts the supplier of each run, as in $(mname) $(b,exec)." in
  Arg.(value & opt (some string) None & info [ "supplier" ] ~docv:"CMD" ~doc)

let supplier_timeout =
  let doc = "Give the supplier $(docv) seconds for each reply." in
  Arg.(value & opt (some (Options.positive ~docv:"SECONDS")) None & info [ "supplier-timeout" ] ~docv:"SECONDS" ~doc)

let asked =
  let open Options.Syntax in
  let+ folder = folder
  and+ sim = sim
  and+ fleet = Options.fleet
  and+ network = Imc_options.chosen
  and+ adapters = Platform_options.adapters
  and+ definition = Imc_options.definition
  and+ supplier = supplier
  and+ supplier_timeout = supplier_timeout
  and+ tiles = tiles
  and+ listening = listening
  and+ port = port
  and+ no_browser = no_browser in
  let run = { Run.simulated with network; adapters; supplier; supplier_timeout } in
  { folder; sim; fleet; run; definition; tiles; listening; port; browser = not no_browser }

let man =
  [ `S Manpage.s_description;
    `P "$(tname) shows the programs, fleets and runs of the folder $(i,DIR) in a browser: a map, a timeline, the log, \
        the events that the program waits for, an editor, the verdicts of $(mname) $(b,explore). Programs are started \
        there, on the simulated fleet, or with $(b,--imc) and $(b,--platform) on vehicles, and their questions are \
        answered there.";
    `P "A run belongs to the server: closing or reloading a page does not affect it, and several pages see the same. \
        One of them has the helm and commands. Every run has a journal, among those that $(mname) $(b,runs) lists; a \
        run whose console died can be resumed.";
    `P "Only this machine can connect, unless $(b,--listen) is given. Requests from other sites' pages in the same \
        browser are refused, and so are files outside $(i,DIR). Ctrl-C stops the run and ends the server when all \
        vehicles are released.";
    `P "The page is built separately, by $(b,scripts/console); the programming interface works without it. See \
        $(i,docs/console.md) and $(i,docs/api.md).";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Imc_options.s_network;
    `S Platform_options.s_platforms;
    `S Manpage.s_exit_status;
    `S Manpage.s_environment;
    `I ("$(b,DOLPHIN_CONSOLE)", "The folder of the built page, if it is elsewhere.");
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples\n  $(mname) $(tname) missions --imc --port 9000" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "console" ~docs:Options.s_run ~doc:"show and steer runs in a browser" ~man
      ~exits:(Options.exits [ Done; Bad_input; Platform_trouble; Bug; Interrupted ])
  in
  Cmd.v info Term.(const run $ Verbosity.setup $ asked)
