open Lwt.Infix
module Server = Dolphin_http.Server

type settings = Hall.settings = {
  folder : Folder.t;
  run : Dolphin_app.Run.settings;
  fleet : string option;
  dolphin : string;
  page : Page.t;
  tiles : string option;
  listen : Unix.inet_addr option;
  version : string;
  workers : Worker_pool.limits;
}

type t = { hall : Hall.t; server : Server.t }

let start settings ~port =
  let hall = Hall.make settings in
  (* The port that is had is known only then. *)
  let started server =
    Hall.served_at hall (Server.port server);
    { hall; server }
  in
  let rank r = Access.rank (Hall.access hall) r in
  Result.map started (Server.start ?address:settings.listen ~rank ~port (Api.reply hall))

let port c = Server.port c.server
let name settings =
  match settings.listen with
  | None -> "127.0.0.1"
  | Some address when address = Unix.inet_addr_any || address = Unix.inet6_addr_any -> Unix.gethostname ()
  | Some address ->
    let text = Unix.string_of_inet_addr address in
    if String.contains text ':' then "[" ^ text ^ "]" else text

let links c =
  let link token = Printf.sprintf "http://%s:%d/%s" (name (Hall.settings c.hall)) (port c) token in
  match (Hall.access c.hall).tokens with
  | None -> [ ("", link "") ]
  | Some { steer; watch } -> [ ("steers", link ("?token=" ^ steer)); ("watches", link ("?token=" ^ watch)) ]

let busy c = Hall.busy c.hall

let close c =
  List.iter Analysis.cancel (Hall.analyses c.hall);
  let over =
    match Hall.run c.hall with
    | Some run when Live_run.goes_on run -> Live_run.stop run Next; Live_run.finished run
    | Some _ | None -> Lwt.return_unit
  in
  over >>= fun () ->
  Hall.close c.hall;
  Server.close c.server

let workers c = Hall.worker_pids c.hall
