open Dolphin_app
open Dolphin_runtime
open Dolphin_json
open Lwt.Infix

type order = { program : Program_file.t; fleet : Fleet_file.t; settings : Run.settings }
type question = {
  number : int;
  prompt : string;
  place : Narrator.place_of_question;
  refused : string option;
  give : (string, string) result Lwt.u;
}

type operator = { name : string; role : string }
type state = Running | Stopping | Over of (Driver.outcome, Error.t) result

type t = {
  id : string;
  mutable order : order;
  journal : string option;
  enacts : string option;  (* the property that a counterexample breaks *)
  feed : Feed.t;
  narrator : Narrator.t;
  interruption : Interruption.t;
  changed : unit -> unit;
  finished : unit Lwt.t;
  finish : unit Lwt.u;
  opened : unit Lwt.t;  (* the view is valid *)
  open_ : unit Lwt.u;
  mutable view : Run.view;
  mutable last : float;  (* the time of the latest news *)
  mutable steps : int;  (* transitions, and changes of the program *)
  stepped : unit Lwt_condition.t;
  mutable question : question option;
  mutable questions : int;
  mutable refused : string option;
  mutable state : state;
  mutable stale : bool;  (* the message [waiting] is due *)
  expiries : (Dolphin_semantics.Residual.timer, float) Hashtbl.t;  (* the times of the timers that run *)
  mutable early : Dolphin_trace.Act.t list;  (* of operators, before the journal began; latest first *)
}

let id r = r.id
let feed r = r.feed
let journal r = r.journal
let program r = r.order.program
let goes_on r = match r.state with Running | Stopping -> true | Over _ -> false
let now r = if goes_on r then Float.max r.last (r.view.now ()) else r.last
let finished r = Lwt.protected r.finished
let steps r = r.steps

let rec after r n =
  if r.steps > n || not (goes_on r) then Lwt.return_unit
  else Lwt.pick [ Lwt_condition.wait r.stepped; finished r ] >>= fun () -> after r n

(* {1 Messages} *)

let tell_waiting r =
  r.stale <- false;
  Narrator.waiting r.narrator ~time:r.last

(* Once for all that happens at once. *)
let will_tell_waiting r =
  if not r.stale then begin
    r.stale <- true;
    Lwt.async (fun () -> Lwt.pause () >|= fun () -> tell_waiting r; r.changed ())
  end

let note_timers r ~time (t : Dolphin_semantics.Transition.t) =
  let note : Dolphin_semantics.Effect.t -> unit = function
    | Set_timer (timer, seconds) -> Hashtbl.replace r.expiries timer (time +. seconds)
    | Cancel_timer timer -> Hashtbl.remove r.expiries timer
    | Start _ | Stop _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
    | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ -> ()
  in
  List.iter note t.effects

let step r =
  r.steps <- r.steps + 1;
  Lwt_condition.broadcast r.stepped ()

let observer r : Observer.t =
  let transition ~time ~cause:_ t =
    r.last <- time;
    step r;
    note_timers r ~time t;
    let stuck = Interruption.is_unasked r.interruption in
    Narrator.transition r.narrator ~stuck ~time t;
    will_tell_waiting r;
    r.changed ()
  in
  let news ~time state =
    r.last <- Float.max r.last time;
    Narrator.news r.narrator ~time state;
    will_tell_waiting r;
    r.changed ()
  in
  let unknown ~time (fault : Dolphin_semantics.Fault.t) =
    Narrator.remark r.narrator ~time ("this condition does not hold: " ^ fault.message)
  in
  { transition; news; unknown }

let remark r text =
  Narrator.remark r.narrator ~time:(now r) text;
  r.changed ()

(* {1 Operators} *)

let keep r act = match r.view.acted act with Ok () -> () | Error why -> remark r why

(* An act takes effect also if the journal cannot be written: Stop must not fail. *)
let acted r by deed =
  let one { name; role } =
    let act = { Dolphin_trace.Act.operator = name; role; deed } in
    if Lwt.is_sleeping r.opened then r.early <- act :: r.early else keep r act;
    remark r (Dolphin_trace.Act.words act)
  in
  if goes_on r then Option.iter one by

let begun r view =
  r.view <- view;
  List.iter (keep r) (List.rev r.early);
  r.early <- [];
  Lwt.wakeup_later r.open_ ()

(* {1 The person} *)

let asked r prompt =
  Narrator.question r.narrator ~time:(now r) prompt;
  r.changed ()

let wait_for_answer r prompt =
  let answer, give = Lwt.task () in
  r.questions <- r.questions + 1;
  let place = Narrator.place_of_question r.narrator prompt in
  r.question <- Some { number = r.questions; prompt; place; refused = r.refused; give };
  r.refused <- None;
  r.changed ();
  let forget () =
    r.question <- None;
    r.changed ();
    Lwt.return_unit
  in
  Lwt.finalize (fun () -> answer) forget

