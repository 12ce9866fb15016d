(* Process [k] of [jobs] computes [f (first + k)], [f (first + k + jobs)], ..., and writes each into its pipe. *)
type worker = {
  pid : int;
  pipe : Unix.file_descr;
  mutable next : int;  (* the number whose result comes next *)
  mutable read : Bytes.t;  (* its outcome *)
  mutable is_open : bool;
  mutable is_there : bool;  (* its end was not waited for yet *)
}

type 'a t = { workers : worker list; jobs : int; last : int option }

exception Died of { number : int; how : string }

let is_past last n = match last with Some last -> n > last | None -> false

(* {1 In the child} *)

(* After an alarm, the progress of a call that writes more than once would be unknown. *)
let rec write_all fd bytes from =
  if from < Bytes.length bytes then
    match Unix.single_write fd bytes from (Bytes.length bytes - from) with
    | n -> write_all fd bytes (from + n)
    | exception Unix.Unix_error (EINTR, _, _) -> write_all fd bytes from
    | exception Unix.Unix_error (EPIPE, _, _) -> Unix._exit 0  (* the requester has gone *)

(* A killed process cannot inform its children, so they check whether it still lives. *)
let die_with parent =
  let look _ = if Unix.getppid () <> parent then Unix._exit 0 in
  Sys.set_signal Sys.sigalrm (Signal_handle look);
  ignore (Unix.setitimer ITIMER_REAL { it_interval = 0.5; it_value = 0.5 })

let compute ~parent ~jobs ~last pipe f n =
  List.iter (fun signal -> Sys.set_signal signal Sys.Signal_default) (Ending_signals.requests @ Ending_signals.others);
  List.iter (fun signal -> Sys.set_signal signal Sys.Signal_ignore) [ Sys.sigint; Sys.sighup; Sys.sigxfsz ];
  die_with parent;
  let rec from n =
    if not (is_past last n) then begin
      write_all pipe (Marshal.to_bytes (f n) []) 0;
      from (n + jobs)
    end
  in
  match from n with
  | () -> Unix._exit 0
  | exception error ->
    prerr_endline (Printexc.to_string error);
    Unix._exit 1

(* {1 In the parent} *)

(* If SIGCHLD is ignored, waiting is not possible. *)
let rec wait w =
  match Unix.waitpid [] w.pid with
  | _, status ->
    w.is_there <- false;
    status
  | exception Unix.Unix_error (EINTR, _, _) -> wait w
  | exception Unix.Unix_error (ECHILD, _, _) ->
    w.is_there <- false;
    Unix.WEXITED 0

let end_all workers =
  let kill w = try if w.is_there then Unix.kill w.pid Sys.sigkill with Unix.Unix_error _ -> () in
  let bury w =
    if w.is_there then ignore (wait w : Unix.process_status);
    Unix.close w.pipe
  in
  List.iter kill workers;
  List.iter bury workers

let start ~jobs ~first ?last f =
  let parent = Unix.getpid () and workers = ref [] in
  let start k =
    let pipe, output = Unix.pipe ~cloexec:true () in
    match Unix.fork () with
    | 0 ->
      List.iter (fun w -> Unix.close w.pipe) !workers;
      Unix.close pipe;
      compute ~parent ~jobs ~last output f (first + k)
    | pid ->
      Unix.close output;
      let worker = { pid; pipe; next = first + k; read = Bytes.empty; is_open = true; is_there = true } in
      workers := worker :: !workers
    | exception error ->
      Unix.close pipe;
      Unix.close output;
      raise error
  in
  flush_all ();
  match List.iter start (List.init jobs Fun.id) with
  | () -> { workers = !workers; jobs; last }
  | exception error ->
    end_all !workers;
    raise error

(* The results that [w.read] begins with. *)
let rec results w jobs =
  let length = Bytes.length w.read in
  if length < Marshal.header_size || length < Marshal.total_size w.read 0 then []
  else
    let size = Marshal.total_size w.read 0 in
    let n = w.next and result = Marshal.from_bytes w.read 0 in
    w.read <- Bytes.sub w.read size (length - size);
    w.next <- n + jobs;
    (n, result) :: results w jobs

let how = function
  | Unix.WEXITED n -> Printf.sprintf "with status %d" n
  | WSIGNALED n when n = Sys.sigkill -> "killed"
  | WSIGNALED _ | WSTOPPED _ -> "by a signal"

let read buffer last jobs w =
  match Unix.read w.pipe buffer 0 (Bytes.length buffer) with
  | 0 when is_past last w.next ->
    w.is_open <- false;
    []
  | 0 -> raise (Died { number = w.next; how = how (wait w) })
  | n ->
    w.read <- Bytes.cat w.read (Bytes.sub buffer 0 n);
    results w jobs
  | exception Unix.Unix_error (EINTR, _, _) -> []

(* A process that is far ahead of the others waits in its pipe: its results are of no use without theirs. *)
let furthest = 10_000

let next t ~timeout =
  let still = List.filter (fun w -> w.is_open) t.workers in
  let least = List.fold_left (fun n w -> min n w.next) max_int still in
  let near = List.filter (fun w -> w.next - least <= furthest) still in
  match Unix.select (List.map (fun w -> w.pipe) near) [] [] timeout with
  | [], _, _ -> []
  | ready, _, _ ->
    let buffer = Bytes.create 65_536 in
    List.concat_map (read buffer t.last t.jobs) (List.filter (fun w -> List.mem w.pipe ready) near)
  | exception Unix.Unix_error (EINTR, _, _) -> []

let is_done t = List.for_all (fun w -> not w.is_open) t.workers

let under_way t =
  List.sort compare (List.filter_map (fun w -> if is_past t.last w.next then None else Some w.next) t.workers)

let stop t = end_all t.workers
