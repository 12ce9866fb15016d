open Lwt.Infix

module Make (P : Platform.S) = struct
  type t = {
    platform : P.t;
    mutable guard : Fence_guard.t;
    mutable failures : Platform.event list;  (* to be reported, in order *)
    mutable upcoming : Platform.event Lwt.t option;  (* of the platform, asked for *)
    mutable waiting : unit Lwt.u option;  (* to wake those waiting for the next event *)
  }

  let name = P.name
  let virtual_time = P.virtual_time
  let order = P.order
  let now p = P.now p.platform
  let announce_period p = P.announce_period p.platform
  let set_timer p = P.set_timer p.platform
  let bind p = P.bind p.platform
  let release p = P.release p.platform
  let set_connection_timeout p = P.set_connection_timeout p.platform

  let telemetry p how = P.telemetry p.platform (if Fence_guard.watches p.guard then Awaited else how)

  let wake p =
    let waiting = p.waiting in
    p.waiting <- None;
    Option.iter (fun waiting -> Lwt.wakeup_later waiting ()) waiting

  let fail p (v, why) =
    p.failures <- p.failures @ [ Platform.Task_failed (v, why) ];
    wake p

  let start p ~number v task =
    match Fence_guard.start v task p.guard with
    | Ok guard -> p.guard <- guard; P.start p.platform ~number v task
    | Error why -> fail p (v, why)

  (* Reports that were not read yet and that a command has overtaken are dropped. *)
  let drop p overtaken =
    p.failures <- List.filter (fun event -> not (overtaken event)) p.failures;
    p.upcoming <- Overtaken.left overtaken p.upcoming

  let stop p v =
    drop p (Overtaken.by_stop v);
    if Fence_guard.is_under_way v p.guard then begin
      p.guard <- Fence_guard.over v p.guard;
      P.stop p.platform v
    end

  let cancel_timer p timer =
    drop p (Overtaken.by_cancel timer);
    P.cancel_timer p.platform timer

  let stop_and_fail p (v, why) =
    stop p v;
    fail p (v, why)

  let make guard ~untold platform =
    let p = { platform; guard; failures = []; upcoming = None; waiting = None } in
    if Fence_guard.watches guard then P.telemetry platform Awaited;
    List.iter (stop_and_fail p) untold;
    p

  (* {1 Events} *)

  let see p (state : Dolphin_semantics.World.vehicle_state) =
    p.guard <- Fence_guard.see state p.guard;
    List.iter (stop_and_fail p) (Fence_guard.breaking state.id p.guard)

  let look p =
    let states = P.look p.platform in
    List.iter (see p) states;
    states

  let read p (event : Platform.event) =
    (match event with
     | Vehicle state -> see p state
     | Task_done v | Task_failed (v, _) -> p.guard <- Fence_guard.over v p.guard
     | Timer _ | Input _ | Quiet -> ());
    event

  let of_platform p =
    match p.upcoming with
    | Some event -> event
    | None ->
      let event = P.next p.platform in
      p.upcoming <- Some event;
      event

  let rec next p =
    match p.failures with
    | event :: others -> p.failures <- others; Lwt.return event
    | [] -> (
        let event = of_platform p in
        match Lwt.state event with
        | Return event -> p.upcoming <- None; Lwt.return (read p event)
        | Fail error -> p.upcoming <- None; Lwt.fail error
        | Sleep ->
          let woken, waiting = Lwt.task () in
          p.waiting <- Some waiting;
          Lwt.try_bind
            (fun () -> Lwt.choose [ event >|= ignore; woken ])
            (fun () -> p.waiting <- None; next p)
            (fun error -> p.waiting <- None; p.upcoming <- None; Lwt.fail error))

  let close p = P.close p.platform
end
