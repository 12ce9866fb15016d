open Dolphin_semantics
open Lwt.Infix

type step = { cause : Transition.event option; transition : Transition.t }

module Make (P : Platform.S) = struct
  type t = {
    platform : P.t;
    program : Core.program;
    observer : Observer.t;
    giving_up : (unit -> unit) -> unit;  (* calls it *)
    mutable configuration : Configuration.t;
    mutable world : World.t;
    mutable taken : int;  (* transitions *)
    mutable upcoming : Platform.event Lwt.t option;  (* the platform's next event, if it was asked for *)
    mutable held : Platform.event list;  (* reported, and not their turn yet *)
  }

  let drop s overtaken =
    s.held <- List.filter (fun told -> not (overtaken told)) s.held;
    s.upcoming <- Overtaken.left overtaken s.upcoming

  let carry_out s ~number : Effect.t -> unit = function
    | Start (v, p) -> drop s (Overtaken.by_stop v); P.start s.platform ~number v p
    | Stop v -> drop s (Overtaken.by_stop v); P.stop s.platform v
    | Set_timer (timer, seconds) -> P.set_timer s.platform timer seconds
    | Cancel_timer timer -> drop s (Overtaken.by_cancel timer); P.cancel_timer s.platform timer
    | Look_for pick ->
      let seconds = Option.value pick.timeout ~default:(P.announce_period s.platform) in
      P.set_timer s.platform Residual.script_timer seconds
    | Bind vs -> P.bind s.platform vs
    | Release vs -> P.release s.platform vs
    | Set_connection_timeout (vs, seconds) -> P.set_connection_timeout s.platform vs seconds
    | Put_question _ | Withdraw_question _ | Say _ | Ask _ | Call_host _ | End _ -> ()

  let take s { cause; transition } =
    s.observer.transition ~time:(P.now s.platform) ~cause transition;
    s.configuration <- transition.next;
    let number = s.taken in
    s.taken <- number + 1;
    List.iter (carry_out s ~number) transition.effects

  let see s state =
    s.world <- World.add state s.world;
    s.observer.news ~time:(P.now s.platform) state

  (* {1 Waiting} *)

  let upcoming s =
    match s.upcoming with
    | Some promise -> promise
    | None ->
      let promise = P.next s.platform in
      s.upcoming <- Some promise;
      promise

  (* Whether [told] permits [event]: the end of a task is known beforehand. *)
  let fits (event : Transition.event) (told : Platform.event) =
    match event, told with
    | (Vehicle_done v | Vehicle_failed (v, _)), (Task_done w | Task_failed (w, _)) -> String.equal v w
    | Timer_expired timer, Timer other -> timer = other
    | ( ( Vehicle_done _ | Vehicle_failed _ | Timer_expired _ | Confirmed _ | Recruited _ | Answered _
        | Nobody_answers _
        | Replied _ | Host_failed _ | Input _ | Interruption ), _ ) -> false

  let has_time : Transition.event -> bool = function
    | Vehicle_done _ | Vehicle_failed _ | Timer_expired _ -> true
    | Confirmed _ | Recruited _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ | Input _ | Interruption ->
      false

  let rec await s event =
    match List.partition (fits event) s.held with
    | _ :: _, others -> s.held <- others; Lwt.return_unit
    | [], _ -> (
        upcoming s >>= fun told ->
        s.upcoming <- None;
        match told with
        | Vehicle state -> see s state; await s event
        | Task_done _ | Task_failed _ | Timer _ | Input _ -> s.held <- s.held @ [ told ]; await s event
        (* The platform's vehicle never ends what this one has ended. *)
        | Quiet -> Lwt.return_unit)

  (* Vehicles that are there from the start are reported before this timer. *)
  let look_around s =
    P.set_timer s.platform Residual.script_timer 0.;
    await s (Timer_expired Residual.script_timer)

  (* {1 The run} *)

  let rec stop s =
    match Transition.accept s.program s.world s.configuration Interruption with
    | Ok transition -> take s { cause = Some Interruption; transition }; stop s
    | Error (Not_awaited | Bad_answer _) -> ()

  let is_stuck s =
    match s.configuration.control with
    | Executing (_, r) when Transition.awaited s.configuration = [] && s.program.inputs = [] -> (
        match Transition.internal s.program s.world s.configuration () with
        | Seq.Nil -> Some r
        | Seq.Cons _ -> None)
    | Executing _ | Script _ | Waiting _ | Ended _ -> None

  let over s : Driver.outcome =
    match s.configuration.control with
    | Ended ending -> Ended ending
    | Script _ | Waiting _ | Executing _ ->
      match is_stuck s with
      | Some r -> s.giving_up (fun () -> stop s); Stuck r
      | None -> stop s; Ended Interrupted

  let rec go s ~interruption = function
    | [] -> Lwt.return (over s)
    | step :: rest -> (
        let waits =
          match step.cause with Some event when has_time event -> await s event | Some _ | None -> Lwt.pause () in
        Lwt.pick [ (Lwt.protected interruption >|= fun () -> `Interrupted); (waits >|= fun () -> `Now) ] >>= function
        | `Now -> take s step; go s ~interruption rest
        | `Interrupted -> stop s; Lwt.return (Driver.Ended Interrupted))

  let run platform ~observer ~interruption ~giving_up program steps =
    let s =
      { platform; program; observer; giving_up; configuration = Configuration.initial program;
        world = World.nobody P.order; taken = 0; upcoming = None; held = [] }
    in
    let close () = Option.iter Lwt.cancel s.upcoming; P.close platform in
    Lwt.finalize
      (fun () ->
         P.telemetry platform Awaited;
         look_around s >>= fun () -> go s ~interruption steps)
      close
end

let run (type platform) (module P : Platform.S with type t = platform) (platform : platform) ~observer ~interruption
    ?(giving_up = fun interrupt -> interrupt ()) program steps =
  let module Enactment = Make (P) in
  Enactment.run platform ~observer ~interruption ~giving_up program steps
