open Dolphin_json
open Dolphin_runtime
open Lwt.Infix

let beside journal = journal ^ ".sock"
let longest_request = 65_536
let most_clients = 100

type run = {
  program : unit -> Program_file.t;
  inputs : Inputs.t;
  now : unit -> float;
  stop : unit -> unit;
  replace : ?set:(string * string) list -> ?hash:string -> string -> (float, Replacement.refusal) result Lwt.t;
}

type t = {
  run : run;
  path : string;
  listening : Lwt_unix.file_descr;
  journal : Unix.file_descr option;  (* never closed: that would give the lock of the journal away *)
  grown : unit Lwt_condition.t;
  mutable over : bool;
  mutable clients : int;
  mutable owed : int;  (* requests that were read and not replied to *)
  mutable followers : unit Lwt.t list;
}

(* {1 Requests} *)

let post t key json : Socket_message.reply Lwt.t =
  let program = (t.run.program ()).program and questions = Inputs.questions t.run.inputs in
  match Typed_input.declared program ~questions key, Host_value.data_of_json json with
  | Error why, _ -> Lwt.return (Socket_message.Wrong (Not_declared, why))
  | Ok (), Error why -> Lwt.return (Socket_message.Wrong (Bad_value, why))
  | Ok (), Ok x -> (
      match Typed_input.fits program key x with
      | Error why -> Lwt.return (Socket_message.Wrong (Bad_value, why))
      | Ok () -> (
          Inputs.post t.run.inputs key x >|= function
          | true -> Socket_message.Done (Some (t.run.now ()))
          | false when Inputs.is_closed t.run.inputs -> Wrong (Ended, "the run has ended")
          | false -> Wrong (Not_declared, "this question is not open any more")))

let status t : Socket_message.reply =
  let { Program_file.path; program; _ } = t.run.program () in
  Status_is
    { program = path; time = t.run.now (); inputs = program.inputs; questions = Inputs.questions t.run.inputs }

let code_of : Replacement.refusal -> Socket_message.code = function
  | Busy -> Busy
  | No_journal -> No_journal
  | Wrong_program _ -> Bad_program
  | Differs _ -> Differs
  | Over -> Ended

let replace t ?set ?hash path : Socket_message.reply Lwt.t =
  t.run.replace ?set ?hash path >|= function
  | Ok time -> Socket_message.Done (Some time)
  | Error refusal -> Wrong (code_of refusal, Replacement.message refusal)

(* The request of a line; the code that writes the reply begins [follow]. *)
let perform t (line : Lines.line) =
  let reply ?id (content : Socket_message.reply) = `Reply { Socket_message.id; content } in
  match line with
  | End_of_input -> Lwt.return `Over
  | Too_long ->
    let why = Printf.sprintf "the line is longer than %d bytes" longest_request in
    Lwt.return (reply (Wrong (Bad_request, why)))
  | Line text -> (
      match Socket_message.request_of_string text with
      | Error wrong -> Lwt.return (`Reply wrong)
      | Ok { id; content } -> (
          match content with
          | Post { key; value } -> post t key value >|= reply ?id
          | Replace { program; hash; set } -> replace t ?set ?hash program >|= reply ?id
          | Status -> Lwt.return (reply ?id (status t))
          | Stop ->
            t.run.stop ();
            Lwt.return (reply ?id (Done None))
          | Follow when t.journal = None ->
            Lwt.return (reply ?id (Wrong (No_journal, "the journal is not a file")))
          | Follow -> Lwt.return (`Follow { Socket_message.id; content = (Done None : Socket_message.reply) })))

(* {1 Clients} *)

type client = { socket : Lwt_unix.file_descr; lines : Lines.t; writing : Lwt_mutex.t }

let write client text = Lwt_mutex.with_lock client.writing (fun () -> Writer.write client.socket text)
let say client reply = write client (Codec.to_string Socket_message.reply reply ^ "\n")

(* The whole lines of the journal from [offset] on, up to a number of bytes, and their end. A line that is longer
   than that is read in one piece. *)
let rec journal_from fd offset size =
  let buffer = Bytes.create size in
  ignore (Unix.lseek fd offset SEEK_SET);
  let n = Unix.read fd buffer 0 size in
  match Bytes.rindex_from_opt buffer (n - 1) '\n' with
  | Some last -> (Bytes.sub_string buffer 0 (last + 1), offset + last + 1)
  | None when n = size -> journal_from fd offset (2 * size)
  | None -> ("", offset)
  | exception Invalid_argument _ -> ("", offset)

let page = 65_536

(* Each follower reads the journal at its own pace, so one that never reads costs nothing. *)
let rec follow t client fd offset =
  match journal_from fd offset page with
  | "", _ when t.over -> Lwt.return_unit
  | "", _ -> Lwt_condition.wait t.grown >>= fun () -> follow t client fd offset
  | lines, offset -> write client lines >>= fun () -> follow t client fd offset

let quietly f = Lwt.catch f (fun _ -> Lwt.return_unit)

let start_following t client =
  match t.journal with
  | None -> ()
  | Some fd ->
    let whole () =
      follow t client fd 0 >|= fun () -> Lwt_unix.shutdown client.socket SHUTDOWN_SEND
    in
    t.followers <- quietly whole :: t.followers

