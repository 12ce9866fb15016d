open Dolphin_semantics
open Dolphin_runtime

module type S = sig
  include Platform.S

  val idle : t -> bool
  val vehicles : t -> World.vehicle_state list
  val running : t -> Core.vehicle -> string option
end

(* The passage of time between two looks. *)
module type Time = sig
  type t

  val virtual_time : bool

  val elapsed : t -> float
  (* How far it has passed by itself. *)

  val until : t -> float -> unit Lwt.t
  (* [until c time] is when [time] has come, or it is time to look again. *)
end

(* The shell: one state, and a pending [next] that looks at it again when a command has changed it. *)
module Make (Time : Time) = struct
  type t = {
    clock : Time.t;
    mutable fleet : Fleet.t;
    mutable changed : unit Lwt.u option;
    mutable early : Platform.event list;  (* to be given before anything else: see {!Reconstruction} *)
  }

  let name = "sim"
  let virtual_time = Time.virtual_time
  let order = Dolphin_semantics.World.By_hearing
  let announce_period = 10.
  let make clock ~seed scenario = { clock; fleet = Fleet.create ~seed scenario; changed = None; early = [] }

  let make_again clock ~seed scenario history =
    let again { Reconstruction.fleet; early; news } =
      ({ clock = clock (Fleet.now fleet); fleet; changed = None; early }, news)
    in
    Result.map again (Reconstruction.make ~seed ~announce_period scenario history)

  let catch_up p = p.fleet <- Fleet.advance p.fleet (Time.elapsed p.clock)

  let now p =
    catch_up p;
    Fleet.now p.fleet

  (* {1 Commands} *)

  let command p change =
    catch_up p;
    p.fleet <- change p.fleet;
    match p.changed with
    | None -> ()
    | Some waiting ->
      p.changed <- None;
      Lwt.wakeup_later waiting ()

  let announce_period _ = announce_period

  (* Early reports that a command has undone are dropped. *)
  let undo p overtaken = p.early <- List.filter (fun event -> not (overtaken event)) p.early

  let set_timer p timer seconds = command p (Fleet.set_timer timer seconds)

  let cancel_timer p timer =
    undo p (Overtaken.by_cancel timer);
    command p (Fleet.cancel_timer timer)

  let bind p vehicles = command p (Fleet.bind vehicles)
  let release p vehicles = command p (Fleet.release vehicles)
  let start p ~number:_ vehicle task = command p (Fleet.start vehicle task)

  let stop p vehicle =
    undo p (Overtaken.by_stop vehicle);
    command p (Fleet.stop vehicle)

  let set_connection_timeout p vehicles seconds = command p (Fleet.set_connection_timeout vehicles seconds)
  (* If time passes by itself, it does so for displays too. *)
  let telemetry p (how : Platform.telemetry) =
    let how = match how with Shown when not Time.virtual_time -> Platform.Awaited | Off | Shown | Awaited -> how in
    command p (Fleet.telemetry how)

  let look p =
    if not Time.virtual_time then []
    else
      let states, fleet = Fleet.look p.fleet in
      p.fleet <- fleet;
      states

  let close _ = Lwt.return_unit

  (* {1 Events} *)

  let change p =
    let promise, waiting = Lwt.task () in
    p.changed <- Some waiting;
    promise

  let rec next p =
    catch_up p;
    match p.early, Fleet.due p.fleet with
    | event :: others, _ -> p.early <- others; Lwt.return event
    | [], due -> next_due p due

  and next_due p due =
    match due with
    | None when Time.virtual_time -> Lwt.return Platform.Quiet
    | None -> Lwt.bind (change p) (fun () -> next p)
    | Some time when Time.virtual_time || time <= Time.elapsed p.clock -> take p
    | Some time -> Lwt.bind (Lwt.pick [ change p; Time.until p.clock time ]) (fun () -> next p)

  (* An event is taken and handed out in one go: it cannot be lost in between. *)
  and take p =
    match Fleet.step p.fleet with
    | None -> next p
    | Some (event, fleet) ->
      p.fleet <- fleet;
      (match event with Some event -> Lwt.return event | None -> next p)

  (* {1 Displays} *)

  let idle p = p.early = [] && Fleet.quiet p.fleet

  let vehicles p =
    catch_up p;
    Fleet.vehicles p.fleet

  let running p vehicle = Fleet.running p.fleet vehicle
end

module Virtual = struct
  include Make (struct
      type t = unit

      let virtual_time = true
      let elapsed () = 0.
      let until () _ = Lwt.return_unit
    end)

  let create ~seed scenario = make () ~seed scenario
  let create_again ~seed scenario history = make_again ignore ~seed scenario history
end

module Pace = struct
  type t = { now : unit -> float; speed : float }

  let virtual_time = false
  let elapsed clock = clock.now () *. clock.speed

  (* A system need not support a sleep of days. *)
  let longest_sleep = 3600.
  let until clock time =
    Lwt_unix.sleep (Float.max 0. (Float.min longest_sleep ((time -. elapsed clock) /. clock.speed)))
end

module Paced = struct
  include Make (Pace)

  let clock clock speed time =
    if not (Float.is_finite speed && speed > 0.) then Fmt.invalid_arg "Simulator.Paced.create: speed %g" speed;
    { Pace.now = Clock.stopwatch ~at:(time /. speed) clock; speed }

  let create ?clock:(source = Clock.system) ?(speed = 1.) ~seed scenario = make (clock source speed 0.) ~seed scenario

  let create_again ?clock:(source = Clock.system) ?(speed = 1.) ~seed scenario history =
    make_again (clock source speed) ~seed scenario history
end
