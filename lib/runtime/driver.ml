open Dolphin_plans
open Dolphin_semantics
open Lwt.Infix

type outcome = Ended of Configuration.ending | Stuck of Residual.t | Spins of Core.site

let guards r =
  let guard (Task_rules.Step { offer; _ }) =
    match offer with
    | Check closure -> Some closure
    | Guard_values closure -> Some closure
    | Start _ | Perform _ | Guard_false _ | Guard_either _ | Measure _ | Make _ | Allocate _ | End_of _ | Expiry_of _
    | Answer_to _ | Recruit_for _ -> None
  in
  List.of_seq (Seq.filter_map guard (Task_rules.steps r))

let pp_outcome ppf = function
  | Ended ending -> Effect.pp ppf (End ending)
  | Spins _ -> Format.pp_print_string ppf "stuck: the rounds of a repeat follow each other without a wait"
  | Stuck r -> Format.fprintf ppf "stuck: nothing can make these guards true any more: %a" Residual.pp r

type call =
  site:Core.site ->
  subject:string option ->
  member:string ->
  arguments:Core.value list option ->
  (Core.value, string) result Lwt.t

let no_host ~site:_ ~subject:_ ~member:_ ~arguments:_ =
  Lwt.return (Error "no host process to call: name one with --supplier")

type beginning = {
  configuration : Configuration.t;
  world : World.t;
  news : World.vehicle_state list;
  pending : Transition.event option;
  transitions : int;
  time : float;
}

type replacement = { program : Core.program; configuration : Configuration.t }

let afresh program order =
  { configuration = Configuration.initial program; world = World.nobody order; news = []; pending = None;
    transitions = 0; time = 0. }

(* The number of transitions and events that may pass before others get their turn. *)
let most_without_pause = 100

(* Limit on rounds of a repeat, or of a task that is tried again, that begin without time or an event between them;
   and on the tasks that one vehicle begins at one instant. *)
let most_rounds = 10_000

(* Limit on visible transitions at one instant, of any kind: loops of the script have no rounds that could be counted.
   Missions of thousands of vehicles take some 100,000 at one instant. Where time passes by itself, an instant lasts
   until an event that was waited for: so the number does not depend on how fast the machine is. *)
let most_steps = 1_000_000

(* Limit on silent transitions of the script at one instant, each of 10,000 evaluations: a computation without any
   visible step. *)
let most_silent_steps = 10_000

(* Where time passes by itself, a round takes some even if it does not wait: a vehicle that refuses a plan does, and so
   does a busy machine. There, [most_rounds] must take less on average than [instant] (s), and in the machine's time,
   of which a simulation may have several seconds in one, than [moment] (s). *)
let instant = 0.1
let moment = 0.006

let begins_round (t : Transition.t) =
  List.exists (function Rule.Repeat_2 | Repeat_again | Watch_retry -> true | _ -> false) t.rules

let first_repeat r =
  let site : Residual.t -> Core.site option = function
    | Repeat { again = { left = None; site; _ }; _ } -> Some site
    | Watch (Unallocated _, { code; anew = Some _ }) -> Some code.lambda.lambda_site
    | _ -> None
  in
  Residual.fold_active (fun found r -> if found = None then site r else found) None r

(* The events from outside. *)
type news =
  | Seen of World.vehicle_state
  | Posted of Inputs.item
  | Event of (Transition.event, Transition.refusal) result
  | Asked_again  (* an answer was neither yes nor no *)
  | Date_reached  (* code that reads the date may do something else now *)
  | Unanswered of Residual.timer  (* unanswered here, but it may be answered elsewhere *)
  | Offered of (unit -> replacement option)  (* another program *)
  | Nothing_more

