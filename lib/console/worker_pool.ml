open Lwt.Infix
open Exchange

type limits = { workers : int; each : int; waiting : int; seconds : float; megabytes : int; reply : int }

let limits = { workers = 3; each = 2; waiting = 20; seconds = 20.; megabytes = 2048; reply = 16 * 1024 * 1024 }

type worker = { process : Lwt_process.process; mutable is_idle_since : float }

type t = {
  limits : limits;
  dolphin : string;
  freed : unit Lwt_condition.t;
  mutable all : worker list;
  mutable idle : worker list;
  mutable running : string list;  (* the client of each task that runs *)
  mutable waiting : string list;
  mutable is_closed : bool;
}

let make ~dolphin limits =
  { limits; dolphin; freed = Lwt_condition.create (); all = []; idle = []; running = []; waiting = [];
    is_closed = false }

let pids p = List.map (fun w -> w.process#pid) p.all

(* {1 Workers} *)

let start p =
  let command = [| p.dolphin; "console-worker"; "--megabytes"; string_of_int p.limits.megabytes |] in
  let w = { process = Lwt_process.open_process (p.dolphin, command); is_idle_since = 0. } in
  p.all <- w :: p.all;
  w

let quietly f = Lwt.catch f (fun _ -> Lwt.return_unit)

let dispose p w =
  if List.memq w p.all then begin
    p.all <- List.filter (fun other -> other != w) p.all;
    p.idle <- List.filter (fun other -> other != w) p.idle;
    w.process#kill Sys.sigkill;
    Lwt.async (fun () -> quietly (fun () -> w.process#close >|= ignore))
  end

(* Seconds after which a worker without work ends. *)
let most_idle = 30.

let keep p w =
  let since = Unix.gettimeofday () in
  w.is_idle_since <- since;
  p.idle <- w :: p.idle;
  let look () = if List.memq w p.idle && w.is_idle_since = since then dispose p w in
  Lwt.async (fun () -> Lwt_unix.sleep most_idle >|= look)

(* {1 Turns} *)

let without_one client clients =
  let rec from = function
    | [] -> []
    | other :: rest when other = client -> rest
    | other :: rest -> other :: from rest
  in
  from clients

let count client clients = List.length (List.filter (( = ) client) clients)

let is_full p client =
  List.length p.running >= p.limits.workers || count client p.running >= p.limits.each

let too_many = refusal 503 "too-many" "too many requests of this kind are under way: repeat it later"

let rec turn p client =
  if not (is_full p client) then begin
    p.running <- client :: p.running;
    Lwt.return_unit
  end
  else Lwt_condition.wait p.freed >>= fun () -> turn p client

(* One client may take half of the places to wait in. *)
let enter p client =
  let most = p.limits.waiting in
  if p.is_closed then Lwt.return (Error too_many)
  else if not (is_full p client) then turn p client >|= Result.ok
  else if List.length p.waiting >= most || count client p.waiting >= (most + 1) / 2 then Lwt.return (Error too_many)
  else begin
    p.waiting <- client :: p.waiting;
    let leave () = p.waiting <- without_one client p.waiting; Lwt.return_unit in
    Lwt.finalize (fun () -> turn p client) leave >|= Result.ok
  end

let leave p client =
  p.running <- without_one client p.running;
  Lwt_condition.broadcast p.freed ()

(* {1 Tasks} *)

exception Too_long
exception Too_large

let frame ~most w =
  let channel = w.process#stdout in
  let bytes = Bytes.create 4 in
  Lwt_io.read_into_exactly channel bytes 0 4 >>= fun () ->
  let length = Int32.to_int (Bytes.get_int32_be bytes 0) in
  if length < 0 || length > most then Lwt.fail Too_large
  else
    let text = Bytes.create length in
    Lwt_io.read_into_exactly channel text 0 length >|= fun () -> Bytes.unsafe_to_string text

let order w head body =
  let channel = w.process#stdin in
  Lwt_io.write channel (Worker.framed head) >>= fun () ->
  Lwt_io.write channel (Worker.framed body) >>= fun () -> Lwt_io.flush channel

let within p f = Lwt.pick [ f (); (Lwt_unix.sleep p.limits.seconds >>= fun () -> Lwt.fail Too_long) ]

let why p : exn -> refusal = function
  | Too_long ->
    let message = Printf.sprintf "this takes longer than %.0f seconds" p.limits.seconds in
    refusal 503 "too-long" message
  | Too_large -> refusal 503 "too-large" (Printf.sprintf "the reply has more than %d bytes" p.limits.reply)
  | End_of_file | Unix.Unix_error _ | Lwt_io.Channel_closed _ ->
    refusal 503 "worker-died" "the process that worked on this has died, perhaps for lack of memory"
  | error -> refusal 500 "trouble" (Printexc.to_string error)

(* A worker that is not at the end of its reply is not used again. *)
let with_worker p ~client f =
  enter p client >>= function
  | Error r -> Lwt.return (Error r)
  | Ok () ->
    let work () =
      let w = match p.idle with w :: rest -> p.idle <- rest; w | [] -> start p in
      Lwt.catch (fun () -> f w >|= fun found -> keep p w; Ok found)
        (fun error -> dispose p w; Lwt.return (Error (why p error)))
    in
    Lwt.finalize
      (fun () -> Lwt.catch work (fun error -> Lwt.return (Error (why p error))))
      (fun () -> leave p client; Lwt.return_unit)

let rec rest ~most w buffer =
  frame ~most:(most - Buffer.length buffer) w >>= function
  | "" -> Lwt.return (Buffer.contents buffer)
  | piece -> Buffer.add_string buffer piece; rest ~most w buffer

let whole p ~client task ?(body = "") () =
  let work w =
    within p (fun () ->
        order w (Worker.head task) body >>= fun () ->
        frame ~most:p.limits.reply w >>= fun head ->
        rest ~most:p.limits.reply w (Buffer.create 4096) >|= fun body -> (head, body))
  in
  with_worker p ~client work >|= fun found ->
  Result.bind found (fun (head, body) ->
      Result.map_error (refusal 500 "trouble") (Worker.response_of head (Text body)))

let pieces p ~client task write =
  let next w = within p (fun () -> frame ~most:p.limits.reply w) in
  let rec copy w =
    next w >>= function
    | "" -> Lwt.return_unit
    | piece -> write piece >>= fun () -> copy w
  in
  with_worker p ~client (fun w ->
      order w (Worker.head task) "" >>= fun () ->
      next w >>= fun _ -> copy w)

let close p =
  p.is_closed <- true;
  List.iter (dispose p) p.all
