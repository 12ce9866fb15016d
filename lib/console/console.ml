open Lwt.Infix
module Server = Dolphin_http.Server

type settings = Hall.settings = {
  folder : Folder.t;
  run : Dolphin_app.Run.settings;
  fleet : string option;
  dolphin : string;
  page : Page.t;
  version : string;
}

type t = { hall : Hall.t; server : Server.t }

let start settings ~port =
  let hall = Hall.make settings in
  (* The port that is had is known only then. *)
  let had = ref port in
  let reply r = Api.reply hall ~port:!had r in
  let started server =
    had := Server.port server;
    { hall; server }
  in
  Result.map started (Server.start ~port reply)

let port c = Server.port c.server
let busy c = Hall.busy c.hall

let close c =
  List.iter Analysis.cancel (Hall.analyses c.hall);
  let over =
    match Hall.run c.hall with
    | Some run when Live_run.goes_on run -> Live_run.stop run; Live_run.finished run
    | Some _ | None -> Lwt.return_unit
  in
  over >>= fun () -> Server.close c.server
