open Dolphin_imc
open Dolphin_platform_imc
module State = Message.Plan_control_state

let order : Execution.order = { plan = "p"; specification = None }

let says state ?(outcome = State.Last_outcome.None) plan_id =
  { State.default with state; plan_id; last_outcome = outcome }

let ready = says Ready and executing = says Executing

(* A vehicle that says [first] and later [rest], half a second apart, to a console that has nothing yet but notes. *)
let outputs ?(stopped = false) ?(doubt = Execution.Never_sent) notes first rest =
  let time = ref 0. and clock = ref Vehicle_clock.unknown in
  let x = ref (Execution.create ~request:500 ()) in
  let input i =
    let y, outputs = Execution.step ~now:!time ~clock:!clock i !x in
    x := y;
    outputs
  in
  let hear state =
    time := !time +. 0.5;
    let known, sent = Vehicle_clock.observe ~now:!time ~sent:(1000. +. !time) !clock in
    clock := known;
    input (Execution.State { sent; state })
  in
  let heard = hear first in
  let adopted = input (Adopt { order; stopped; notes = List.rev notes; doubt }) in
  let later = List.concat_map hear rest in
  time := !time +. 5.;
  heard @ adopted @ later @ input Tick

let show : Execution.output -> string = function
  | Keep (Asked { plan; _ }) -> "keep asked " ^ plan
  | Keep (Taken _) -> "keep taken"
  | Keep (Runs _) -> "keep runs"
  | Keep (Over _) -> "keep over"
  | Keep (May_run { plan; _ }) -> "keep may run " ^ plan
  | Send (Plan_control { op = Start; plan_id; _ }) -> "start " ^ plan_id
  | Send (Plan_control { op = Stop; plan_id; _ }) -> "stop " ^ plan_id
  | Send _ -> "something else"
  | Done -> "done"
  | Failed why -> "failed: " ^ why
  | Remark text -> "note: " ^ text

let case name ?stopped ?doubt notes first rest expected =
  Alcotest.test_case name `Quick (fun () ->
      let found = List.map show (outputs ?stopped ?doubt notes first rest) in
      Alcotest.(check (list string)) name expected found)

let asked ?before () : Durable_note.t = Asked { plan = "p"; request = 7; before }
let taken : Durable_note.t = Taken { request = 7 }
let runs : Durable_note.t = Runs { request = 7 }
let over : Durable_note.t = Over { request = 7 }
let another = ("q", false)

let nobody_knows =
  "failed: the console died just as it asked for plan p, which the vehicle had run before: it is unknown whether it has \
   run again"

let unnoted =
  "failed: the vehicle runs a plan p already, and the journal has no request for it: it is not known whether that is \
   this run's"

let unnoted_end =
  "failed: the last plan of the vehicle has the name p, and the journal has no request for it: it is not known whether \
   it has run for this run"

(* The states of a vehicle with which nothing happens. *)
let still state = [ state; state; state; state ]

let cases =
  [ case "never asked for: it is started" [] (ready "q") [] [ "keep asked p"; "start p" ];
    case "never asked for, and running all the same" [] (executing "p") [ executing "p"; ready ~outcome:Failure "p" ]
      [ "keep asked p"; "keep may run p"; unnoted; "stop p"; "keep over" ];
    case "never asked for, and the vehicle runs another's plan" [] (executing "r") [] [ "keep asked p"; "start p" ];
    case "never asked for, and not wanted any more" ~stopped:true [] (ready "q") [] [];
    case "no note of it, and it has run" ~doubt:Lost_note [] (ready ~outcome:Success "p") [] [ unnoted_end ];
    case "no note of it, and it has run without success" ~doubt:Lost_note [] (ready ~outcome:Failure "p") []
      [ unnoted_end ];
    case "no note of it, and it has run before, too" ~doubt:Lost_note_of_repetition [] (ready ~outcome:Success "p") []
      [ "keep asked p"; "start p" ];
    case "no note of it, and it runs again" ~doubt:Lost_note_of_repetition [] (executing "p")
      [ executing "p"; ready ~outcome:Failure "p" ]
      [ "keep asked p"; "keep may run p"; unnoted; "stop p"; "keep over" ];
    case "no note of it, and another plan has run" ~doubt:Lost_note [] (ready ~outcome:Success "q") []
      [ "keep asked p"; "start p" ];
    case "no note of it, and something is being started" ~doubt:Lost_note [] (says Initializing "q")
      [ executing "p"; ready ~outcome:Failure "p" ]
      [ "keep asked p"; "keep may run p"; unnoted; "stop p"; "keep over" ];
    case "no note of it, not wanted any more, and it runs" ~doubt:Lost_note ~stopped:true [] (executing "p")
      [ executing "p"; ready ~outcome:Failure "p" ]
      [ "keep asked p"; "stop p"; "keep over" ];
    case "it runs" [ asked ~before:another (); taken; runs ] (executing "p") (still (executing "p")) [ "keep runs" ];
    case "it runs, which nobody had seen" [ asked ~before:another () ] (executing "p") [] [ "keep runs" ];
    case "it ends later" [ asked ~before:another (); taken; runs ] (executing "p")
      [ executing "p"; ready ~outcome:Success "p" ]
      [ "keep runs"; "done" ];
    case "it ended meanwhile" [ asked ~before:another (); taken; runs ] (ready ~outcome:Success "p") [] [ "done" ];
    case "it ended before anybody saw it run" [ asked ~before:another () ] (ready ~outcome:Success "p") [] [ "done" ];
    case "it ended on a vehicle that had run nothing" [ asked ~before:("", false) () ] (ready ~outcome:Success "p") []
      [ "done" ];
    case "it failed meanwhile" [ asked ~before:another (); taken; runs ] (ready ~outcome:Failure "p") []
      [ "keep runs"; "failed: the plan ended without success, and the vehicle gave no reason" ];
    case "another console has replaced it" [ asked ~before:another (); taken; runs ] (executing "r") []
      [ "failed: replaced by plan r" ];
    case "it did not arrive: it is sent again, after a look" [ asked ~before:another () ] (ready "q")
      [ ready "q"; ready "q" ]
      [ "start p" ];
    case "the same plan ran before, and runs now" [ asked ~before:("p", false) () ] (executing "p") [] [ "keep runs" ];
    case "the same plan ran before, and was taken" [ asked ~before:("p", false) (); taken ]
      (ready ~outcome:Success "p") [] [ "done" ];
    case "the same plan ran before, and nobody knows more" [ asked ~before:("p", false) () ]
      (ready ~outcome:Success "p")
      (still (ready ~outcome:Success "p"))
      [ nobody_knows ];
    case "to be stopped, and still running" ~stopped:true [ asked ~before:another (); taken; runs ] (executing "p")
      [ ready ~outcome:Failure "p" ]
      [ "stop p"; "keep over" ];
    case "to be stopped, and not running" ~stopped:true [ asked ~before:another (); taken; runs ]
      (ready ~outcome:Failure "p") [] [ "keep over" ];
    case "to be stopped, and the vehicle runs another's plan" ~stopped:true [ asked ~before:another (); runs ]
      (executing "r") [] [ "keep over" ];
    case "it was stopped: the same plan of another console goes on" ~stopped:true [ asked ~before:another (); over ]
      (executing "p") (still (executing "p")) [] ]

let tests = ("adoption", cases)
