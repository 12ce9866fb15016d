open Lwt.Infix
module Child = Dolphin_runtime.Child
module Lines = Dolphin_runtime.Lines
module Host_value = Dolphin_json.Host_value

type process = { child : Child.t; lines : Lines.t }
type t = { command : string; timeout : float; mutable process : process option; mutable asked : int }

let make ~timeout command = { command; timeout; process = None; asked = 0 }

(* No reply is longer. *)
let longest_reply = 64 * 1024 * 1024
let deepest = 20_000

let start t =
  match t.process with
  | Some process -> Ok process
  | None ->
    let started child =
      let process = { child; lines = Lines.make ~limit:longest_reply (Child.output child) } in
      t.process <- Some process;
      process
    in
    Result.map started (Child.start ~environment:[] t.command)

let give_up t =
  match t.process with
  | None -> Lwt.return_unit
  | Some process ->
    t.process <- None;
    Child.close process.child

let rec write_all descriptor text from =
  if from = String.length text then Lwt.return_unit
  else
    Lwt_unix.write_string descriptor text from (String.length text - from) >>= fun n ->
    write_all descriptor text (from + n)

(* The outcome of a process that has gone silent. *)
let farewell process =
  Lwt.pick
    [ (Child.exited process.child >|= fun status -> Format.asprintf "it %a" Child.pp_status status);
      (Lwt_unix.sleep 1. >|= fun () -> "it closed its output") ]

let read_reply process id =
  Lines.next process.lines >>= function
  | Too_long -> Lwt.return_error "its reply is longer than 64 MB"
  | End_of_input -> farewell process >|= fun why -> Error (why ^ " without a reply")
  | Line line ->
    Lwt.return
      (match Host_value.parse ~deepest line with
       | Error why -> Error ("its reply is not JSON: " ^ why)
       | Ok (`Assoc members as reply) when List.assoc_opt "id" members = Some (`Int id) -> Ok reply
       | Ok (`Assoc _) -> Error (Printf.sprintf "its reply has not the id of the request, %d" id)
       | Ok _ -> Error "its reply is not an object")

let exchange t process id line =
  let answered =
    Lwt.catch
      (fun () -> write_all (Child.input process.child) line 0)
      (function Unix.Unix_error _ -> Lwt.return_unit | other -> Lwt.fail other)
    >>= fun () -> read_reply process id
  in
  let late =
    Lwt_unix.sleep t.timeout >|= fun () -> Error (Printf.sprintf "it did not reply within %g s" t.timeout) in
  Lwt.pick [ answered; late ] >>= function
  | Ok _ as reply -> Lwt.return reply
  | Error _ as trouble -> give_up t >|= fun () -> trouble

let ask t (request : Yojson.Safe.t) =
  match request, start t with
  | _, Error why -> Error why
  | (`Assoc members), Ok process ->
    t.asked <- t.asked + 1;
    let request = `Assoc (("id", `Int t.asked) :: members) in
    Lwt_main.run (exchange t process t.asked (Dolphin_json.Canonical.to_string request ^ "\n"))
  | _, Ok _ -> invalid_arg "Implementation.ask: no object"

let close t = Lwt_main.run (give_up t)
