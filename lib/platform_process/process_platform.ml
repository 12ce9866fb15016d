open Dolphin_platform_protocol
open Dolphin_semantics
open Dolphin_runtime
open Lwt.Infix
module Order = Dolphin_platform_protocol.Order

let source = Logs.Src.create "dolphin.platform" ~doc:"What adapters are ordered and report"

module Log = (val Logs.src_log source : Logs.LOG)

type options = {
  command : string;
  purpose : Order.purpose;
  program : string option;
  run : string;
  dolphin : string;
  taken : string list;
  close_patience : float;
  note : Core.vehicle option -> string -> unit;
  keep : time:float -> Core.vehicle -> Yojson.Safe.t -> unit;
  sync : (unit -> unit Lwt.t) option;
  clock : Clock.t;
}

let default ~command =
  { command; purpose = Run; program = None; run = ""; dolphin = ""; taken = []; close_patience = 5.;
    note = (fun _ _ -> ()); keep = (fun ~time:_ _ _ -> ()); sync = None; clock = Clock.system }

type t = {
  options : options;
  platform : string;
  greeting : Report.greeting;  (* the first one *)
  now : unit -> float;
  mutable dispatch : Dispatch.t;
  mutable adapter : Adapter.t option;
  mutable write_ahead : unit Write_ahead.t option;
  shell : Shell.t;
  mutable checks : (int * string list Lwt.u) list;
  mutable checked : int;
  mutable said_quiet : unit Lwt.u option;
}

let name = "process"
let virtual_time = false

(* Reports come when they come. *)
let order = Dolphin_semantics.World.By_id
let announce_period p = p.greeting.announce
let now p = p.now ()
let platform p = p.platform
let offers p = p.greeting.plans
let restart_delays = [ 1.; 2.; 4.; 8.; 16.; 30. ]

(* An adapter that lived this long and died is started again without a delay. *)
let long_life = 60.

(* {1 Outputs} *)

let send p order =
  match p.adapter with
  | None -> ()
  | Some adapter ->
    let line = Order.to_line order in
    Log.debug (fun m -> m "%.3f %s < %s" (now p) p.platform (String.trim line));
    Adapter.send adapter line

let told p why = p.options.note None (Printf.sprintf "platform %s: %s" p.platform why)

(* A note gets a number, and its action is done once it is durable. *)
let when_durable p key done_ =
  match p.write_ahead with
  | None -> done_ ()
  | Some w -> Write_ahead.require w key

let rec carry_out p : Dispatch.output -> unit = function
  | Send order -> send p order
  | Keep (v, json) -> p.options.keep ~time:(now p) v json
  | Keep_before (v, json, request) ->
    p.options.keep ~time:(now p) v json;
    when_durable p ("r" ^ request) (fun () -> durable p request)
  | Keep_and_tell (v, json, id) ->
    p.options.keep ~time:(now p) v json;
    when_durable p ("n" ^ string_of_int id) (fun () -> send p (Kept id))
  | Remark (v, text) -> if v = None then told p text else p.options.note v text
  | Give_up why ->
    told p (why ^ ", and is ended");
    Option.iter (fun adapter -> Lwt.async (fun () -> Adapter.close adapter)) p.adapter

and change p (dispatch, outputs) =
  p.dispatch <- dispatch;
  List.iter (carry_out p) outputs

and durable p request = change p (Dispatch.durable ~now:(now p) request p.dispatch)

let settle p =
  Shell.settle p.shell
    ~has_event:(Dispatch.waiting p.dispatch)
    ~quiet:(fun () -> Dispatch.quiet p.dispatch)
    ~due:(Dispatch.due p.dispatch)

let command p f =
  change p (f p.dispatch);
  settle p

let absorb p f = try command p f with error -> Shell.fail p.shell error

