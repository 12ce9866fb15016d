open Lwt.Infix

type limits = { head : int; body : int; connections : int; rate : int; patience : float; idle : float }

let limits =
  { head = 16 * 1024; body = 4 * 1024 * 1024; connections = 400; rate = 1000; patience = 10.; idle = 60. }

type t = {
  limits : limits;
  listening : Lwt_unix.file_descr;
  reply : Request.t -> Response.t Lwt.t;
  mutable open_ : Lwt_unix.file_descr list;
  asked : (string, int) Hashtbl.t;  (* by address, in this second *)
  mutable second : float;
  mutable accepting : unit Lwt.t;
  mutable over : bool;
}

let port t =
  match Unix.getsockname (Lwt_unix.unix_file_descr t.listening) with ADDR_INET (_, port) -> port | ADDR_UNIX _ -> 0

let connections t = List.length t.open_

(* {1 Reading} *)

type client = {
  address : string;
  socket : Lwt_unix.file_descr;
  piece : Bytes.t;
  mutable unread : string;  (* bytes that came and belong to no request yet *)
}

exception Gone

let refill client =
  Lwt_unix.read client.socket client.piece 0 (Bytes.length client.piece) >|= fun n ->
  if n = 0 then raise Gone;
  client.unread <- client.unread ^ Bytes.sub_string client.piece 0 n

let take client n =
  let text = String.sub client.unread 0 n in
  client.unread <- String.sub client.unread n (String.length client.unread - n);
  text

(* The end of the first empty line, and the length of the part before it. *)
let end_of_head text =
  let n = String.length text in
  let rec from i =
    match String.index_from_opt text i '\n' with
    | None -> None
    | Some i when i + 1 < n && text.[i + 1] = '\n' -> Some (i, i + 2)
    | Some i when i + 2 < n && text.[i + 1] = '\r' && text.[i + 2] = '\n' -> Some (i, i + 3)
    | Some i -> if i + 1 < n then from (i + 1) else None
  in
  from 0

let rec head limits client =
  match end_of_head client.unread with
  | Some (stop, _) when stop > limits.head -> Lwt.return (Error Request.Too_large)
  | Some (stop, next) -> Lwt.return (Ok (String.sub (take client next) 0 stop))
  | None when String.length client.unread > limits.head -> Lwt.return (Error Request.Too_large)
  | None -> refill client >>= fun () -> head limits client

let body client length =
  let buffer = Buffer.create (min length 65_536) in
  let rec more () =
    let missing = length - Buffer.length buffer in
    Buffer.add_string buffer (take client (min missing (String.length client.unread)));
    if Buffer.length buffer = length then Lwt.return (Buffer.contents buffer) else refill client >>= more
  in
  more ()

let within seconds f = Lwt_unix.with_timeout seconds f

(* The next request. It may take its time to begin, and then not to end. *)
let request t client ~first =
  let idle = if first then t.limits.patience else t.limits.idle in
  let begins = if client.unread = "" then within idle (fun () -> refill client) else Lwt.return_unit in
  begins >>= fun () ->
  within t.limits.patience (fun () -> head t.limits client) >>= fun head ->
  match Result.bind head Request.of_head with
  | Error fault -> Lwt.return (Error fault)
  | Ok (_, length) when length > t.limits.body -> Lwt.return (Error Request.Too_large)
  | Ok (r, length) ->
    within t.limits.patience (fun () -> body client length) >|= fun body -> Ok { r with Request.body }

(* {1 Writing} *)

let write t client text =
  let rec from start =
    if start = String.length text then Lwt.return_unit
    else
      let size = min 65_536 (String.length text - start) in
      within t.limits.patience (fun () -> Lwt_unix.write_string client.socket text start size) >>= fun n ->
      from (start + n)
  in
  from 0

(* Resolves when the client is gone. Its further messages are ignored. *)
let rec gone client =
  Lwt_unix.read client.socket client.piece 0 (Bytes.length client.piece) >>= fun n ->
  if n = 0 then Lwt.return_unit else gone client

let respond t client ~keep ~only_head (r : Response.t) =
  let keep = keep && match r.body with Text _ -> true | Stream _ -> false in
  let head = Response.head ~keep r in
  let whole =
    match r.body with
    | Text text -> write t client (if only_head then head else head ^ text)
    | Stream _ when only_head -> write t client head
    | Stream f -> write t client head >>= fun () -> Lwt.pick [ f (write t client); gone client ]
  in
  whole >|= fun () -> keep

