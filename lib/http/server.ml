open Lwt.Infix

type rank = Unknown | Guest | Trusted

type limits = {
  head : int;
  body : int;
  connections : rank -> int;
  rate : int;
  handshakes : int;
  unsent : int;
  patience : float;
  idle : float;
}

let limits =
  let connections = function Unknown -> 100 | Guest -> 150 | Trusted -> 150 in
  { head = 16 * 1024; body = 4 * 1024 * 1024; connections; rate = 1000; handshakes = 200; unsent = 64 * 1024 * 1024;
    patience = 10.; idle = 60. }

type kind = Handshake | Request of rank

type client = {
  address : string;
  socket : Lwt_unix.file_descr;
  mutable channel : Lwt_ssl.socket;  (* over the socket, plain until it is encrypted *)
  piece : Bytes.t;
  since : float;
  mutable rank : rank;  (* the best of its requests *)
  mutable is_served : bool;  (* a reply is under way *)
  mutable unread : string;  (* bytes that came and belong to no request yet *)
}

type t = {
  limits : limits;
  listening : Lwt_unix.file_descr;
  tls : Ssl.context option;
  rank_of : Request.t -> rank;
  reply : Request.t -> Response.t Lwt.t;
  mutable open_ : client list;  (* the latest first *)
  asked : (kind * string, int) Hashtbl.t;  (* by kind and address, in this second *)
  unsent : (rank, int) Hashtbl.t;  (* bytes of the large replies that are being written *)
  mutable second : float;
  mutable accepting : unit Lwt.t;
  mutable over : bool;
}

let port t =
  match Unix.getsockname (Lwt_unix.unix_file_descr t.listening) with ADDR_INET (_, port) -> port | ADDR_UNIX _ -> 0

let connections t = List.length t.open_

(* {1 Reading} *)

exception Gone

let refill client =
  Lwt_ssl.read client.channel client.piece 0 (Bytes.length client.piece) >|= fun n ->
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
  let bytes = Bytes.unsafe_of_string text in
  let rec from start =
    if start = String.length text then Lwt.return_unit
    else
      let size = min 65_536 (String.length text - start) in
      within t.limits.patience (fun () -> Lwt_ssl.write client.channel bytes start size) >>= fun n ->
      from (start + n)
  in
  from 0

(* Resolves when the client is gone. Its further messages are ignored. *)
let rec gone client =
  Lwt_ssl.read client.channel client.piece 0 (Bytes.length client.piece) >>= fun n ->
  if n = 0 then Lwt.return_unit else gone client

(* Replies of this length are not counted: there is at most one for each connection. *)
let small = 65_536

let unsent t rank = Option.value (Hashtbl.find_opt t.unsent rank) ~default:0
let fits t client length = length <= small || unsent t client.rank + length <= t.limits.unsent

(* A large text stays in memory until its reader has it. *)
let write_text t client head text =
  let length = String.length text in
  if length <= small then write t client (head ^ text)
  else begin
    let rank = client.rank in
    Hashtbl.replace t.unsent rank (unsent t rank + length);
    let sent () = Hashtbl.replace t.unsent rank (unsent t rank - length); Lwt.return_unit in
    Lwt.finalize (fun () -> write t client head >>= fun () -> write t client text) sent
  end

let respond t client ~keep ~only_head (r : Response.t) =
  let keep = keep && match r.body with Text _ -> true | Stream _ -> false in
  let head = Response.head ~keep r in
  let whole =
    match r.body with
    | Text text -> if only_head then write t client head else write_text t client head text
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

(* How many of this kind came from this address in this second, with this one. *)
let count_one t client kind =
  let second = Float.of_int (Float.to_int (Unix.gettimeofday ())) in
  if second <> t.second then begin
    Hashtbl.reset t.asked;
    t.second <- second
  end;
  let n = 1 + Option.value (Hashtbl.find_opt t.asked (kind, client.address)) ~default:0 in
  Hashtbl.replace t.asked (kind, client.address) n;
  n

let too_often t client rank = count_one t client (Request rank) > t.limits.rate

(* {2 Places} *)

let of_rank t rank = List.filter (fun c -> c.rank = rank) t.open_

(* The oldest connection of the address that has most of this rank. Those with a reply under way stay, but those of
   unknown clients may read it slowly to keep others out. *)
let to_end t rank =
  let may_end c = rank = Unknown || not c.is_served in
  let all = of_rank t rank and counts = Hashtbl.create 16 in
  let count address = Option.value (Hashtbl.find_opt counts address) ~default:0 in
  List.iter (fun c -> Hashtbl.replace counts c.address (1 + count c.address)) all;
  let better best c =
    match best with
    | Some other when count other.address > count c.address -> best
    | Some _ | None -> Some c
  in
  List.fold_left better None (List.filter may_end all)

(* Its reader notices. *)
let shut client = try Lwt_unix.shutdown client.socket SHUTDOWN_ALL with Unix.Unix_error _ -> ()

(* Whether there is a place for one more connection of this rank: if need be, another one ends. *)
let make_room t rank =
  List.length (of_rank t rank) < t.limits.connections rank
  ||
  match to_end t rank with
  | Some client ->
    t.open_ <- List.filter (fun other -> other != client) t.open_;
    shut client;
    true
  | None -> false

