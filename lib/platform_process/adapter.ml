open Dolphin_runtime
open Dolphin_platform_protocol
open Lwt.Infix
module Order = Dolphin_platform_protocol.Order

type t = {
  child : Child.t;
  lines : Lines.t;
  writer : Writer.t;
}

type line = Report of Report.t | Garbage of string

let greeting_patience = 10.

(* The time in which an adapter that closed its output must exit, and the last output of one that is gone. *)
let aftermath = 1.

(* That it reads no more shows in that it is gone. *)
let send a line = Writer.send a.writer line

(* {1 Reading} *)

let status status = Format.asprintf "%a" Child.pp_status status

let gone a =
  Lwt.pick [ (Child.exited a.child >|= status); (Lwt_unix.sleep aftermath >|= fun () -> "closed its output") ]

(* Another process may keep the output of one that is gone open. *)
let death a =
  Child.exited a.child >>= fun s ->
  Lwt_unix.sleep aftermath >|= fun () -> status s

(* The number of lines that are read before other adapters have their turn. *)
let most_at_once = 64

let listen a f =
  let rec go n =
    Lines.next a.lines >>= function
    | End_of_input -> gone a
    | Too_long ->
      f (Garbage (Printf.sprintf "is longer than %d bytes" Report.longest_line));
      go (n + 1)
    | Line text ->
      (match Report.of_line text with
       | Ok (Some report) -> f (Report report)
       | Ok None -> ()
       | Error why -> f (Garbage why));
      if n mod most_at_once = 0 then Lwt.pause () >>= fun () -> go (n + 1) else go (n + 1)
  in
  Lwt.pick [ go 1; death a ]

let close a = Child.close a.child

(* {1 The greeting} *)

let read_greeting a =
  Lines.next a.lines >>= function
  | End_of_input -> gone a >|= fun why -> Error (why ^ " before it greeted")
  | Too_long -> Lwt.return (Error "violates the platform protocol: its first line is too long")
  | Line text -> (
      match Report.of_line text with
      | Ok (Some (Hello greeting)) when greeting.version = Report.version -> Lwt.return (Ok greeting)
      | Ok (Some (Hello greeting)) ->
        Lwt.return
          (Error
             (Printf.sprintf "speaks version %d of the platform protocol, and we version %d" greeting.version
                Report.version))
      | Ok (Some (Trouble why)) -> Lwt.return (Error ("says: " ^ why))
      | Ok (Some _ | None) ->
        Lwt.return (Error "violates the platform protocol: its first line is not a 'hello'")
      | Error why -> Lwt.return (Error ("violates the platform protocol: its first line " ^ why)))

let greet a hello =
  send a (Order.to_line hello);
  let late () = Error (Printf.sprintf "did not greet within %g s" greeting_patience) in
  Lwt.pick
    [ read_greeting a; (Lwt_unix.sleep greeting_patience >|= late);
      (death a >|= fun why -> Error (why ^ " before it greeted")) ]

let start ~command hello =
  let environment = [ ("DOLPHIN_PLATFORM_PROTOCOL", string_of_int Report.version) ] in
  match Child.start ~environment command with
  | Error why -> Lwt.return (Error ("cannot be started: " ^ why))
  | Ok child -> (
      let lines = Lines.make ~limit:Report.longest_line (Child.output child) in
      let a = { child; lines; writer = Writer.make (Child.input child) } in
      let give_up error = Child.close child >>= fun () -> Lwt.fail error in
      Lwt.catch (fun () -> greet a hello) give_up >>= function
      | Ok greeting -> Lwt.return (Ok (a, greeting))
      | Error why -> Child.close child >|= fun () -> Error why)
