(* The file has a line "|-- ADDRESS" for each node, and below it "/32 host LOCAL" if that is an address of ours. *)
let of_fib_trie lines =
  let address line =
    match String.split_on_char ' ' (String.trim line) with
    | [ ("|--" | "+--"); text ] -> Some text
    | _ -> None
  in
  let is_local line = String.trim line = "/32 host LOCAL" in
  let rec collect current found = function
    | [] -> List.rev found
    | line :: rest -> (
        match address line with
        | Some text -> collect (Some text) found rest
        | None -> (
            match current with
            | Some text when is_local line && not (List.mem text found) -> collect current (text :: found) rest
            | Some _ | None -> collect current found rest))
  in
  let is_loopback text = String.length text > 4 && String.sub text 0 4 = "127." in
  List.filter_map
    (fun text -> try Some (Unix.inet_addr_of_string text) with Failure _ -> None)
    (List.filter (fun text -> not (is_loopback text)) (collect None [] lines))

let lines_of path =
  match open_in path with
  | exception Sys_error _ -> []
  | channel ->
    let rec read lines =
      match input_line channel with
      | line -> read (line :: lines)
      | exception (End_of_file | Sys_error _) -> List.rev lines
    in
    let lines = read [] in
    close_in_noerr channel;
    lines

(* Connecting a datagram socket sends nothing, but chooses the way. *)
let towards host =
  let socket = Unix.socket ~cloexec:true PF_INET SOCK_DGRAM 0 in
  let address () =
    Unix.connect socket (ADDR_INET (host, 9));
    match Unix.getsockname socket with ADDR_INET (address, _) -> [ address ] | ADDR_UNIX _ -> []
  in
  Fun.protect
    ~finally:(fun () -> Unix.close socket)
    (fun () -> try address () with Unix.Unix_error _ -> [])

let local () =
  let found =
    match of_fib_trie (lines_of "/proc/net/fib_trie") with
    | [] -> towards (Unix.inet_addr_of_string "224.0.75.69")
    | found -> found
  in
  List.filter (fun a -> a <> Unix.inet_addr_loopback && a <> Unix.inet_addr_any) found @ [ Unix.inet_addr_loopback ]
