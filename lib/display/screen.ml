open Lwt.Infix

type t = {
  output : Unix.file_descr;
  live : bool;
  on_closed : Unix.error -> unit;
  mutable closed : bool;  (* nothing can be written any more *)
  mutable board : rows:int -> columns:int -> string list;
  mutable drawn : int list;  (* the lines of the board on the terminal, by their widths *)
  mutable quiet : Terminal.quiet option;  (* typed text is not shown *)
  mutable asking : bool;  (* the last line is a question, without its end *)
  pending : Buffer.t;  (* lines of the log that the terminal has not *)
  mutable due : bool;  (* whether a redraw is scheduled *)
  mutable last : float;  (* when the last one was *)
}

let period = 0.1

(* Seconds that are independent of the system's time: when that is set, the board is redrawn all the same. *)
let now () = Int64.to_float (Mtime_clock.elapsed_ns ()) *. 1e-9

let make ~live ~on_closed output =
  { output; live; on_closed; closed = false; board = (fun ~rows:_ ~columns:_ -> []); drawn = []; quiet = None;
    asking = false; pending = Buffer.create 256; due = false; last = neg_infinity }

let rec write_from s text from =
  let left = String.length text - from in
  if left > 0 && not s.closed then
    match Unix.write_substring s.output text from left with
    | written -> write_from s text (from + written)
    | exception Unix.Unix_error (EINTR, _, _) -> write_from s text from
    | exception Unix.Unix_error ((EAGAIN | EWOULDBLOCK), _, _) ->
      ignore (Unix.select [] [ s.output ] [] 1.);
      write_from s text from
    | exception Unix.Unix_error (error, _, _) ->
      s.closed <- true;
      s.on_closed error

let write s text = write_from s text 0

(* {1 The terminal} *)

(* Echoed input would move the board, and is not shown while there is one. *)
let hush s = if s.live && s.quiet = None then s.quiet <- Terminal.hush ()

let unhush s =
  Option.iter Terminal.unhush s.quiet;
  s.quiet <- None

(* How wide a line is on the terminal: colours take no room. *)
let width line =
  let rec visible i n =
    if i >= String.length line then n
    else if line.[i] = '\027' then
      match String.index_from_opt line i 'm' with Some stop -> visible (stop + 1) n | None -> n
    else visible (i + 1) (if Char.code line.[i] land 0xC0 = 0x80 then n else n + 1)
  in
  visible 0 0

(* Up over the board, and away with it. On a terminal that became narrower, lines may have been broken. *)
let erase s ~columns =
  let broken width = max 1 ((width + columns - 1) / columns) in
  let rows = List.fold_left (fun n width -> n + broken width) 0 s.drawn in
  s.drawn <- [];
  if rows = 0 then "" else Printf.sprintf "\r\027[%dA\027[J" rows

(* The log keeps a third of the terminal. *)
let rows_of_board rows = max 1 (rows - max 4 (rows / 3))

(* The log's new lines, and the board below. A line of the board that is too long is cut by the terminal, for a line
   that went on below would not be erased. In the background the board is off: the terminal is another's. *)
let draw s ~board =
  let rows, columns = Terminal.size s.output in
  let erased = erase s ~columns in
  let text = Buffer.contents s.pending in
  Buffer.clear s.pending;
  let lines = if board && Terminal.is_ours s.output then s.board ~rows:(rows_of_board rows) ~columns else [] in
  s.drawn <- List.map (fun line -> min columns (width line)) lines;
  let below = if lines = [] then "" else "\027[?7l" ^ String.concat "\n" lines ^ "\n\027[?7h" in
  s.last <- now ();
  if lines <> [] then hush s;
  write s (erased ^ text ^ below)

let redraw s =
  let wait = s.last +. period -. now () in
  if s.asking || s.due then ()
  else if wait <= 0. then draw s ~board:true
  else begin
    s.due <- true;
    Lwt.async (fun () ->
        Lwt_unix.sleep wait >|= fun () ->
        s.due <- false;
        if not (s.asking || s.closed) then draw s ~board:true)
  end

(* {1 Either} *)

(* A question that is still open when the log goes on stays unanswered. *)
let give_up s =
  if s.asking then begin
    s.asking <- false;
    write s "\n"
  end

let print s text =
  give_up s;
  if s.live then begin
    Buffer.add_string s.pending (text ^ "\n");
    redraw s
  end
  else write s (text ^ "\n")

let changed s = if s.live then redraw s

let show s board =
  s.board <- board;
  changed s

let ask s prompt =
  if s.live then begin
    draw s ~board:false;
    unhush s
  end;
  s.asking <- true;
  write s (prompt ^ " ")

let is_asking s = s.asking

let answered s text =
  s.asking <- false;
  Option.iter (fun text -> write s (text ^ "\n")) text;
  changed s

(* {1 The end, for good or for a while} *)

let restore s = unhush s

let close s =
  give_up s;
  if s.live then draw s ~board:false;
  restore s

let suspend s ~stop =
  if s.live && not s.asking then draw s ~board:false;
  restore s;
  stop ();
  changed s