let person r : Questions.person =
  { asked = asked r; answer = wait_for_answer r; answered = ignore;
    refused =
      (fun why ->
         r.refused <- Some why;
         remark r ("cannot take this answer: " ^ why)) }

let prompt_of r number =
  match r.question with Some q when q.number = number -> Some q.prompt | Some _ | None -> None

let open_prompts r = r.view.questions ()

let answer ?by r number text =
  match r.question with
  | Some q when q.number = number ->
    acted r by (Answer { question = q.prompt; text });
    r.question <- None; Lwt.wakeup_later q.give (Ok text); Ok ()
  | Some _ | None -> Error "this question is not open any more"

(* {1 The run} *)

let replaced r program replay =
  r.order <- { r.order with program };
  Narrator.replaced r.narrator program (Dolphin_trace.Replay.configuration replay);
  remark r ("the run goes on with " ^ program.path);
  step r;
  will_tell_waiting r

let front r : Run.front =
  { replayed =
      (fun entry replay ->
         r.last <- Dolphin_trace.Entry.time entry;
         Option.iter (fun (_, t) -> note_timers r ~time:r.last t) (Dolphin_trace.Replay.latest replay);
         Narrator.replayed r.narrator entry replay);
    notice = remark r;
    opened = begun r;
    remark = remark r; replaced = replaced r; observer = observer r; person = person r; wants_telemetry = true }

let follower r entry = Narrator.entry r.narrator entry

let settings r =
  { r.order.settings with recording = { journal = r.journal; drawing = None; follower = Some (follower r) } }

let over r outcome =
  tell_waiting r;
  (match outcome with Ok _ -> () | Error e -> List.iter (remark r) (Error.sentences e));
  r.last <- Float.max r.last (r.view.now ());
  r.state <- Over outcome;
  r.changed ();
  Lwt.wakeup_later r.finish ()

let begin_ ~id ~changed ?journal ?enacts order go =
  let feed = Feed.create ~run:id in
  let finished, finish = Lwt.wait () and opened, open_ = Lwt.wait () in
  let view : Run.view =
    { now = (fun () -> 0.); estimates = (fun () -> []); post = (fun _ _ -> Lwt.return_false);
      questions = (fun () -> []); replace = Replacement.refused; acted = (fun _ -> Ok ()) } in
  let r =
    { id; order; journal; enacts; feed;
      narrator = Narrator.make order.program (fun ~event data -> Feed.add feed ~event data);
      interruption = Interruption.make (); changed; finished; finish; opened; open_; view; last = 0.;
      steps = 0; stepped = Lwt_condition.create (); question = None;
      questions = 0; refused = None; state = Running; stale = false; early = []; expiries = Hashtbl.create 8 }
  in
  let whole () =
    Lwt.catch
      (fun () -> go r (front r) ~interruption:r.interruption)
      (fun error ->
         Lwt.return (Error (Error.Unavailable ("this is a fault of dolphin itself: " ^ Printexc.to_string error))))
    >|= over r
  in
  (* The request is answered before the run begins. *)
  Lwt.async (fun () -> Lwt.pause () >>= whole);
  r

let began by deed r =
  acted r by deed;
  r

let start ?by ~id ~changed ~journal order =
  began by Start @@ begin_ ~id ~changed ~journal order (fun r front ~interruption ->
      Run.start front ~interruption (settings r) order.program order.fleet)

let resume ?by ~id ~changed ~journal order =
  let fleet = order.fleet.path in
  began by Resume @@ begin_ ~id ~changed ~journal order (fun r front ~interruption ->
      let settings = settings r in
      let settings = { settings with recording = { settings.recording with journal = None } } in
      Run.resume front ~interruption settings ~changed:false ~fleet order.program journal)

let enact ~id ~changed ~speed program fleet witness =
  let order = { program; fleet; settings = { Run.simulated with speed } } in
  begin_ ~id ~changed ~enacts:witness.Dolphin_trace.Witness.property order (fun r front ~interruption ->
      Enacted_run.start front ~interruption ~speed ~follower:(follower r) program fleet witness)

type stopping = Next | Program | All

let stop ?by r stopping =
  let was_stopping = r.state = Stopping in
  if goes_on r && not (was_stopping && stopping = Program) then begin
    acted r by (Stop { all = was_stopping || stopping = All });
    r.state <- Stopping;
    Interruption.once_more r.interruption;
    if stopping = All && not was_stopping then Interruption.once_more r.interruption;
    r.changed ()
  end

(* A pair may answer the question of a task, by its prompt. *)
let deed_of_post r (key, x) : Dolphin_trace.Act.deed =
  match Dolphin_semantics.Answer.confirmation_of_value x with
  | Some yes when not (List.mem key r.order.program.program.inputs) ->
    Answer { question = key; text = (if yes then "yes" else "no") }
  | Some _ | None -> Post (Format.asprintf "%a" Dolphin_semantics.Value.pp_tuple (key, x))

