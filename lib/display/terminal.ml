external size_of : int -> int * int = "dolphin_terminal_size"
external is_ours_of : int -> bool = "dolphin_terminal_is_ours"

(* On Unix a descriptor is its number. *)
let number (fd : Unix.file_descr) : int = Obj.magic fd

let is_live () =
  let dumb = match Sys.getenv_opt "TERM" with None | Some ("" | "dumb") -> true | Some _ -> false in
  Unix.isatty Unix.stdout && not dumb

let size fd =
  match size_of (number fd) with rows, columns when rows > 0 && columns > 0 -> (rows, columns) | _ -> (24, 80)
let is_ours fd = is_ours_of (number fd)

type quiet = Unix.terminal_io

let hush () =
  match Unix.isatty Unix.stdin && is_ours Unix.stdin with
  | false -> None
  | true ->
    let before = Unix.tcgetattr Unix.stdin in
    Unix.tcsetattr Unix.stdin TCSANOW { before with c_echo = false; c_echonl = false };
    Some before
  | exception Unix.Unix_error _ -> None

let unhush before =
  try
    if is_ours Unix.stdin then begin
      Unix.tcflush Unix.stdin TCIFLUSH;
      Unix.tcsetattr Unix.stdin TCSANOW before
    end
  with Unix.Unix_error _ -> ()