module Make (P : Platform.S) = struct
  type t = {
    platform : P.t;
    mutable program : Core.program;
    console : Console.t;
    call : call;
    observer : Observer.t;
    always_telemetry : bool;
    breakable : Breakable.t;
    giving_up : (unit -> unit) -> unit;  (* calls it *)
    inputs : Inputs.t;
    replacements : (unit -> replacement option) Lwt_mvar.t option;
    mutable offered : news Lwt.t option;  (* the next of them, if it was asked for *)
    mutable interruptions : news Lwt.t list;  (* those to come, the next one first *)
    mutable configuration : Configuration.t;
    mutable taken : int;  (* transitions of the run *)
    mutable world : World.t;
    mutable dates : Dated_code.t;
    mutable moment : float;  (* the time of the world, if the program reads it *)
    mutable alarm : int option;  (* the date for which the platform's timer is set *)
    mutable alarms : int;  (* that rang since the latest event *)
    mutable progress : Vehicle_progress.t option;  (* if the program asks for it *)
    mutable telemetry : Platform.telemetry;  (* as the platform was asked last *)
    mutable upcoming : (Platform.event Lwt.t * news Lwt.t) option;
    (* the platform's next event, if it was asked for, as it is reported and as it is read *)
    mutable reply : news Lwt.t option;  (* from the console or the host, if it is awaited *)
    questions : news Task_questions.t;  (* of tasks *)
    mutable unknown : Fault.t list;  (* the reports that were due *)
    mutable posted : news Lwt.t option;  (* the next input, if it was asked for *)
    mutable input_before : bool;  (* whether the latest piece of news was an input *)
    mutable since_pause : int;  (* transitions and events since others had their turn *)
    mutable rounds : int;  (* of repeats that began since the last event or instant *)
    mutable round_began : float;  (* when the latest of them, or of [starts], did *)
    mutable counted_since : float * float;  (* a time of the run, and the same by the machine's clock *)
    starts : (Core.vehicle, int) Hashtbl.t;  (* of tasks, in the same way *)
    mutable restless : Core.site option;  (* the place of the task that one vehicle began too often *)
    mutable steps : int;  (* visible transitions at this instant *)
    mutable silent_steps : int;  (* silent ones at this instant *)
    mutable stepped : float;  (* the instant, in virtual time *)
    immediate : (Residual.timer, unit) Hashtbl.t;  (* timers of no length, and questions answered as they were put *)
    mutable at_once : bool;  (* whether [reply] was there as it was asked for *)
  }

  let is_resolved promise = match Lwt.state promise with Lwt.Sleep -> false | Return _ | Fail _ -> true

  (* {1 News of vehicles} *)

  let with_progress s ~time state =
    match s.progress with
    | None -> state
    | Some progress ->
      let progress, state = Vehicle_progress.see ~at:time state progress in
      s.progress <- Some progress;
      state

  let see s state =
    s.since_pause <- s.since_pause + 1;
    let time = P.now s.platform in
    let state = with_progress s ~time state in
    s.world <- World.add state s.world;
    Log.vehicle ~time state;
    s.observer.news ~time state

  (* The program may look at its progress from now on: it is written like a report. *)
  let note_progress s v change =
    match s.progress, World.find v s.world with
    | Some progress, Some state -> s.progress <- Some (change state progress); see s state
    | _, _ -> ()

  let note_start s v p = note_progress s v (fun state -> Vehicle_progress.start state p)
  let note_end s v = note_progress s v (fun _ -> Vehicle_progress.finish v)
  let note_stop s v = s.progress <- Option.map (Vehicle_progress.stop v) s.progress

  (* {1 Effects} *)

  let await_reply s promise =
    s.at_once <- is_resolved promise;
    s.reply <- Some promise

  let ask s prompt =
    let answer = function
      | Ok text -> Event (Answer.event s.program text)
      | Error why -> Event (Ok (Nobody_answers why))
    in
    await_reply s (s.console.ask prompt >|= answer)

  let call_host s subject member arguments =
    let site = Configuration.site s.configuration in
    let reply = function Ok x -> Event (Ok (Replied x)) | Error why -> Event (Ok (Host_failed why)) in
    await_reply s (s.call ~site ~subject ~member ~arguments >|= reply)

  (* {2 Questions of tasks} *)

  let replied s question reply =
    match reply with
    | Error why when P.virtual_time -> Event (Ok (Confirmed (question, Error why)))
    | Error _ -> Unanswered question
    | Ok text -> (
        match Answer.confirmation text with
        | Some yes -> Event (Ok (Confirmed (question, Ok yes)))
        | None -> s.console.refused "it takes yes or no"; Asked_again)

  (* When the program has nothing else to do. *)
  let show_question s =
    let ask question prompt =
      let promise = s.console.ask prompt >|= replied s question in
      if is_resolved promise then Hashtbl.replace s.immediate question ();
      promise
    in
    Task_questions.show s.questions ~ask

  let tell_inputs s = Inputs.ask s.inputs (List.map snd (Task_questions.standing s.questions))

  let put_question s question prompt =
    Task_questions.put s.questions question prompt;
    tell_inputs s

  let withdraw_question s question =
    Task_questions.withdraw s.questions question;
    tell_inputs s

  (* A declared input is one, whatever its key. *)
  let posted s (item : Inputs.item) : Transition.event =
    match Task_questions.answered_by s.questions item with
    | Some (question, yes) when not (List.mem item.key s.program.inputs) -> Confirmed (question, Ok yes)
    | Some _ | None -> Input (item.key, item.value)

  (* Of the platform's next event, perhaps reported already, though an input was read first. *)
  let drop s overtaken =
    let still (told, _ as both) = if Overtaken.unless overtaken told then Some both else None in
    s.upcoming <- Option.bind s.upcoming still

  let set_timer s timer seconds =
    if seconds <= 0. then Hashtbl.replace s.immediate timer () else Hashtbl.remove s.immediate timer;
    P.set_timer s.platform timer seconds

  let carry_out s ~number : Effect.t -> unit = function
    | Start (v, p) -> note_start s v p; P.start s.platform ~number v p
    | Stop v -> note_stop s v; drop s (Overtaken.by_stop v); P.stop s.platform v
    | Set_timer (timer, seconds) -> set_timer s timer seconds
    | Cancel_timer timer ->
      Hashtbl.remove s.immediate timer;
      drop s (Overtaken.by_cancel timer);
      P.cancel_timer s.platform timer
    | Put_question (question, prompt) -> put_question s question prompt
    | Withdraw_question question -> withdraw_question s question
    | Look_for pick ->
      let seconds = Option.value pick.timeout ~default:(P.announce_period s.platform) in
      set_timer s Residual.script_timer seconds
    | Bind vs -> P.bind s.platform vs
    | Release vs -> P.release s.platform vs
    | Set_connection_timeout (vs, seconds) -> P.set_connection_timeout s.platform vs seconds
    | Say text -> s.console.say text
    | Ask prompt -> ask s prompt
    | Call_host { subject; member; arguments } -> call_host s subject member arguments
    | End _ -> ()

  (* One effect that cannot be carried out does not keep the others, a vehicle's stop perhaps, from being so. *)
  let carry_out_all s ~number effects =
    let attempt failure one =
      match carry_out s ~number one with
      | () -> failure
      | exception error -> if failure = None then Some (error, Printexc.get_raw_backtrace ()) else failure
    in
    match List.fold_left attempt None effects with
    | None -> ()
    | Some (error, backtrace) -> Printexc.raise_with_backtrace error backtrace

  (* {1 Transitions} *)

  (* The time that a program reads is that of the journal's line. *)
  let time_of s = if s.program.reads_now then s.moment else P.now s.platform

  let look_at_clock s =
    if s.program.reads_now then begin
      s.moment <- Float.max s.moment (P.now s.platform);
      s.world <- World.at (Exactly (World.whole s.moment)) s.world
    end

  (* The question needs no answer any more. *)
  let withdraw s =
    let reply = s.reply in
    s.reply <- None;
    Option.iter Lwt.cancel reply

  (* Whether the event came without a wait, where time passes by itself: no vehicle or person has a part in it. *)
  let is_immediate s : Transition.event -> bool = function
    | Timer_expired timer | Confirmed (timer, _) -> Hashtbl.mem s.immediate timer
    | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ -> s.at_once
    | Recruited _ -> true
    | _ -> false

  (* Ends of tasks and of timers that come at the same instant do not let a round wait; nor do answers without a
     person to take time for them. *)
  let lets_wait ~time s : Transition.event option -> bool = function
    | None | Some (Recruited _) -> false
    | Some (Input _ | Interruption) -> true
    | Some (Vehicle_done _ | Vehicle_failed _ | Timer_expired _) -> P.virtual_time && time > s.round_began
    | Some (Confirmed _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ as event) ->
      if P.virtual_time then time > s.round_began else not (is_immediate s event)

  let forget_rounds s =
    s.counted_since <- (time_of s, Clock.system.elapsed ());
    s.rounds <- 0;
    s.restless <- None;
    Hashtbl.reset s.starts

  (* Whether the rounds so far, if they are enough, follow each other without a wait. *)
  let is_restless s =
    let time, elapsed = s.counted_since and most = float_of_int most_rounds in
    P.virtual_time
    || (time_of s -. time <= most *. instant && Clock.system.elapsed () -. elapsed <= most *. moment)

  let count_start s v (p : Core.platform_task) =
    let n = 1 + Option.value (Hashtbl.find_opt s.starts v) ~default:0 in
    Hashtbl.replace s.starts v n;
    if n > most_rounds then if is_restless s then s.restless <- Some p.task_site else forget_rounds s

  (* The loops of a program, whatever they are made of: rounds of its tasks, and of its script if vehicles take part. *)
  let count_rounds s ~time ~cause (t : Transition.t) =
    if lets_wait ~time s cause then forget_rounds s;
    let task_of v = Vehicle_map.find_opt v t.next.shared.allocation in
    let start = match t.label with Start (v, _) -> Option.map (fun p -> (v, p)) (task_of v) | _ -> None in
    Option.iter (fun (v, p) -> count_start s v p) start;
    let begins = begins_round t in
    if begins then s.rounds <- s.rounds + 1;
    if s.rounds >= most_rounds && not (is_restless s) then forget_rounds s;
    if begins || start <> None then s.round_began <- time

  let count_steps s ~time ~cause (t : Transition.t) =
    let waited =
      match cause with
      | Some (Transition.Input _ | Interruption) -> true
      | Some event when not P.virtual_time -> not (is_immediate s event)
      | Some _ | None -> P.virtual_time && time > s.stepped
    in
    if waited then begin
      s.steps <- 0;
      s.silent_steps <- 0
    end;
    s.stepped <- time;
    match t.label with
    | Silent -> s.silent_steps <- s.silent_steps + 1
    | _ -> s.steps <- s.steps + 1

  let take s ~cause (t : Transition.t) =
    s.since_pause <- (match t.label with Silent -> most_without_pause | _ -> s.since_pause + 1);
    let is_news = match cause with Some (Transition.Recruited _) | None -> false | Some _ -> true in
    if is_news then s.alarms <- 0;
    let time = time_of s in
    count_rounds s ~time ~cause t;
    count_steps s ~time ~cause t;
    Log.transition ~time ~cause t;
    s.observer.transition ~time ~cause t;
    s.configuration <- t.next;
    let number = s.taken in
    s.taken <- number + 1;
    (match t.label with Interrupt -> withdraw s | _ -> ());
    (match cause with
     | Some (Confirmed (question, _)) -> Hashtbl.remove s.immediate question; withdraw_question s question
     | Some (Timer_expired timer) -> Hashtbl.remove s.immediate timer
     | Some _ | None -> ());
    carry_out_all s ~number t.effects

  let refuse_answer s why =
    s.console.refused why;
    match s.configuration.control with
    | Waiting (_, Ask prompt) -> ask s prompt
    | Waiting (_, (Pick _ | Pause _ | Execute _ | Host_call _)) | Script _ | Executing _ | Ended _ -> ()

  (* [deliver s e] is whether [e] changed the configuration. *)
  let deliver s (event : Transition.event) =
    look_at_clock s;
    (match event with
     | Vehicle_done v when Vehicle_map.mem v s.configuration.shared.allocation -> note_end s v
     | Vehicle_failed (v, _) -> note_stop s v
     | _ -> ());
    match Transition.accept s.program s.world s.configuration event with
    | Ok t -> take s ~cause:(Some event) t; true
    | Error Not_awaited ->
      Log.not_awaited ~time:(P.now s.platform) event;
      s.since_pause <- s.since_pause + 1;
      false
    | Error (Bad_answer why) -> refuse_answer s why; false

  let deliver_if_any s = function
    | Ok event -> deliver s event
    | Error Transition.Not_awaited -> false
    | Error (Bad_answer why) -> refuse_answer s why; false

  (* {1 Waiting} *)

  let next_of_platform s =
    match s.upcoming with
    | Some (_, promise) -> promise
    | None ->
      let news : Platform.event -> news = function
        | Vehicle state -> Seen state
        | Task_done v -> Event (Ok (Vehicle_done v))
        | Task_failed (v, why) -> Event (Ok (Vehicle_failed (v, why)))
        | Timer timer when timer = Residual.alarm -> Date_reached
        | Timer timer -> Event (Ok (Timer_expired timer))
        | Input (k, x) -> Event (Ok (Input (k, x)))
        | Quiet -> Nothing_more
      in
      let told = P.next s.platform in
      let promise = told >|= news in
      s.upcoming <- Some (told, promise);
      promise

  let next_of_inputs s =
    match s.posted with
    | Some promise -> promise
    | None ->
      let promise = Inputs.next s.inputs >|= fun item -> Posted item in
      s.posted <- Some promise;
      promise

  (* A reply of the host may hold a task, which has the place of the call: that call ends with its own program. *)
  let next_replacement s =
    let ask replacements =
      let promise = Lwt_mvar.take replacements >|= fun offer -> Offered offer in
      s.offered <- Some promise;
      promise
    in
    match s.configuration.control, s.offered with
    | Waiting (_, Host_call _), _ -> []
    | (Script _ | Waiting _ | Executing _ | Ended _), Some promise -> [ promise ]
    | (Script _ | Waiting _ | Executing _ | Ended _), None -> List.map ask (Option.to_list s.replacements)

  let next_interruption s = match s.interruptions with next :: _ -> [ next ] | [] -> []

  (* Pairs that the program neither declares nor asks for cannot be posted. *)
  let inputs_of s =
    if s.program.inputs = [] && not (Task_questions.were_put s.questions) then [] else [ next_of_inputs s ]

  let forget s promise =
    let unless p = if p == promise then None else Some p in
    s.upcoming <- Option.bind s.upcoming (fun (_, read as both) -> if read == promise then None else Some both);
    s.reply <- Option.bind s.reply unless;
    s.interruptions <- List.filter (fun p -> p != promise) s.interruptions;
    s.posted <- Option.bind s.posted unless;
    s.offered <- Option.bind s.offered unless;
    Task_questions.forget s.questions promise

  (* The next piece of news: of several that are there, an interruption before another program before a reply before
     inputs and the platform's, which take turns: posting cannot delay the vehicles' news. *)
  let next_news s =
    let answers = Option.to_list s.reply @ Option.to_list (Task_questions.shown s.questions) in
    let platform = if P.virtual_time && answers <> [] then [] else [ next_of_platform s ] in
    let inputs = inputs_of s in
    let others = if s.input_before then platform @ inputs else inputs @ platform in
    let sources = next_interruption s @ next_replacement s @ answers @ others in
    let rec first_of = function
      | promise :: _ when is_resolved promise -> forget s promise; promise
      | _ :: others -> first_of others
      | [] -> Lwt.choose sources >>= fun _ -> first_of sources
    in
    first_of sources

  (* The poster gets the result after the journal. *)
  let take_input s (item : Inputs.item) =
    let taken = deliver s (posted s item) in
    Inputs.tell item taken;
    taken

  (* For a program that reads sensors, telemetry is on throughout; other programs do not depend on it. So a run that
     is shown or recorded goes as any other. *)
  let switch_telemetry s ~sensitive =
    let how : Platform.telemetry =
      if s.program.reads_sensors then Awaited else if sensitive || s.always_telemetry then Shown else Off in
    if how <> s.telemetry then begin
      s.telemetry <- how;
      P.telemetry s.platform how
    end

  (* Sensors that a program reads keep their values between two events; its telemetry is the same in all its runs. *)
  let look s = if not s.program.reads_sensors then List.iter (see s) (P.look s.platform)

  (* Events go on during a long script: on a platform whose time passes by itself, news of vehicles that came
     meanwhile reach the program. *)
  let rec catch_up s =
    if not P.virtual_time then
      match s.configuration.control with
      | Waiting _ | Executing _ | Ended _ -> ()
      | Script _ -> (
          match List.find_opt is_resolved (inputs_of s @ [ next_of_platform s ]) with
          | None -> ()
          | Some promise -> (
              match Lwt.state promise with
              | Sleep | Fail _ -> ()
              | Return news ->
                forget s promise;
                (match news with
                 | Seen state -> see s state
                 | Posted item -> ignore (take_input s item)
                 | Event event -> ignore (deliver_if_any s event)
                 | Date_reached -> s.alarm <- None
                 | Asked_again | Unanswered _ | Offered _ | Nothing_more -> ());
                catch_up s))

  (* {1 The run} *)

  (* The values that guards wait for and vehicles of B have not reported. *)
  let tell_unknown s =
    let c = s.configuration in
    let has_not_told v = match World.find v s.world with Some { battery = None; _ } -> true | Some _ | None -> false in
    if List.exists has_not_told (c.shared.bound @ Configuration.recruits c) then begin
      let told fault = List.mem fault s.unknown in
      let news = List.filter (fun fault -> not (told fault)) (Transition.unknown s.program s.world c) in
      s.unknown <- news @ s.unknown;
      List.iter (s.observer.unknown ~time:(P.now s.platform)) news
    end

  (* {2 The date} *)

  (* In virtual time, the limit on wake-ups when the next relevant date cannot be computed. *)
  let most_alarms = 86_400

  (* When a guard that stands may come to hold because time passes. *)
  let next_date s =
    match s.configuration.control with
    | Executing _ when s.program.reads_now ->
      let is_enough = P.virtual_time && s.alarms >= most_alarms && not (Dated_code.is_exact s.dates) in
      if is_enough then None
      else Dated_code.next s.dates s.program s.world ~now:(World.whole s.moment) s.configuration.shared.store
    | Executing _ | Script _ | Waiting _ | Ended _ -> None

  let set_alarm s =
    if s.program.reads_now then begin
      let next = next_date s in
      if next <> s.alarm then begin
        s.alarm <- next;
        match next with
        | Some date -> P.set_timer s.platform Residual.alarm (float_of_int date -. P.now s.platform)
        | None -> P.cancel_timer s.platform Residual.alarm
      end
    end

  let interrupt s = ignore (deliver s Interruption)

  (* {2 Another program} *)

  let progress_of ~at program world (c : Configuration.t) =
    if not (Vehicle_progress.is_asked_for program) then None
    else Some (Vehicle_progress.resume ~at world c.shared.allocation)

  (* Tasks, timers, questions and calls that go on are those of the new configuration, so nothing is commanded. *)
  let replace s ({ program; configuration } : replacement) =
    s.program <- program;
    s.configuration <- configuration;
    s.dates <- Dated_code.of_program program;
    s.progress <- progress_of ~at:(P.now s.platform) program s.world configuration;
    s.unknown <- [];
    s.steps <- 0;
    forget_rounds s

  (* Goes on with [f s], after others had their turn if it is time. *)
  let continue s f =
    if s.since_pause < most_without_pause then f s
    else begin
      s.since_pause <- 0;
      Lwt.pause () >>= fun () ->
      catch_up s;
      f s
    end

  (* The transition that the configuration makes by itself, with the event that it takes. *)
  let next_transition s =
    match Transition.internal s.program s.world s.configuration () with
    | Seq.Cons (t, _) -> Some (None, t)
    | Seq.Nil ->
      let recruited (event, t) = (Some event, t) in
      Option.map recruited (Transition.recruited s.program s.world s.configuration)

  (* A step that was broken off is taken again, unless the interruption that broke it off has come. *)
  let rec advance s =
    look_at_clock s;
    match s.configuration.control with
    | Ended ending -> Lwt.return (Ended ending)
    | Script _ | Waiting _ | Executing _ when List.exists is_resolved (next_interruption s) ->
      List.iter (forget s) (next_interruption s);
      interrupt s;
      advance s
    | Executing (_, r) when s.rounds >= most_rounds ->
      give_up s (Spins (Option.value (first_repeat r) ~default:Fault.unknown_site))
    | Executing _ when s.restless <> None -> give_up s (Spins (Option.value s.restless ~default:Fault.unknown_site))
    | Script _ | Waiting _ | Executing _ when s.steps >= most_steps || s.silent_steps >= most_silent_steps ->
      give_up s (Spins (Configuration.site s.configuration))
    | Script _ | Waiting _ | Executing _ -> (
        look s;
        match Breakable.attempt s.breakable (fun () -> next_transition s) with
        | Some (Some (cause, t)) -> take s ~cause t; continue s advance
        | Some None -> pass s
        | None -> Lwt.pause () >>= fun () -> advance s)

  (* The program cannot go on; it executes what it declares by onInterrupt, which may fail in its own way. *)
  and give_up s outcome =
    s.giving_up (fun () -> interrupt s);
    forget_rounds s;
    advance s >|= function
    | Ended Interrupted -> outcome
    | (Ended (Completed | Halted _ | Failed _) | Stuck _ | Spins _) as ended -> ended

  (* No internal transition is left. A running task in A is the usual case, and quicker to see than all awaited
     events. *)
  and pass s =
    let c = s.configuration in
    let sensitive = Transition.depends_on_sensors s.program c in
    match c.control with
    | Executing (_, r)
      when (not sensitive) && s.program.inputs = [] && next_date s = None
           && Vehicle_map.is_empty c.shared.allocation
           && not (Transition.awaits_event c) ->
      give_up s (Stuck r)
    | Script _ | Waiting _ | Executing _ | Ended _ ->
      switch_telemetry s ~sensitive;
      if sensitive then tell_unknown s;
      wait ~sensitive s

  (* News that cannot enable a transition do not make the driver look for one. *)
  and wait ~sensitive s =
    show_question s;
    set_alarm s;
    next_news s >>= fun news ->
    s.input_before <- (match news with Posted _ -> true | _ -> false);
    match news with
    | Posted item -> continue s (if take_input s item then advance else wait ~sensitive)
    | Seen state -> see s state; continue s (if sensitive then advance else wait ~sensitive)
    | Event event -> continue s (if deliver_if_any s event then advance else wait ~sensitive)
    | Date_reached -> s.alarm <- None; s.alarms <- s.alarms + 1; continue s advance
    | Asked_again -> continue s (wait ~sensitive)
    | Unanswered question -> Task_questions.leave s.questions question; wait ~sensitive s
    | Offered offer -> (
        match offer () with
        | Some replacement -> replace s replacement; continue s advance
        | None -> continue s (wait ~sensitive))
    | Nothing_more -> (
        match s.configuration.control with
        | Executing (_, r) -> give_up s (Stuck r)
        | Script _ | Waiting _ | Ended _ -> advance s)

  (* The questions and calls that a console left open when it died are repeated. *)
  let begin_at s (b : beginning) =
    List.iter (see s) b.news;
    let is_delivered = Option.fold b.pending ~none:false ~some:(deliver s) in
    (if (not is_delivered) && s.reply = None then
       match b.configuration.control with
       | Waiting (_, Ask prompt) -> ask s prompt
       | Waiting (_, Host_call { subject; member; arguments }) -> call_host s subject member arguments
       | Waiting (_, (Pick _ | Pause _ | Execute _)) | Script _ | Executing _ | Ended _ -> ());
    let stands question = List.mem_assoc question (Task_questions.standing s.questions) in
    let put = function
      | question, Residual.Answer prompt when not (stands question) -> put_question s question prompt
      | _, (Residual.Answer _ | Time _) -> ()
    in
    List.iter put (Configuration.waits s.configuration)

  let finish s =
    Option.iter (fun (_, promise) -> Lwt.cancel promise) s.upcoming;
    Option.iter Lwt.cancel s.reply;
    Option.iter Lwt.cancel (Task_questions.shown s.questions);
    Option.iter Lwt.cancel s.posted;
    Option.iter Lwt.cancel s.offered;
    (match Option.map Lwt.state s.posted with
     | Some (Return (Posted item)) -> Inputs.tell item false
     | Some
         ( Return (Seen _ | Event _ | Date_reached | Asked_again | Unanswered _ | Offered _ | Nothing_more)
         | Sleep | Fail _ )
     | None -> ());
    Inputs.close s.inputs;
    P.close s.platform

  (* The end of a run that an exception broke: vehicles are stopped as by an interruption, as far as possible. *)
  let abort s =
    let attempt f = try f () with _ -> () in
    let rec stop c =
      match Transition.accept s.program s.world c Interruption with
      | Ok t -> attempt (fun () -> carry_out_all s ~number:s.taken t.effects); stop t.next
      | Error (Not_awaited | Bad_answer _) -> ()
    in
    attempt (fun () -> stop s.configuration);
    Lwt.catch (fun () -> finish s) (fun _ -> Lwt.return_unit)

  let run platform ~always_telemetry ~observer ~call ~inputs ~replacements ~console ~interruptions ~breakable
      ~giving_up ~(beginning : beginning) program =
    let interruption promise = Lwt.protected promise >|= fun () -> Event (Ok Interruption) in
    let s =
      { platform; program; console; call; observer; always_telemetry; inputs; replacements; offered = None;
        breakable; giving_up;
        interruptions = List.map interruption interruptions;
        configuration = beginning.configuration;
        taken = beginning.transitions;
        world = beginning.world;
        dates = Dated_code.of_program program; moment = beginning.time; alarm = None; alarms = 0;
        progress = progress_of ~at:beginning.time program beginning.world beginning.configuration;
        telemetry = Off; upcoming = None; reply = None; questions = Task_questions.create (); posted = None;
        input_before = false; unknown = []; since_pause = 0; rounds = 0;
        round_began = beginning.time; counted_since = (beginning.time, Clock.system.elapsed ());
        starts = Hashtbl.create 16; restless = None; steps = 0; silent_steps = 0; stepped = beginning.time;
        immediate = Hashtbl.create 16; at_once = false }
    in
    let whole () =
      switch_telemetry s ~sensitive:false;
      begin_at s beginning;
      advance s
    in
    Lwt.try_bind whole
      (fun outcome -> finish s >|= fun () -> outcome)
      (fun error -> abort s >>= fun () -> Lwt.fail error)
end

let run (type platform) (module P : Platform.S with type t = platform) (platform : platform)
    ?(always_telemetry = false) ?(observer = Observer.nobody) ?(host = no_host) ?inputs ?replacements ?beginning ?fenced
    ~console ~interruption ?again ?breakable ?(giving_up = fun interrupt -> interrupt ())
    (program : Core.program) =
  let inputs = match inputs with Some inputs -> inputs | None -> Inputs.create () in
  let interruptions = interruption :: Option.to_list again in
  let breakable = match breakable with Some breakable -> breakable | None -> Breakable.make () in
  let beginning = Option.value beginning ~default:(afresh program P.order) in
  if Fences.is_none program.fences then
    let module Driver = Make (P) in
    Driver.run platform ~always_telemetry ~observer ~call:host ~inputs ~replacements ~console ~interruptions
      ~breakable ~giving_up ~beginning program
  else
    let module Fenced = Fenced.Make (P) in
    let module Driver = Make (Fenced) in
    let past : Fence_guard.past = Option.value fenced ~default:(Fence_guard.replay program.fences []) in
    let platform = Fenced.make past.guard ~untold:past.untold platform in
    Driver.run platform ~always_telemetry ~observer ~call:host ~inputs ~replacements ~console ~interruptions
      ~breakable ~giving_up ~beginning program
