open Lwt.Infix
module Server = Dolphin_http.Server

type settings = Session.settings = {
  folder : Folder.t;
  run : Dolphin_app.Run.settings;
  fleet : string option;
  dolphin : string;
  page : Page.t;
  tiles : string option;
  listen : Unix.inet_addr option;
  certificate : Certificate.t option;
  operators : Operators.operator list;
  proxy_header : string option;
  version : string;
  workers : Worker_pool.limits;
}

type t = { hall : Session.t; server : Server.t }

let start settings ~port =
  let hall = Session.make settings in
  (* The port that is had is known only then. *)
  let started server =
    Session.served_at hall (Server.port server);
    { hall; server }
  in
  let rank r = Access.rank (Session.access hall) r in
  let tls = Option.map (fun (c : Certificate.t) -> c.context) settings.certificate in
  Result.map started (Server.start ?address:settings.listen ?tls ~rank ~port (Api.reply hall))

let port c = Server.port c.server

let name = function
  | None -> "127.0.0.1"
  | Some address when address = Unix.inet_addr_any || address = Unix.inet6_addr_any -> Unix.gethostname ()
  | Some address -> Unix.string_of_inet_addr address

let links c =
  let settings = Session.settings c.hall and access = Session.access c.hall in
  let name = name settings.listen in
  let name = if String.contains name ':' then "[" ^ name ^ "]" else name in
  let link token =
    let plain = Printf.sprintf "%s://%s:%d/%s" (Access.scheme access) name (port c) token in
    Option.fold settings.certificate ~none:plain ~some:(fun c -> Certificate.with_fingerprint c plain)
  in
  let of_operator (o : Operators.operator) =
    let role = if o.admin then "administers" else Operators.role_name o.role in
    let whom = Option.fold o.name ~none:role ~some:(fun name -> Printf.sprintf "%s, who %s" name role) in
    (whom, link ("?token=" ^ o.token))
  in
  match access.operators with
  | operators when operators <> [] && access.proxy_header = None -> List.map of_operator operators
  | _ -> [ ("", link "") ]

let busy c = Session.busy c.hall

let close c =
  List.iter Analysis.cancel (Session.analyses c.hall);
  let over =
    match Session.run c.hall with
    | Some run when Live_run.goes_on run -> Live_run.stop run Next; Live_run.finished run
    | Some _ | None -> Lwt.return_unit
  in
  over >>= fun () ->
  Session.close c.hall >>= fun () ->
  Server.close c.server

let workers c = Session.worker_pids c.hall
