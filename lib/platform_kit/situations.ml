open Dolphin_platform_protocol
open Lwt.Infix
module Order = Dolphin_platform_protocol.Order

type plans = { short : string; long : string; vehicle : string option; patience : float }

type t = {
  name : string;
  what : string;
  script : plans -> started:(Talk.t -> unit) -> string -> string option Lwt.t;
}

let wrong fmt = Printf.ksprintf (fun why -> Lwt.fail (Talk.Wrong why)) fmt
let fine = Lwt.return_none

(* {1 Words} *)

let counter = ref 0

(* Requests of this process, unlike those of any other. *)
let request () =
  incr counter;
  Printf.sprintf "kit-%d-%.0f-%d" (Unix.getpid ()) (Unix.gettimeofday () *. 1000.) !counter

let by_name name : Yojson.Safe.t = `Assoc [ ("name", `String name) ]

let foreign : Yojson.Safe.t =
  `Assoc [ ("name", `String "nonsense"); ("language", `String "no-such-language"); ("body", `Assoc []) ]

let start_order ?(timeout = 60.) request vehicle plan : Order.t = Start { request; vehicle; plan; timeout }
let stop_order request vehicle : Order.t = Stop { request; vehicle }

let resume_order ?(notes = []) ?doubt request vehicle plan : Order.t =
  Resume { request; vehicle; plan = by_name plan; timeout = 60.; notes; doubt }

(* The notes of the adapter of [t] on a request, latest first. *)
let notes_of t r =
  let add notes : Report.t -> Yojson.Safe.t list = function
    | Note { request; note; _ } when String.equal request r -> note :: notes
    | _ -> notes
  in
  List.fold_left add [] (Talk.reports t)

let of_word : Report.word -> string = function
  | Taken -> "taken" | Progress _ -> "progress" | Done -> "done" | Failed why -> "failed (" ^ why ^ ")"
  | Stopped -> "stopped" | Unknown why -> "unknown (" ^ why ^ ")" | Absent -> "absent"

let words t request =
  let of_it : Report.t -> Report.word option = function
    | Request (_, Progress _) -> None
    | Request (other, word) when other = request -> Some word
    | _ -> None
  in
  List.filter_map of_it (Talk.reports t)

let ends t request = List.filter Report.is_end (words t request)

(* The next report on a request that is not an estimate. *)
let word t plans request =
  Talk.await t ~within:plans.patience ~what:("an answer about " ^ request) (function
      | Request (_, Progress _) -> None
      | Request (other, word) when other = request -> Some word
      | _ -> None)

let end_of t plans request =
  Talk.await t ~within:plans.patience ~what:("the end of " ^ request) (function
      | Request (other, word) when other = request && Report.is_end word -> Some word
      | _ -> None)

let taken t plans request =
  word t plans request >>= function
  | Taken -> Lwt.return_unit
  | other -> wrong "%s was to be 'taken', and is '%s'" request (of_word other)

(* {1 Adapters} *)

let hello ~resumes : Order.t =
  Hello { version = Report.version; dolphin = "kit"; purpose = Run; program = Some "kit"; resumes }

let greeted ?(resumes = false) ~started command =
  let t = Talk.start command in
  started t;
  Talk.send t (hello ~resumes);
  Talk.first_line t ~within:10. >>= function
  | Ok (Hello greeting) when greeting.version = Report.version -> Lwt.return (t, greeting)
  | Ok (Hello greeting) -> wrong "it speaks version %d of the protocol" greeting.version
  | Ok (Trouble why) -> wrong "it reports that it cannot go on: %s" why
  | Ok _ -> wrong "its first line is not a greeting"
  | Error why -> wrong "its first line %s" why

(* The known state of vehicles, from all reports so far. *)
let vehicles t =
  let known = Hashtbl.create 16 in
  let add : Report.t -> unit = function
    | Vehicle s ->
      let link, unready, placed =
        Option.value (Hashtbl.find_opt known s.vehicle) ~default:(false, None, false) in
      Hashtbl.replace known s.vehicle
        (Option.value s.link ~default:link, Option.value s.unready ~default:unready, placed || s.place <> None)
    | Gone v -> Hashtbl.remove known v
    | _ -> ()
  in
  List.iter add (Talk.reports t);
  let ready v = function true, None, true -> Some v | _ -> None in
  List.sort compare (List.filter_map Fun.id (List.of_seq (Seq.map (fun (v, x) -> ready v x) (Hashtbl.to_seq known))))