let write_ahead p sync =
  let become_durable keys =
    let one key =
      let rest = String.sub key 1 (String.length key - 1) in
      if key.[0] = 'r' then durable p rest else send p (Kept (int_of_string rest))
    in
    (try List.iter one keys with error -> Shell.fail p.shell error);
    settle p
  in
  Write_ahead.make ~sync ~leave:(fun keys _ -> become_durable keys) ~failed:(fun _ error -> Shell.fail p.shell error)

(* {1 Reports} *)

let hear p = function
  | Adapter.Garbage why ->
    absorb p (Dispatch.refused ~now:(now p) why)
  | Adapter.Report report -> (
      Log.debug (fun m -> m "%.3f %s > %s" (now p) p.platform (String.trim (Report.to_line report)));
      absorb p (Dispatch.report ~now:(now p) report);
      match report with
      | Checked { id; problems } -> (
          match List.assoc_opt id p.checks with
          | Some waiting ->
            p.checks <- List.remove_assoc id p.checks;
            Lwt.wakeup_later waiting problems
          | None -> ())
      | Quiet ->
        Option.iter (fun u -> Lwt.wakeup_later u ()) p.said_quiet;
        p.said_quiet <- None
      | Hello _ | Trouble _ | Vehicle _ | Gone _ | Pong _ | Request _ | Note _ | Log _ -> ())

(* {1 Time} *)

let watch p =
  Shell.watch p.shell
    ~now:(fun () -> now p)
    ~due:(fun () -> Dispatch.due p.dispatch)
    ~tick:(fun ~now -> absorb p (Dispatch.tick ~now))

