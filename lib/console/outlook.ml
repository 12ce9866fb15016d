open Dolphin_json
open Lwt.Infix
open Exchange
module Response = Dolphin_http.Response

type t = { pool : Worker_pool.t; mutable latest : json; mutable is_closed : bool }

let to_json o = o.latest
let pids o = Worker_pool.pids o.pool

let close o =
  o.is_closed <- true;
  Worker_pool.close o.pool

let limits = { Worker_pool.limits with workers = 1; each = 1; waiting = 1 }

let failed why : json = `Assoc [ ("error", `String why) ]

(* A refusal has its sentence inside of a member of the same name. *)
let of_reply text : json =
  let error json = Result.bind (Field.members json) (Field.get Field.members "error") in
  match Host_value.parse (String.trim text) with
  | Error why -> failed why
  | Ok json ->
    let message = Result.bind (error json) (Field.get Field.text "message") in
    Result.fold message ~ok:failed ~error:(fun _ -> json)

let ask o ~workspace ~body =
  let order = { Worker.task = "outlook"; workspace; query = [] } in
  Worker_pool.whole o.pool ~client:"console" order ~body () >|= function
  | Ok { Response.body = Text text; _ } -> of_reply text
  | Ok { Response.body = Stream _; _ } -> failed "there is no result"
  | Error r -> failed r.message

(* Transitions that follow one another closely are looked at together, in seconds. *)
let collected = 0.5

(* The share of one core that the questions take at most: a tenth. *)
let rest_of elapsed = Float.max collected (9. *. elapsed)

let follow ~dolphin ~changed ~workspace run =
  let o = { pool = Worker_pool.make ~dolphin limits; latest = `Null; is_closed = false } in
  let set json =
    if json <> o.latest then begin
      o.latest <- json;
      changed ()
    end
  in
  let goes_on () = Live_run.goes_on run && not o.is_closed in
  let rec from_step step journal =
    Live_run.after run step >>= fun () ->
    Lwt.pick [ Lwt_unix.sleep collected; Live_run.finished run ] >>= fun () ->
    if not (goes_on ()) then Lwt.return_unit
    else begin
      let next = Live_run.steps run and began = Unix.gettimeofday () in
      let body = Canonical.to_string (Outlook_work.order ~program:(Live_run.program run) ~journal) in
      Lwt.pick [ (ask o ~workspace:(workspace ()) ~body >|= set); Live_run.finished run ] >>= fun () ->
      Lwt.pick [ Lwt_unix.sleep (rest_of (Unix.gettimeofday () -. began)); Live_run.finished run ] >>= fun () ->
      from_step next journal
    end
  in
  let ended () =
    set `Null;
    close o;
    Lwt.return_unit
  in
  let whole journal = Lwt.finalize (fun () -> from_step (-1) journal) ended in
  Option.iter (fun journal -> Lwt.async (fun () -> whole journal)) (Live_run.journal run);
  o