let rec ready t plans ~within =
  let is_wanted v = match plans.vehicle with None -> true | Some wanted -> v = wanted in
  match List.filter is_wanted (vehicles t) with
  | v :: _ -> Lwt.return v
  | [] when within <= 0. ->
    wrong "no vehicle%s is reported that has a link, is ready and has a position"
      (Option.fold plans.vehicle ~none:"" ~some:(fun v -> " " ^ v))
  | [] -> Lwt_unix.sleep 0.1 >>= fun () -> ready t plans ~within:(within -. 0.1)

let with_vehicle ?resumes plans ~started command =
  greeted ?resumes ~started command >>= fun (t, greeting) ->
  ready t plans ~within:(Float.max plans.patience greeting.announce) >|= fun v -> (t, v)

(* The vehicle is free again. *)
let stopped t plans v request =
  Talk.send t (stop_order request v);
  end_of t plans request

let rest seconds = Lwt_unix.sleep seconds

(* {1 The situations} *)

let greeting _ ~started command =
  greeted ~started command >>= fun (_, greeting) ->
  Lwt.return_some
    (Printf.sprintf "it is %s%s, and takes %s" greeting.name
       (Option.fold greeting.adapter ~none:"" ~some:(( ^ ) " "))
       (String.concat ", " greeting.plans))

let sightings plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let first =
    List.find_map (function Report.Vehicle s when s.vehicle = v -> Some s | _ -> None) (Talk.reports t) in
  match first with
  | Some { kind = Some _; link = Some _; _ } -> Lwt.return_some (Printf.sprintf "%s is ready" v)
  | Some _ | None -> wrong "the first report of %s lacks its type or its link" v

let strange_orders plans ~started command =
  with_vehicle plans ~started command >>= fun (t, _) ->
  Talk.send_text t {|{"kind": "dance", "partner": "x8-02"}|};
  Talk.send_text t {|{"later": {"version": 2}, "kind": "ping", "id": 7}|};
  Talk.await t ~within:5. ~what:"the pong" (function Pong 7 -> Some () | _ -> None) >>= fun () -> fine

(* The reports of the adapter on [v] after an order to repeat all. *)
let refused_line plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let before = List.length (Talk.reports t) in
  Talk.send t (Refused "is not a valid 'vehicle': of latitude and longitude one is missing");
  let add (known : Report.sight) : Report.t -> Report.sight = function
    | Vehicle s when String.equal s.vehicle v ->
      let now x before = if x = None then before else x in
      { known with kind = now s.kind known.kind; place = now s.place known.place; link = now s.link known.link }
    | _ -> known
  in
  let rec again ~within =
    let later = List.filteri (fun i _ -> i >= before) (Talk.reports t) in
    match List.fold_left add (Report.nothing v) later with
    | { kind = Some _; place = Some _; link = Some _; _ } -> fine
    | _ when within <= 0. ->
      wrong "a line was refused, and %s is not reported again with type, position and link within %g s" v plans.patience
    | _ -> Lwt_unix.sleep 0.1 >>= fun () -> again ~within:(within -. 0.1)
  in
  again ~within:plans.patience

let pings plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () in
  Talk.send t (start_order r v (by_name plans.long));
  let rec each id =
    if id > 20 then Lwt.return_unit
    else begin
      Talk.send t (Ping id);
      Talk.await t ~within:5. ~what:(Printf.sprintf "pong %d" id) (function
          | Pong other when other = id -> Some ()
          | _ -> None)
      >>= fun () -> each (id + 1)
    end
  in
  each 1 >>= fun () -> stopped t plans v r >>= fun _ -> fine

let expect_one_end t r =
  match ends t r with
  | [ _ ] -> Lwt.return_unit
  | several -> wrong "%s has %d ends: %s" r (List.length several) (String.concat ", " (List.map of_word several))

let runs_to_its_end t plans v plan =
  let r = request () in
  Talk.send t (start_order r v (by_name plan));
  end_of t plans r >>= function
  | Done -> Lwt.return r
  | other -> wrong "plan %s was to be 'done', and is '%s'" plan (of_word other)

let completion plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  runs_to_its_end t plans v plans.short >>= fun r ->
  rest 0.5 >>= fun () ->
  expect_one_end t r >>= fun () -> fine