(* {1 The adapter's life} *)

let hello options ~resumes : Order.t =
  Hello
    { version = Report.version; dolphin = options.dolphin; purpose = options.purpose; program = options.program;
      resumes }

let rec live p adapter ~delays =
  let born = now p in
  Adapter.listen adapter (hear p) >>= fun why ->
  p.adapter <- None;
  Adapter.close adapter >>= fun () ->
  if Shell.is_closed p.shell then Lwt.return_unit
  else begin
    told p (Printf.sprintf "the adapter %s; its vehicles have lost their link" why);
    absorb p (Dispatch.died ~now:(now p));
    revive p ~delays:(if now p -. born >= long_life then restart_delays else delays)
  end

and revive p ~delays =
  let delay, later = match delays with [ last ] -> (last, delays) | first :: later -> (first, later) | [] -> (1., []) in
  Lwt_unix.sleep delay >>= fun () ->
  if Shell.is_closed p.shell then Lwt.return_unit
  else
    Adapter.start ~command:p.options.command (hello p.options ~resumes:true) >>= function
    | Error why ->
      told p (Printf.sprintf "the adapter, started again, %s" why);
      revive p ~delays:later
    | Ok (adapter, _) when Shell.is_closed p.shell -> Adapter.close adapter
    | Ok (adapter, greeting) ->
      p.adapter <- Some adapter;
      told p "the adapter runs again";
      absorb p (Dispatch.born ~now:(now p) greeting);
      live p adapter ~delays:later

let guard p thread = Lwt.async (fun () -> Lwt.catch thread (fun error -> Shell.fail p.shell error; Lwt.return_unit))

(* {1 Opening} *)

let rec free_name taken name n =
  let candidate = if n = 1 then name else Printf.sprintf "%s-%d" name n in
  if List.mem candidate taken then free_name taken name (n + 1) else candidate

(* A run without an identity, as journals of earlier versions have it, gets one unlike that of any other console. *)
let run_of options =
  if options.run <> "" then options.run
  else
    let random = Random.State.make_self_init () in
    String.init 8 (fun _ -> "abcdefghijkmnpqrstuvwxyz23456789".[Random.State.int random 32])

let make options ~time ~resume adapter (greeting : Report.greeting) =
  let platform = free_name options.taken greeting.name 1 in
  let dispatch = Dispatch.create ~platform ~identity:(Request_identity.make ~run:(run_of options)) in
  let dispatch = resume ~announce_period:greeting.announce ~platform dispatch in
  let p =
    { options; platform; greeting; now = Clock.stopwatch ~at:time options.clock; dispatch; adapter = Some adapter;
      write_ahead = None; shell = Shell.make (); checks = []; checked = 0; said_quiet = None }
  in
  p.write_ahead <- Option.map (write_ahead p) options.sync;
  absorb p (Dispatch.born ~now:(now p) greeting);
  guard p (fun () -> live p adapter ~delays:restart_delays);
  guard p (fun () -> watch p);
  p

let opened options ~time ~resumes resume =
  Adapter.start ~command:options.command (hello options ~resumes) >|= function
  | Ok (adapter, greeting) -> Ok (make options ~time ~resume adapter greeting)
  | Error why -> Error (Printf.sprintf "the adapter '%s' %s" options.command why)

let open_ options = opened options ~time:0. ~resumes:false (fun ~announce_period:_ ~platform:_ d -> d)

let open_again options ~time history =
  opened options ~time ~resumes:true (fun ~announce_period ~platform d ->
      Dispatch.resume ~now:time ~announce_period (history platform) d)

(* {1 Commands} *)

let quietly p f = command p (fun d -> (f d, []))
let set_timer p timer seconds = quietly p (Dispatch.set_timer ~now:(now p) timer seconds)
let cancel_timer p timer = quietly p (Dispatch.cancel_timer timer)
let bind p vehicles = command p (Dispatch.bind vehicles)
let release p vehicles = command p (Dispatch.release vehicles)
let start p ~number vehicle task = command p (Dispatch.start ~now:(now p) ~number vehicle task)
let stop p vehicle = command p (Dispatch.stop ~now:(now p) vehicle)
let set_connection_timeout p vehicles seconds = command p (Dispatch.set_connection_timeout vehicles seconds)
let telemetry p how = command p (Dispatch.telemetry (how <> Platform.Off))
let look _ = []

(* {1 Events} *)

let next p =
  Shell.next p.shell (fun () ->
      match Dispatch.take p.dispatch with
      | None -> None
      | Some (event, dispatch) ->
        p.dispatch <- dispatch;
        Some event)

(* {1 Checking plans} *)

let check p ?vehicle task =
  let id = p.checked + 1 in
  p.checked <- id;
  let problems, waiting = Lwt.task () in
  p.checks <- (id, waiting) :: p.checks;
  send p (Check { id; vehicle; plan = Plan_body.to_json task });
  let late () = Error (Printf.sprintf "no answer within %g s" p.greeting.patience) in
  Lwt.pick
    [ (problems >|= fun problems -> Ok problems); (Lwt_unix.sleep p.greeting.patience >|= late) ]

(* {1 Closing} *)

let within seconds promise = Lwt.pick [ promise; Lwt_unix.sleep seconds ]

let wait_for_stops p =
  if Dispatch.quiet p.dispatch then Lwt.return_unit
  else within p.options.close_patience (Shell.until_quiet p.shell)

let say_goodbye p adapter =
  let quiet, said_quiet = Lwt.task () in
  p.said_quiet <- Some said_quiet;
  send p Close;
  within p.options.close_patience quiet >>= fun () -> Adapter.close adapter

let close p =
  if Shell.is_closed p.shell then Lwt.return_unit
  else begin
    command p (Dispatch.stop_all ~now:(now p));
    wait_for_stops p >>= fun () ->
    let tell (v, plan) =
      p.options.note (Some v) (Printf.sprintf "may still run plan %s: it was not heard to have stopped" plan)
    in
    List.iter tell (Dispatch.unsettled p.dispatch);
    change p (Dispatch.last_refusals p.dispatch);
    Shell.close p.shell;
    match p.adapter with None -> Lwt.return_unit | Some adapter -> say_goodbye p adapter
  end

let leave p =
  Shell.close p.shell;
  Option.fold p.adapter ~none:Lwt.return_unit ~some:Adapter.close

let vehicles p = Dispatch.vehicles p.dispatch
