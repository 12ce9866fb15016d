open Dolphin_json
open Lwt.Infix
open Exchange
module Response = Dolphin_http.Response

let not_busy subject h =
  match Session.analysis h subject with
  | Some a when Analysis.goes_on a -> refuse 409 "busy" "this goes on: one at a time"
  | Some _ | None -> Ok ()

(* An object in JSON, made by a worker from the output of the command. *)
let conclude h order ~text ~witness =
  let query = [ ("order", Canonical.to_string (Analysis.json_of_order order)) ] in
  let query = query @ Option.fold witness ~none:[] ~some:(fun path -> [ ("witness", path) ]) in
  let order = { Worker.task = "conclude"; workspace = Session.workspace h; query } in
  Worker_pool.whole (Session.own_workers h) ~client:"console" order ~body:text () >|= function
  | Ok { Response.status = 200; body = Text text; _ } -> Ok (String.trim text)
  | Ok _ -> Error "there is no result"
  | Error r -> Error r.message

let start subject h found =
  let* () = not_busy subject h in
  let* order = Analysis.order_of_json (`Assoc found) in
  let dolphin = (Session.settings h).dolphin in
  let changed () = Session.changed h in
  Session.set_analysis h subject (Analysis.start ~dolphin ~changed ~conclude:(conclude h order) order);
  Ok (`Assoc [])

let result subject h =
  let text = Option.fold (Session.analysis h subject) ~none:"null" ~some:Analysis.to_text in
  Response.text ~kind:"application/json" 200 (text ^ "\n")

let cancel subject h =
  Option.iter Analysis.cancel (Session.analysis h subject);
  Ok (`Assoc [])
