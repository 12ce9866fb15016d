open Lwt.Infix
module Lines = Dolphin_runtime.Lines
module Terminal = Dolphin_display.Terminal

type t = {
  lines : Lines.t;
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

(* [asked] is the question that stood when the line was there. *)
let tell k ~asked line =
  match k.question with
  | Some waiting when asked == k.question ->
    k.question <- None;
    Lwt.wakeup_later waiting line
  | Some _ | None -> ( match line with Ok text -> k.other text | Error _ -> ())

(* A terminal hands out one line at a time. A job in the background that read would be stopped. *)
let rec listen k =
  Lwt_unix.wait_read Lwt_unix.stdin >>= fun () ->
  if not (Terminal.is_ours Unix.stdin) then Lwt_unix.sleep 0.5 >>= fun () -> listen k
  else if is_there () then hear k ~asked:k.question
  else listen k

(* While a line is being read, a question may come: the line is none of its answers. *)
and hear k ~asked =
  Lines.next k.lines >>= function
  | Line text -> tell k ~asked (Ok text); listen k
  | Too_long -> tell k ~asked (Error (Printf.sprintf "the answer is longer than %d bytes" longest)); listen k
  | End_of_input ->
    k.over <- true;
    tell k ~asked:k.question end_of_input;
    Lwt.return_unit

let start ~other =
  let k = { lines = Lines.make ~limit:longest Lwt_unix.stdin; other; question = None; over = false } in
  Lwt.async (fun () -> listen k);
  k

(* A line that is there was typed before now; what was begun is forgotten. *)
let rec settle k =
  if Terminal.is_ours Unix.stdin then
    match Unix.select [ Unix.stdin ] [] [] 0. with
    | [], _, _ -> ( try Unix.tcflush Unix.stdin TCIFLUSH with Unix.Unix_error _ -> ())
    | _ -> (
        let text = Bytes.create 4096 in
        match Unix.read Unix.stdin text 0 (Bytes.length text) with
        | 0 -> ()
        | n ->
          let lines = String.split_on_char '\n' (Bytes.sub_string text 0 n) in
          List.iter (fun line -> if line <> "" then k.other line) lines;
          settle k)
    | exception Unix.Unix_error _ -> ()

let answer k =
  if k.over then Lwt.return end_of_input
  else begin
    let promise, waiting = Lwt.task () in
    k.question <- Some waiting;
    Lwt.on_cancel promise (fun () -> k.question <- None);
    promise
  end