let post ?by r pairs =
  let program = r.order.program.program in
  let why (key, x) =
    let declared = Typed_input.declared program ~questions:(r.view.questions ()) key in
    match Result.bind declared (fun () -> Typed_input.fits program key x) with Ok () -> None | Error why -> Some why
  in
  let refused = List.find_map why pairs in
  let rec each = function
    | [] -> Lwt.return (Ok (now r))
    | (key, x) :: rest -> (
        acted r by (deed_of_post r (key, x));
        r.view.post key x >>= function
        | true -> each rest
        | false when goes_on r -> Lwt.return (Error "this question is not open any more")
        | false -> Lwt.return (Error "the run has ended"))
  in
  match refused with
  | Some why -> Lwt.return (Error why)
  | None when not (goes_on r) -> Lwt.return (Error "the run has ended")
  | None -> Lwt.choose [ r.opened; finished r ] >>= fun () -> each pairs

let replace ?by r ~set ~hash path =
  Lwt.choose [ r.opened; finished r ] >>= fun () ->
  acted r by (Replace path);
  r.view.replace ~set ~hash path >|= fun result ->
  let refused why = remark r ("the run goes on with the program that it has: " ^ Replacement.message why) in
  Result.iter_error refused result;
  result

(* {1 In JSON} *)

let sentence outcome = Format.asprintf "%a" Driver.pp_outcome outcome

let of_outcome r outcome : Yojson.Safe.t =
  let { Program_file.path = file; source; _ } = r.order.program in
  let how, text, trouble =
    match outcome with
    | Error (Error.Interrupted why) -> ("interrupted", why, `List [])
    | Error e ->
      ("unavailable", String.concat "; " (Error.sentences e), Documents.of_error ~file ~source e)
    | Ok (outcome : Driver.outcome) ->
      let how =
        match outcome with
        | Ended Completed -> "completed"
        | Ended (Halted _) -> "halted"
        | Ended (Failed _) -> "failed"
        | Ended Interrupted -> "interrupted"
        | Stuck _ | Spins _ -> "stuck"
      in
      let trouble = match Run.explain r.order.program outcome with
        | Some e -> Documents.of_error ~file ~source e | None -> `List [] in
      (how, sentence outcome, trouble)
  in
  `Assoc [ ("how", `String how); ("text", `String text); ("diagnostics", trouble) ]

(* Rounded, so that the state changes only now and then. *)
let progress (e : Networks.estimate) : Yojson.Safe.t =
  let rounded x step = Float.round (x /. step) *. step in
  `Assoc [ ("vehicle", `String e.vehicle); ("plan", `String e.plan);
           ("share", Canonical.number (Float.round (e.share *. 100.) /. 100.));
           ("remaining", Field.of_option (fun x -> Canonical.number (rounded x 10.)) e.remaining) ]

let to_json ~addressee r : Yojson.Safe.t =
  let to_ prompt = ("to", Field.of_option (fun name -> `String name) (addressee prompt)) in
  let question q : Yojson.Safe.t =
    `Assoc [ ("number", `Int q.number); ("prompt", `String q.prompt);
             ("kind", `String (if q.place.is_confirm then "truth" else "value"));
             ("at", Field.of_option (fun at -> `String at) q.place.at);
             ("refused", Field.of_option (fun why -> `String why) q.refused); to_ q.prompt ]
  in
  let until timers =
    let times = List.filter_map (Hashtbl.find_opt r.expiries) timers in
    List.fold_left (fun least time -> Some (Option.fold least ~none:time ~some:(Float.min time))) None times
  in
  let open_question ((q : Dolphin_display.Open_question.t), at) : Yojson.Safe.t =
    `Assoc [ ("prompt", `String q.prompt); ("of", `String (if q.is_of_task then "task" else "script"));
             ("at", Field.of_option (fun at -> `String at) at);
             ("until", Field.of_option Canonical.number (until q.timers)); to_ q.prompt ]
  in
  let state, outcome =
    match r.state with
    | Running -> ("running", `Null)
    | Stopping -> ("stopping", `Null)
    | Over outcome -> ("over", of_outcome r outcome)
  in
  `Assoc
    [ ("id", `String r.id); ("state", `String state); ("time", Canonical.number (now r));
      ("speed", Field.of_option Canonical.number r.order.settings.speed);
      ("simulated", `Bool (Run.is_simulated r.order.settings));
      ("counterexample", Field.of_option (fun property -> `String property) r.enacts);
      ("inputs", Field.texts (if r.enacts = None then r.order.program.program.inputs else []));
      ("vehicle_inputs", Field.texts (if r.enacts = None then r.order.program.program.vehicle_inputs else []));
      ("question", Field.of_option question r.question);
      ("questions", `List (List.map open_question (if goes_on r then Narrator.open_questions r.narrator else [])));
      ("progress", `List (if goes_on r then List.map progress (r.view.estimates ()) else []));
      ("outcome", outcome) ]
