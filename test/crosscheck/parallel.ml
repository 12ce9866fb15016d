let jobs = match Sys.getenv_opt "JOBS" with Some n -> max 1 (int_of_string n) | None -> 2

(* Every [jobs]-th element, from the [k]-th on. *)
let share k xs = List.filteri (fun i _ -> i mod jobs = k) xs

(* A process that computes [List.map f xs]: its identifier, and the source of the result. *)
let start f xs =
  let input, output = Unix.pipe ~cloexec:true () in
  flush_all ();
  match Unix.fork () with
  | 0 ->
    let status =
      match List.map f xs with
      | ys ->
        let channel = Unix.out_channel_of_descr output in
        Marshal.to_channel channel ys [];
        flush_all ();
        0
      | exception error ->
        prerr_endline (Printexc.to_string error);
        flush_all ();
        1
    in
    Unix._exit status
  | pid ->
    Unix.close output;
    (pid, Unix.in_channel_of_descr input)

let finish (pid, channel) =
  let result = match Marshal.from_channel channel with ys -> Some ys | exception (End_of_file | Failure _) -> None in
  close_in channel;
  match Unix.waitpid [] pid, result with
  | (_, WEXITED 0), Some ys -> ys
  | _, _ -> failwith "one of several processes failed"

(* The shares, one element of each by turns. *)
let rec interleave shares =
  match List.filter (( <> ) []) shares with
  | [] -> []
  | shares -> List.map List.hd shares @ interleave (List.map List.tl shares)

let map f xs =
  if jobs = 1 then List.map f xs
  else
    let children = List.init jobs (fun k -> start f (share k xs)) in
    interleave (List.map finish children)
