let chunk = 4_096

(* Without channels: for each that is opened, the garbage collector works as if 64 KiB more were in use. *)
let text path =
  match Unix.openfile path [ O_RDONLY; O_CLOEXEC ] 0 with
  | exception Unix.Unix_error _ -> ""
  | file ->
    let bytes = Bytes.create chunk and found = Buffer.create chunk in
    let rec read () =
      match Unix.read file bytes 0 chunk with
      | 0 -> Buffer.contents found
      | n -> Buffer.add_subbytes found bytes 0 n; read ()
      | exception Unix.Unix_error _ -> Buffer.contents found
    in
    Fun.protect ~finally:(fun () -> Unix.close file) read

let lines path = String.split_on_char '\n' (text path)

let words line = List.filter (fun word -> word <> "") (String.split_on_char ' ' line)

(* The number after [name], of the first line that starts with it. *)
let entry name path =
  let number line =
    match words (String.map (function '\t' -> ' ' | c -> c) line) with
    | first :: n :: _ when first = name -> int_of_string_opt n
    | _ -> None
  in
  List.find_map number (lines path)

let number path = match lines path with line :: _ -> int_of_string_opt (String.trim line) | [] -> None
let of_kib = Option.map (fun kib -> kib * 1024)
let machine () = of_kib (entry "MemAvailable:" "/proc/meminfo")
let taken () = of_kib (entry "VmRSS:" "/proc/self/status")

(* {1 Control groups} *)

(* The rest of a group: unused pages of files are given back before anything is refused. *)
let group ~limit ~used ~unused folder =
  let file name = Filename.concat folder name in
  match number (file limit), number (file used) with
  | Some limit, Some used ->
    Some (limit - used + Option.value (entry unused (file "memory.stat")) ~default:0)
  | _, _ -> None

let rec up path = if path = "/" || path = "." || path = "" then [ "/" ] else path :: up (Filename.dirname path)

(* All groups of the process limit it. A container may see its own group as the root. *)
let groups () =
  let of_line line =
    match String.split_on_char ':' line with
    | [ _; controllers; path ] when List.mem "memory" (String.split_on_char ',' controllers) ->
      let left path =
        group ~limit:"memory.limit_in_bytes" ~used:"memory.usage_in_bytes" ~unused:"total_inactive_file"
          ("/sys/fs/cgroup/memory" ^ path)
      in
      List.filter_map left (up path)
    | [ "0"; ""; path ] ->
      let left path =
        group ~limit:"memory.max" ~used:"memory.current" ~unused:"inactive_file" ("/sys/fs/cgroup" ^ path)
      in
      List.filter_map left (up path)
    | _ -> []
  in
  List.concat_map of_line (lines "/proc/self/cgroup")

(* {1 The process} *)

let address_space () =
  let limit line =
    match words line with
    | "Max" :: "address" :: "space" :: soft :: _ -> int_of_string_opt soft
    | _ -> None
  in
  match List.find_map limit (lines "/proc/self/limits"), entry "VmSize:" "/proc/self/status" with
  | Some limit, Some kib -> Some (limit - (kib * 1024))
  | _, _ -> None

let left () =
  match List.filter_map Fun.id [ machine (); address_space () ] @ groups () with
  | [] -> None
  | n :: more -> Some (max 0 (List.fold_left min n more))