let one_after_the_other plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  runs_to_its_end t plans v plans.short >>= fun first ->
  runs_to_its_end t plans v plans.short >>= fun second ->
  expect_one_end t first >>= fun () ->
  expect_one_end t second >>= fun () -> fine

let start_twice plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () in
  let order = start_order r v (by_name plans.long) in
  Talk.send t order;
  taken t plans r >>= fun () ->
  Talk.send t order;
  taken t plans r >>= fun () ->
  stopped t plans v r >>= fun _ ->
  expect_one_end t r >>= fun () ->
  (* Once it has ended, it is not run again. *)
  Talk.send t order;
  word t plans r >>= function
  | word when Report.is_end word -> fine
  | other -> wrong "a start that comes again after its end is answered by '%s', not by that end" (of_word other)

let stop plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () in
  Talk.send t (start_order r v (by_name plans.long));
  taken t plans r >>= fun () ->
  stopped t plans v r >>= function
  | Stopped -> (
      rest 0.5 >>= fun () ->
      expect_one_end t r >>= fun () ->
      Talk.send t (stop_order r v);
      word t plans r >>= function
      | Stopped -> fine
      | other -> wrong "a second stop is answered by '%s', and the first one was by 'stopped'" (of_word other))
  | other -> wrong "a stop is answered by '%s'" (of_word other)

let stop_of_a_stranger plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () in
  stopped t plans v r >>= function
  | Stopped -> fine
  | other -> wrong "a stop of a request that was never ordered is answered by '%s', not by 'stopped'" (of_word other)

let stop_at_once plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () in
  Talk.send t (start_order r v (by_name plans.long));
  Talk.send t (stop_order r v);
  end_of t plans r >>= function
  | Done -> wrong "plan %s was stopped at once, and is 'done'" plans.long
  | Absent -> wrong "'absent' only answers a 'resume'"
  | Failed _ | Stopped | Taken | Progress _ | Unknown _ ->
    rest 0.5 >>= fun () ->
    expect_one_end t r >>= fun () ->
    runs_to_its_end t plans v plans.short >>= fun _ -> fine

let expect_refusal t plans r what =
  word t plans r >>= function
  | Failed why when String.trim why <> "" -> Lwt.return_unit
  | other -> wrong "%s was to be refused, as 'failed', and is '%s'" what (of_word other)

let refusal plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () and s = request () in
  Talk.send t (start_order r v foreign);
  expect_refusal t plans r "a plan in an unknown language" >>= fun () ->
  Talk.send t (start_order s "no-such-vehicle" (by_name plans.short));
  expect_refusal t plans s "a plan for a vehicle that is not there" >>= fun () ->
  runs_to_its_end t plans v plans.short >>= fun _ -> fine

let validation plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let check id plan =
    Talk.send t (Check { id; vehicle = Some v; plan });
    Talk.await t ~within:plans.patience ~what:(Printf.sprintf "'checked' %d" id) (function
        | Checked { id = other; problems } when other = id -> Some problems
        | _ -> None)
  in
  check 1 foreign >>= function
  | [] -> wrong "a plan in an unknown language is found to have no problems"
  | _ :: _ -> (
      check 2 (by_name plans.short) >>= function
      | [] -> fine
      | problem :: _ -> wrong "plan %s, which it runs, is found to have a problem: %s" plans.short problem)

let slow_reader plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () in
  Talk.pause_reading t true;
  let last = 5000 in
  for id = 1 to last do Talk.send t (Ping id) done;
  Talk.send t (start_order r v (by_name plans.short));
  rest 3. >>= fun () ->
  Talk.pause_reading t false;
  end_of t plans r >>= fun _ ->
  let pongs = List.filter_map (function Report.Pong id -> Some id | _ -> None) (Talk.reports t) in
  if pongs <> List.init last succ then
    wrong "of %d pings sent while its output was not read, %d were answered, or not in order" last (List.length pongs)
  else rest 0.3 >>= fun () -> expect_one_end t r >>= fun () -> fine

let most_at_once = 100

