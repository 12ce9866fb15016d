open Lwt.Infix

let connect port =
  let socket = Lwt_unix.socket ~cloexec:true PF_INET SOCK_STREAM 0 in
  Lwt_unix.connect socket (ADDR_INET (Unix.inet_addr_loopback, port)) >|= fun () -> socket

let quietly f = Lwt.catch f (fun _ -> Lwt.return_unit)

let rec write socket text start =
  if start = String.length text then Lwt.return_unit
  else Lwt_unix.write_string socket text start (String.length text - start) >>= fun n -> write socket text (start + n)

let rec read_all socket buffer =
  let piece = Bytes.create 65536 in
  Lwt_unix.read socket piece 0 (Bytes.length piece) >>= function
  | 0 -> Lwt.return_unit
  | n -> Buffer.add_subbytes buffer piece 0 n; read_all socket buffer

let raw ?(no_more = false) ~port text =
  let buffer = Buffer.create 1024 in
  connect port >>= fun socket ->
  quietly (fun () -> write socket text 0) >>= fun () ->
  (try if no_more then Lwt_unix.shutdown socket SHUTDOWN_SEND with Unix.Unix_error _ -> ());
  Lwt.pick [ quietly (fun () -> read_all socket buffer); Lwt_unix.sleep 30. ] >>= fun () ->
  quietly (fun () -> Lwt_unix.close socket) >|= fun () -> Buffer.contents buffer

type reply = { status : int; body : string }

let split_head text =
  match Str.bounded_split_delim (Str.regexp_string "\r\n\r\n") text 2 with
  | [ head; body ] -> (head, body)
  | _ -> (text, "")

let of_text text =
  let head, body = split_head text in
  let status = try int_of_string (String.sub head 9 3) with Invalid_argument _ | Failure _ -> 0 in
  { status; body }

let request ~verb ~headers ~body ~port path =
  let default =
    [ ("Host", Printf.sprintf "127.0.0.1:%d" port); ("Connection", "close") ]
    @ match body with
    | None -> []
    | Some body -> [ ("Content-Type", "application/json"); ("Content-Length", string_of_int (String.length body)) ]
  in
  let others = List.filter (fun (name, _) -> not (List.mem_assoc name headers)) default in
  let lines = List.map (fun (name, x) -> name ^ ": " ^ x ^ "\r\n") (others @ headers) in
  Printf.sprintf "%s %s HTTP/1.1\r\n%s\r\n%s" verb path (String.concat "" lines) (Option.value body ~default:"")

let ask ?verb ?(headers = []) ?body ~port path =
  let verb = match verb, body with Some verb, _ -> verb | None, Some _ -> "POST" | None, None -> "GET" in
  raw ~port (request ~verb ~headers ~body ~port path) >|= of_text

let json reply = Yojson.Safe.from_string reply.body

(* {1 Events} *)

type watcher = { socket : Lwt_unix.file_descr; input : Lwt_io.input_channel }

let events ?(headers = []) ~port path =
  connect port >>= fun socket ->
  write socket (request ~verb:"GET" ~headers ~body:None ~port path) 0 >>= fun () ->
  let input = Lwt_io.of_fd ~mode:Input ~close:(fun () -> Lwt.return_unit) socket in
  let rec skip_head () = Lwt_io.read_line input >>= function "" -> Lwt.return_unit | _ -> skip_head () in
  skip_head () >|= fun () -> { socket; input }

let watch ?last ~port name =
  let headers = match last with Some id -> [ ("Last-Event-ID", id) ] | None -> [] in
  events ~headers ~port ("/api/events?client=" ^ name)

type message = { id : string; event : string; data : string }

let rec message w m =
  Lwt_io.read_line w.input >>= fun line ->
  match Str.bounded_split_delim (Str.regexp_string ": ") line 2 with
  | [ "id"; id ] -> message w { m with id }
  | [ "event"; event ] -> message w { m with event }
  | [ "data"; data ] -> message w { m with data }
  | _ when line = "" && m.event <> "" -> Lwt.return m
  | _ -> message w m

let until w p =
  let rec go seen =
    message w { id = ""; event = ""; data = "" } >>= fun m ->
    let seen = m :: seen in
    if p m then Lwt.return (List.rev seen) else go seen
  in
  Lwt_unix.with_timeout 60. (fun () -> go [])

let leave w = quietly (fun () -> Lwt_unix.close w.socket)