(* Seconds that a new connection has for its first request, also while there is a flood of them. *)
let grace = 0.1

(* Further connections wait in the system's queue meanwhile. *)
let rec wait_for_room t =
  let age client = Unix.gettimeofday () -. client.since in
  if List.length (of_rank t Unknown) < t.limits.connections Unknown then Lwt.return_unit
  else
    match to_end t Unknown with
    | Some client when age client < grace ->
      Lwt_unix.sleep (Float.max 0.001 (grace -. age client)) >>= fun () -> wait_for_room t
    | Some _ | None -> Lwt.return_unit

let value = function Unknown -> 0 | Guest -> 1 | Trusted -> 2

(* Whether the client has a place of this rank, or gets one. *)
let promoted t client rank =
  value rank <= value client.rank
  || make_room t rank
     && begin
       client.rank <- rank;
       true
     end

let too_many = told 503 "too many connections"

let answer t client r =
  let rank = t.rank_of r in
  if too_often t client rank then
    let busy = told 429 "too many requests in a second" in
    let later = { busy with headers = ("Retry-After", "1") :: busy.headers } in
    respond t client ~keep:false ~only_head:false later
  else if not (promoted t client rank) then respond t client ~keep:false ~only_head:false too_many
  else
    safely t r >>= fun response ->
    let length = match response.body with Text text -> String.length text | Stream _ -> 0 in
    if fits t client length then
      respond t client ~keep:(Request.keeps_alive r) ~only_head:(r.verb = "HEAD") response
    else respond t client ~keep:false ~only_head:false (told 503 "too many large replies are being read")

let rec serve t client ~first =
  request t client ~first >>= function
  | Error fault -> respond t client ~keep:false ~only_head:false (of_fault fault) >|= ignore
  | Ok r ->
    client.is_served <- true;
    answer t client r >>= fun keep ->
    client.is_served <- false;
    if keep && not t.over then serve t client ~first:false else Lwt.return_unit

exception Too_often

(* A handshake takes a thousand times as long as a request that is refused. *)
let encrypt t client =
  match t.tls with
  | None -> Lwt.return_unit
  | Some _ when count_one t client Handshake > t.limits.handshakes -> Lwt.fail Too_often
  | Some context ->
    within t.limits.patience (fun () -> Lwt_ssl.ssl_accept client.socket context) >|= fun channel ->
    client.channel <- channel

let quietly f = Lwt.catch f (fun _ -> Lwt.return_unit)

let name : Unix.sockaddr -> string = function
  | ADDR_INET (address, _) -> Unix.string_of_inet_addr address
  | ADDR_UNIX path -> path

let admit t (socket, address) =
  let client =
    { address = name address; socket; channel = Lwt_ssl.plain socket; since = Unix.gettimeofday ();
      piece = Bytes.create 8192; rank = Unknown;
      is_served = false; unread = "" } in
  let has_room = make_room t Unknown in
  t.open_ <- client :: t.open_;
  let whole () =
    if has_room then encrypt t client >>= fun () -> serve t client ~first:true
    else respond t client ~keep:false ~only_head:false too_many >|= ignore
  in
  let leave () =
    t.open_ <- List.filter (fun other -> other != client) t.open_;
    quietly (fun () -> Lwt_unix.close socket)
  in
  Lwt.async (fun () -> Lwt.finalize (fun () -> quietly whole) leave)

(* If descriptors have run out, others may be closed meanwhile. *)
let rec accept t =
  Lwt.catch
    (fun () ->
       wait_for_room t >>= fun () ->
       Lwt_unix.accept ~cloexec:true t.listening >|= fun (socket, address) ->
       (try Lwt_unix.setsockopt socket TCP_NODELAY true with Unix.Unix_error _ -> ());
       admit t (socket, address))
    (function
      | Unix.Unix_error ((EMFILE | ENFILE | ECONNABORTED | ENOBUFS | ENOMEM), _, _) -> Lwt_unix.sleep 0.1
      | error -> Lwt.fail error)
  >>= fun () -> accept t

let start ?(limits = limits) ?(address = Unix.inet_addr_loopback) ?tls ?(rank = fun _ -> Trusted) ~port reply =
  Sys.set_signal Sys.sigpipe Signal_ignore;
  let place = Unix.ADDR_INET (address, port) in
  let socket = Unix.socket ~cloexec:true (Unix.domain_of_sockaddr place) SOCK_STREAM 0 in
  match
    Unix.setsockopt socket SO_REUSEADDR true;
    Unix.bind socket place;
    Unix.listen socket 1_000
  with
  | () ->
    let listening = Lwt_unix.of_unix_file_descr socket in
    let t =
      { limits; listening; tls; rank_of = rank; reply; open_ = []; asked = Hashtbl.create 16;
        unsent = Hashtbl.create 3; second = 0.;
        accepting = Lwt.return_unit; over = false }
    in
    t.accepting <- quietly (fun () -> accept t);
    Ok t
  | exception Unix.Unix_error (error, _, _) ->
    Unix.close socket;
    Error (Unix.error_message error)

let close t =
  t.over <- true;
  Lwt.cancel t.accepting;
  quietly (fun () -> Lwt_unix.close t.listening) >|= fun () -> List.iter shut t.open_