let all_at_once plans ~started command =
  with_vehicle plans ~started command >>= fun (t, _) ->
  rest 1. >>= fun () ->
  let chosen =
    match plans.vehicle with
    | Some v -> [ v ]
    | None -> List.filteri (fun i _ -> i < most_at_once) (vehicles t)
  in
  let requests = List.map (fun v -> (v, request ())) chosen in
  List.iter (fun (v, r) -> Talk.send t (start_order r v (by_name plans.short))) requests;
  let finished (v, r) =
    end_of t plans r >>= function
    | Done -> Lwt.return_unit
    | other -> wrong "%s was to run plan %s, and reports '%s'" v plans.short (of_word other)
  in
  Lwt_list.iter_s finished requests >>= fun () ->
  rest 0.3 >>= fun () ->
  Lwt_list.iter_s (fun (_, r) -> expect_one_end t r) requests >>= fun () ->
  Lwt.return_some (Printf.sprintf "%d at once" (List.length requests))

(* {2 Deaths} *)

let again plans ~started command = with_vehicle ~resumes:true plans ~started command

(* The adapter dies, as [die] has it, while a vehicle runs the long plan; the next one's report on it. *)
let died_while_running plans ~started command die =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () in
  Talk.send t (start_order r v (by_name plans.long));
  taken t plans r >>= fun () ->
  die t >>= fun () ->
  let resume = resume_order ~notes:(notes_of t r) r v plans.long in
  again { plans with vehicle = Some v } ~started command >>= fun (t, _) ->
  Talk.send t resume;
  word t plans r >>= fun said -> Lwt.return (t, v, r, said)

let killed_while_running plans ~started command =
  died_while_running plans ~started command Talk.kill >>= fun (t, v, r, said) ->
  match said with
  | Absent -> wrong "after its death the adapter reports a plan that the vehicle had taken as never started"
  | Done -> wrong "after its death the adapter reports plan %s as done" plans.long
  | Taken | Unknown _ | Failed _ | Stopped | Progress _ ->
    stopped t plans v r >>= fun _ ->
    runs_to_its_end t plans v plans.short >>= fun _ -> Lwt.return_some (Printf.sprintf "it reports '%s'" (of_word said))

let resume_twice plans ~started command =
  died_while_running plans ~started command Talk.kill >>= fun (t, v, r, said) ->
  Talk.send t (resume_order r v plans.long);
  word t plans r >>= fun second ->
  (* The last report may be an end that came between the two. *)
  let has_ended_since =
    match said, second with
    | (Taken | Unknown _), Failed _ | Unknown _, Stopped -> true
    | _, _ -> false
  in
  if second <> said && not has_ended_since then
    wrong "a second 'resume' is answered by '%s', and the first one was by '%s'" (of_word second) (of_word said)
  else if Report.is_end second then fine
  else stopped t plans v r >>= fun _ -> fine

let killed_after_its_end plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  runs_to_its_end t plans v plans.short >>= fun r ->
  Talk.kill t >>= fun () ->
  let resume = resume_order ~notes:(notes_of t r) r v plans.short in
  again { plans with vehicle = Some v } ~started command >>= fun (t, _) ->
  Talk.send t resume;
  word t plans r >>= function
  | (Done | Unknown _) as said -> Lwt.return_some (Printf.sprintf "it reports '%s'" (of_word said))
  | other -> wrong "a plan that was done before the adapter died is '%s' after it" (of_word other)

(* An absent request is ordered with the same name. *)
let is_ordered_after_all t plans v r =
  Talk.send t (start_order r v (by_name plans.short));
  end_of t plans r >>= function
  | Done -> Lwt.return_unit
  | other -> wrong "an absent request was ordered, and is '%s'" (of_word other)

let never_ordered plans ~started command =
  again plans ~started command >>= fun (t, v) ->
  let r = request () in
  Talk.send t (resume_order r v plans.short);
  word t plans r >>= function
  | (Absent | Unknown _) as said ->
    rest 0.5 >>= fun () ->
    (match List.filter (( <> ) said) (words t r) with
     | [] ->
       (if said = Absent then is_ordered_after_all t plans v r else Lwt.return_unit) >>= fun () ->
       Lwt.return_some (Printf.sprintf "it reports '%s'" (of_word said))
     | other :: _ -> wrong "a request that was never ordered is '%s', and then '%s'" (of_word said) (of_word other))
  | other -> wrong "a request that was never ordered is '%s'" (of_word other)

(* The journal has lost its end, and with it the notes on a request that was ordered. *)
let lost_notes plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let plans = { plans with vehicle = Some v } in
  runs_to_its_end t plans v plans.short >>= fun over ->
  Talk.kill t >>= fun () ->
  let ask r plan =
    again plans ~started command >>= fun (t, _) ->
    Talk.send t (resume_order ~doubt:Order.Lost_order r v plan);
    word t plans r >>= function
    | Absent -> wrong "plan %s ran, the journal has lost the notes on it, and it is 'absent'" plan
    | said when Report.is_end said -> Lwt.return (t, said)
    | said -> stopped t plans v r >>= fun _ -> Lwt.return (t, said)
  in
  ask over plans.short >>= fun (t, after) ->
  let r = request () in
  Talk.send t (start_order r v (by_name plans.long));
  taken t plans r >>= fun () ->
  Talk.kill t >>= fun () ->
  ask r plans.long >>= fun (_, during) ->
  Lwt.return_some (Printf.sprintf "it reports '%s' and '%s'" (of_word after) (of_word during))

let console_dies plans ~started command =
  let die t =
    Talk.close_input t >>= fun () ->
    Talk.ends_within t 3. >>= fun ended ->
    if ended then Lwt.return_unit else wrong "its input has ended, and it has not, after 3 s"
  in
  died_while_running plans ~started command die >>= fun (t, v, r, said) ->
  match said with
  | Taken | Unknown _ ->
    stopped t plans v r >>= fun _ -> Lwt.return_some (Printf.sprintf "it reports '%s'" (of_word said))
  | Absent | Done | Failed _ | Stopped | Progress _ ->
    wrong "the console died, and a plan that ran is '%s': vehicles are to fly on" (of_word said)

let close plans ~started command =
  with_vehicle plans ~started command >>= fun (t, v) ->
  let r = request () in
  Talk.send t (start_order r v (by_name plans.long));
  taken t plans r >>= fun () ->
  Talk.send t Close;
  Talk.await t ~within:6. ~what:"'quiet'" (function Quiet -> Some () | _ -> None) >>= fun () ->
  Talk.ends_within t 1.5 >>= fun ended ->
  if not ended then wrong "it has sent 'quiet', and has not ended after 1.5 s"
  else
    let resume = resume_order ~notes:(notes_of t r) r v plans.long in
    again { plans with vehicle = Some v } ~started command >>= fun (t, _) ->
    Talk.send t resume;
    word t plans r >>= function
    | Taken -> wrong "it was closed, and the vehicle runs on"
    | Done | Absent | Progress _ as said -> wrong "it was closed, and a plan that ran is '%s'" (of_word said)
    | Stopped | Failed _ | Unknown _ -> fine

let all =
  let situation name what script = { name; what; script } in
  [ situation "greeting" "greets within 10 s, before all else" greeting;
    situation "vehicles" "reports a vehicle that is ready, at first with type and link" sightings;
    situation "strange-orders" "ignores orders and members that it does not know" strange_orders;
    situation "refused-line" "reports its vehicles again, with all members, when a line is refused" refused_line;
    situation "completion" "runs a plan to its end, and reports one end" completion;
    situation "next" "runs the next plan at once" one_after_the_other;
    situation "pings" "answers pings while a vehicle runs a plan" pings;
    situation "start-twice" "takes a start that comes twice for one" start_twice;
    situation "stop" "stops a plan, and reports one end, the same again when asked again" stop;
    situation "stop-stranger" "answers the stop of a request that it never heard of" stop_of_a_stranger;
    situation "stop-at-once" "stops a plan before reporting it as taken, and is free then" stop_at_once;
    situation "refusal" "refuses what it cannot do, in words, and is free then" refusal;
    situation "validation" "reports the problems of a plan, and moves nothing" validation;
    situation "slow-reader" "loses nothing while its output is not read" slow_reader;
    situation "all-at-once" "commands all of its vehicles at once, up to 100" all_at_once;
    situation "killed" "after its death reports the outcome of a plan that ran" killed_while_running;
    situation "killed-after-end" "after its death does not rerun an ended plan" killed_after_its_end;
    situation "resume-twice" "answers a second 'resume' as the first" resume_twice;
    situation "never-ordered" "does not claim a request that was never ordered" never_ordered;
    situation "lost-notes" "does not rerun a plan on which the journal has lost its notes" lost_notes;
    situation "console-dies" "lets vehicles fly on when its input ends, and ends" console_dies;
    situation "close" "stops all vehicles, reports 'quiet', and ends" close ]
