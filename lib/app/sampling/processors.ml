(* ["0-3,8"] is five. *)
let of_list text =
  let span text =
    match List.map int_of_string_opt (String.split_on_char '-' (String.trim text)) with
    | [ Some _ ] -> Some 1
    | [ Some first; Some last ] when first <= last -> Some (last - first + 1)
    | _ -> None
  in
  List.fold_left (+) 0 (List.filter_map span (String.split_on_char ',' text))

let count () =
  let prefix = "Cpus_allowed_list:" in
  let of_line line =
    if String.starts_with ~prefix line then
      let n = String.length prefix in
      Some (of_list (String.sub line n (String.length line - n)))
    else None
  in
  match open_in_bin "/proc/self/status" with
  | exception Sys_error _ -> 1
  | channel ->
    let rec read () =
      match of_line (input_line channel) with
      | Some n -> max 1 n
      | None -> read ()
      | exception (End_of_file | Sys_error _) -> 1
    in
    Fun.protect ~finally:(fun () -> close_in_noerr channel) read
