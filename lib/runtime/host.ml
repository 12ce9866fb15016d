open Dolphin_semantics
open Dolphin_json
open Lwt.Infix

let ( let* ) = Result.bind
let ( let*? ) promise f = promise >>= function Ok x -> f x | Error why -> Lwt.return (Error why)

type t = {
  child : Child.t;
  replies : Lines.t;
  timeout : float option;
  mutable last_id : int;
  mutable broken : string option;  (* the reason why no more requests are sent *)
}

let version = "1"
let longest_reply = 1_048_576

(* How long what a dead host wrote, or the exit of one that closed its output, is waited for. *)
let aftermath = 1.

let start ?timeout ?(calls = 0) command =
  let* child = Child.start ~environment:[ ("DOLPHIN_SUPPLIER_PROTOCOL", version) ] command in
  let replies = Lines.make ~limit:longest_reply (Child.output child) in
  Ok { child; replies; timeout; last_id = calls; broken = None }

(* {1 Requests and replies} *)

let request id subject member arguments : (string, string) result =
  let* action =
    match arguments with
    | None -> Ok [ ("get", `String member) ]
    | Some xs ->
      let* arguments = Host_value.to_json (Core.List (Vector.of_list xs)) in
      Ok [ ("call", `String member); ("arguments", arguments) ]
  in
  let subject = match subject with None -> [] | Some name -> [ ("object", `String name) ] in
  Ok (Canonical.to_string (`Assoc ((("id", `Int id) :: subject) @ action)) ^ "\n")

let excerpt text =
  let text = if String.length text <= 60 then text else String.sub text 0 60 ^ "..." in
  Printf.sprintf "%S" text

(* [Ok (Error why)] is the host's own error. *)
let read_reply ~site id text =
  let wrong what = Error (Printf.sprintf "the host process replied %s, %s" (excerpt text) what) in
  let same = function
    | `Int id' when id = id' -> Ok ()
    | `Int id' -> wrong (Printf.sprintf "to request %d, but request %d is open" id' id)
    | _ -> wrong "whose id is not a whole number"
  in
  match Host_value.parse text with
  | Error why -> wrong (Printf.sprintf "which is not JSON: %s" why)
  | Ok (`Assoc fields) -> (
      let field name = List.assoc_opt name fields in
      match field "id", field "value", field "error" with
      | None, _, _ -> wrong "which has no id"
      | Some id, Some json, None ->
        let* () = same id in
        (match Host_value.of_json ~site json with
         | Ok x -> Ok (Ok x)
         | Error why -> wrong (Printf.sprintf "which is not a value for a program: %s" why))
      | Some id, None, Some (`String why) ->
        let* () = same id in
        Ok (Error why)
      | Some _, None, Some _ -> wrong "whose error is not a string"
      | Some _, Some _, Some _ -> wrong "which has a value and an error"
      | Some _, None, None -> wrong "which has neither a value nor an error")
  | Ok _ -> wrong "which is not an object"

(* {1 Speaking} *)

let status status = Error (Format.asprintf "the host process %a" Child.pp_status status)

(* The host takes no more requests, or gives no more replies. *)
let hung_up h =
  Lwt.pick
    [ (Child.exited h.child >|= status);
      (Lwt_unix.sleep aftermath >|= fun () -> Error "the host process closed its output") ]

let send h text =
  Lwt.catch
    (fun () -> Writer.write (Child.input h.child) text >|= Result.ok)
    (function Unix.Unix_error _ -> hung_up h | other -> Lwt.fail other)

let receive h =
  Lines.next h.replies >>= function
  | Line text -> Lwt.return (Ok text)
  | Too_long -> Lwt.return (Error (Printf.sprintf "the host process's reply is longer than %d bytes" longest_reply))
  | End_of_input -> hung_up h

(* Another process may keep the dead host's output open. *)
let death h =
  Child.exited h.child >>= fun s ->
  Lwt_unix.sleep aftermath >|= fun () -> status s

let lateness h =
  match h.timeout with
  | None -> []
  | Some seconds ->
    [ (Lwt_unix.sleep seconds >|= fun () ->
       Error (Printf.sprintf "the host process did not reply within %g seconds" seconds)) ]

let exchange h ~site id text =
  let reply =
    let*? () = send h text in
    let*? line = receive h in
    Lwt.return (read_reply ~site id line)
  in
  Lwt.pick (reply :: death h :: lateness h)

let break h why = if h.broken = None then h.broken <- Some why

let speak h ~site id text =
  Lwt.catch
    (fun () -> exchange h ~site id text)
    (fun error ->
       break h "an earlier call was interrupted";
       Lwt.fail error)
  >|= function
  | Ok reply -> reply
  | Error why ->
    break h why;
    Error why

let call h ~site ~subject ~member ~arguments =
  match h.broken, request (h.last_id + 1) subject member arguments with
  | Some why, _ | None, Error why -> Lwt.return (Error why)
  | None, Ok text ->
    h.last_id <- h.last_id + 1;
    speak h ~site h.last_id text

let close h =
  break h "the host process is closed";
  Child.close h.child