let told status text = Response.text ~kind:"text/plain; charset=utf-8" status (text ^ "\n")

let of_fault : Request.fault -> Response.t = function
  | Malformed why -> told 400 why
  | Too_large -> told 413 "this is more than is taken here"
  | Unsupported why -> told 501 why

(* {1 Connections} *)

let safely t r =
  Lwt.catch (fun () -> t.reply r) (fun _ -> Lwt.return (told 500 "this is trouble of the server, not of the request"))

(* Whether this client has asked too often in this second. *)
let too_often t client =
  let second = Float.of_int (Float.to_int (Unix.gettimeofday ())) in
  if second <> t.second then begin
    Hashtbl.reset t.asked;
    t.second <- second
  end;
  let n = 1 + Option.value (Hashtbl.find_opt t.asked client.address) ~default:0 in
  Hashtbl.replace t.asked client.address n;
  n > t.limits.rate

let rec serve t client ~first =
  request t client ~first >>= function
  | Ok _ when too_often t client ->
    let busy = told 429 "too many requests in a second" in
    let later = { busy with headers = ("Retry-After", "1") :: busy.headers } in
    respond t client ~keep:false ~only_head:false later >|= ignore
  | Error fault -> respond t client ~keep:false ~only_head:false (of_fault fault) >|= ignore
  | Ok r ->
    safely t r >>= fun response ->
    respond t client ~keep:(Request.keeps_alive r) ~only_head:(r.verb = "HEAD") response >>= fun keep ->
    if keep && not t.over then serve t client ~first:false else Lwt.return_unit

let quietly f = Lwt.catch f (fun _ -> Lwt.return_unit)

let name : Unix.sockaddr -> string = function
  | ADDR_INET (address, _) -> Unix.string_of_inet_addr address
  | ADDR_UNIX path -> path

let admit t (socket, address) =
  let client = { address = name address; socket; piece = Bytes.create 8192; unread = "" } in
  let too_many = connections t >= t.limits.connections in
  t.open_ <- socket :: t.open_;
  let whole () =
    if too_many then respond t client ~keep:false ~only_head:false (told 503 "too many connections") >|= ignore
    else serve t client ~first:true
  in
  let leave () =
    t.open_ <- List.filter (fun other -> other != socket) t.open_;
    quietly (fun () -> Lwt_unix.close socket)
  in
  Lwt.async (fun () -> Lwt.finalize (fun () -> quietly whole) leave)

(* If descriptors have run out, others may be closed meanwhile. *)
let rec accept t =
  Lwt.catch
    (fun () ->
       Lwt_unix.accept ~cloexec:true t.listening >|= fun (socket, address) ->
       (try Lwt_unix.setsockopt socket TCP_NODELAY true with Unix.Unix_error _ -> ());
       admit t (socket, address))
    (function
      | Unix.Unix_error ((EMFILE | ENFILE | ECONNABORTED | ENOBUFS | ENOMEM), _, _) -> Lwt_unix.sleep 0.1
      | error -> Lwt.fail error)
  >>= fun () -> accept t

let start ?(limits = limits) ?(address = Unix.inet_addr_loopback) ~port reply =
  Sys.set_signal Sys.sigpipe Signal_ignore;
  let place = Unix.ADDR_INET (address, port) in
  let socket = Unix.socket ~cloexec:true (Unix.domain_of_sockaddr place) SOCK_STREAM 0 in
  match
    Unix.setsockopt socket SO_REUSEADDR true;
    Unix.bind socket place;
    Unix.listen socket 100
  with
  | () ->
    let listening = Lwt_unix.of_unix_file_descr socket in
    let t =
      { limits; listening; reply; open_ = []; asked = Hashtbl.create 16; second = 0.; accepting = Lwt.return_unit;
        over = false }
    in
    t.accepting <- quietly (fun () -> accept t);
    Ok t
  | exception Unix.Unix_error (error, _, _) ->
    Unix.close socket;
    Error (Unix.error_message error)

let close t =
  t.over <- true;
  Lwt.cancel t.accepting;
  let close socket =
    quietly (fun () -> Lwt.return (Lwt_unix.shutdown socket SHUTDOWN_ALL))
  in
  quietly (fun () -> Lwt_unix.close t.listening) >>= fun () -> Lwt_list.iter_p close t.open_