let reply_to t client line =
  t.owed <- t.owed + 1;
  let replied () =
    perform t line >>= function
    | `Over -> Lwt.return_false
    | `Reply reply -> say client reply >|= fun () -> true
    | `Follow reply -> say client reply >|= fun () -> start_following t client; true
  in
  Lwt.finalize replied (fun () -> t.owed <- t.owed - 1; Lwt.return_unit)

let rec serve t client =
  Lines.next client.lines >>= reply_to t client >>= fun goes_on -> if goes_on then serve t client else Lwt.return_unit

let admit t socket =
  let client = { socket; lines = Lines.make ~limit:longest_request socket; writing = Lwt_mutex.create () } in
  let leave () =
    t.clients <- t.clients - 1;
    quietly (fun () -> Lwt_unix.close socket)
  in
  t.clients <- t.clients + 1;
  let whole () =
    if t.clients > most_clients then
      say client { id = None; content = Wrong (Too_many, "too many programs are connected to this run") }
    else serve t client
  in
  Lwt.async (fun () -> Lwt.finalize (fun () -> quietly whole) leave)

(* If descriptors have run out, others may be closed meanwhile. *)
let rec accept t =
  Lwt.catch
    (fun () -> Lwt_unix.accept ~cloexec:true t.listening >|= fun (socket, _) -> admit t socket)
    (function
      | Unix.Unix_error ((EMFILE | ENFILE | ECONNABORTED | ENOBUFS | ENOMEM), _, _) -> Lwt_unix.sleep 0.1
      | error -> Lwt.fail error)
  >>= fun () -> accept t

(* {1 Opening and closing} *)

(* Other users may not even see it: the mask is set before the socket exists. *)
let bind path =
  let fd = Lwt_unix.socket ~cloexec:true PF_UNIX SOCK_STREAM 0 in
  let mask = Unix.umask 0o177 in
  let restore () = ignore (Unix.umask mask) in
  match
    if Sys.file_exists path then Unix.unlink path;
    Unix.bind (Lwt_unix.unix_file_descr fd) (ADDR_UNIX path)
  with
  | () ->
    restore ();
    Lwt_unix.listen fd 100;
    Ok fd
  | exception (Unix.Unix_error _ as error) ->
    restore ();
    Unix.close (Lwt_unix.unix_file_descr fd);
    let why =
      match error with
      | Unix.Unix_error (ENAMETOOLONG, _, _) -> "its path is too long"
      | Unix.Unix_error (error, _, _) -> Unix.error_message error
      | error -> Printexc.to_string error
    in
    Error (Printf.sprintf "%s: no values can be posted to this run: %s" path why)

(* The journal is locked by now, so a socket that is there is that of a console that died. *)
let open_ run ~journal =
  let path = beside journal in
  let start listening =
    let is_file = (Unix.stat journal).st_kind = S_REG in
    let journal = if is_file then Some (Unix.openfile journal [ O_RDONLY; O_CLOEXEC ] 0) else None in
    let t =
      { run; path; listening; journal; grown = Lwt_condition.create (); over = false; clients = 0; owed = 0;
        followers = [] }
    in
    Lwt.async (fun () -> quietly (fun () -> accept t));
    t
  in
  Result.map start (bind path)

let journal_grew t = Lwt_condition.broadcast t.grown ()

(* The time that clients with slow reading have for the rest. *)
let patience = 0.5

let rec replied t = if t.owed = 0 then Lwt.return_unit else Lwt_unix.sleep 0.01 >>= fun () -> replied t

let close t =
  t.over <- true;
  journal_grew t;
  Lwt.pick [ Lwt.join (replied t :: t.followers); Lwt_unix.sleep patience ] >>= fun () ->
  (try Unix.unlink t.path with Unix.Unix_error _ -> ());
  quietly (fun () -> Lwt_unix.close t.listening)

(* {1 Clients} *)

type connection = { input : in_channel; output : out_channel }

let connect ~journal =
  let fd = Unix.socket ~cloexec:true PF_UNIX SOCK_STREAM 0 in
  match Unix.connect fd (ADDR_UNIX (beside journal)) with
  | () -> Ok { input = Unix.in_channel_of_descr fd; output = Unix.out_channel_of_descr fd }
  | exception Unix.Unix_error (error, _, _) ->
    Unix.close fd;
    Error
      (match error with
       | ENOENT | ECONNREFUSED -> journal ^ ": this run does not go on, or has no socket"
       | error -> Printf.sprintf "%s: %s" (beside journal) (Unix.error_message error))

let ask c request =
  match
    output_string c.output (Codec.to_string Socket_message.request { id = None; content = request } ^ "\n");
    flush c.output;
    input_line c.input
  with
  | exception (End_of_file | Sys_error _) -> Error "the run has ended"
  | line -> (
      match Result.bind (Host_value.parse line) (Codec.read Socket_message.reply) with
      | Error _ -> Error ("this is not a reply: " ^ line)
      | Ok { content = Wrong (_, message); _ } -> Error message
      | Ok { content = (Done _ | Status_is _) as reply; _ } -> Ok reply)

let time_of : Socket_message.reply -> float = function
  | Done (Some time) -> time
  | Done None | Status_is _ | Wrong _ -> 0.

let post c key x =
  let ask value = ask c (Post { key; value }) in
  Result.map time_of (Result.bind (Host_value.to_json x) ask)

let replace c ~set ~hash path =
  Result.map time_of (ask c (Replace { program = path; hash = Some hash; set = Some set }))

let status c =
  match ask c Status with
  | Ok (Status_is status) -> Ok status
  | Ok (Done _ | Wrong _) -> Error "this reply is not about a run's status"
  | Error _ as error -> error

let rec copy c out =
  match input_line c.input with
  | line ->
    output_string out (line ^ "\n");
    flush out;
    copy c out
  | exception (End_of_file | Sys_error _) -> ()
