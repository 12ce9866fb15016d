open Lwt.Infix
module Terminal = Dolphin_display.Terminal

type t = {
  input : Unix.file_descr;
  begun : Buffer.t;  (* of a line whose end has not come *)
  other : string -> unit;
  mutable question : (string, string) result Lwt.u option;
  mutable over : bool;
}

let longest = 65_536
let end_of_input = Error "end of input"

let is_there () =
  match Unix.select [ Unix.stdin ] [] [] 0. with
  | [], _, _ -> false
  | _ -> true
  | exception Unix.Unix_error (EINTR, _, _) -> false

(* The terminal once more, so that to read never waits, even with another reader. *)
let open_input () =
  try Unix.openfile "/dev/stdin" [ O_RDONLY; O_NONBLOCK; O_CLOEXEC; O_NOCTTY ] 0 with Unix.Unix_error _ -> Unix.stdin

(* At once, so that lines from before a question are reported before it. *)
let read k =
  let text = Bytes.create 4096 in
  match Unix.read k.input text 0 (Bytes.length text) with
  | n -> Some (Bytes.sub_string text 0 n)
  | exception Unix.Unix_error ((EINTR | EAGAIN | EWOULDBLOCK), _, _) -> None
  | exception Unix.Unix_error _ -> Some ""

let tell k line =
  match k.question with
  | Some waiting ->
    k.question <- None;
    Lwt.wakeup_later waiting line
  | None -> ( match line with Ok text -> k.other text | Error _ -> ())

let rec tell_lines k = function
  | [] -> Buffer.clear k.begun
  | [ begun ] ->
    Buffer.clear k.begun;
    if String.length begun <= longest then Buffer.add_string k.begun begun
    else tell k (Error (Printf.sprintf "the answer is longer than %d bytes" longest))
  | line :: rest ->
    tell k (Ok line);
    tell_lines k rest

let hear k =
  match read k with
  | None -> ()
  | Some "" ->
    k.over <- true;
    tell k end_of_input
  | Some text ->
    Buffer.add_string k.begun text;
    tell_lines k (String.split_on_char '\n' (Buffer.contents k.begun))

(* A terminal hands out one line at a time. A job in the background that read would be stopped. *)
let rec listen k =
  Lwt_unix.wait_read Lwt_unix.stdin >>= fun () ->
  if not (Terminal.is_ours Unix.stdin) then Lwt_unix.sleep 0.5 >>= fun () -> listen k
  else begin
    if is_there () then hear k;
    if k.over then Lwt.return_unit else listen k
  end

let start ~other =
  let k = { input = open_input (); begun = Buffer.create 80; other; question = None; over = false } in
  Lwt.async (fun () -> listen k);
  k

(* A complete line was typed before now; the rest of a line is forgotten. *)
let rec settle k =
  if Terminal.is_ours Unix.stdin && not k.over then
    if is_there () then begin
      hear k;
      settle k
    end
    else begin
      Buffer.clear k.begun;
      try Unix.tcflush Unix.stdin TCIFLUSH with Unix.Unix_error _ -> ()
    end

let answer k =
  if k.over then Lwt.return end_of_input
  else begin
    let promise, waiting = Lwt.task () in
    k.question <- Some waiting;
    Lwt.on_cancel promise (fun () -> k.question <- None);
    promise
  end
