open Dolphin_semantics
open Dolphin_trace
open Dolphin_display
module Program_file = Dolphin_app.Program_file
module Canonical = Dolphin_json.Canonical

type tell = event:string -> string -> unit

type t = {
  mutable program : Program_file.t;
  tell_ : tell;
  mutable log : Log.t;
  mutable world : World.t;
  mutable configuration : Configuration.t;
  mutable places : Yojson.Safe.t;  (* of the latest message *)
  mutable told : Waiting.t list;  (* of the latest message [waiting] *)
}

let make (program : Program_file.t) tell_ =
  { program; tell_; log = Log.start; world = World.empty; configuration = Configuration.initial program.program;
    places = `List []; told = [] }

let tell_json (tell : tell) event json = tell ~event (Canonical.to_string json)
let tell n = tell_json n.tell_
let entry n entry = n.tell_ ~event:"journal" (Entry.to_string entry)

let severity : Log.severity -> string = function
  | Trouble -> "trouble"
  | Said -> "said"
  | Completed -> "completed"
  | Ordinary -> "ordinary"

let text tell kind ~time ?(about = []) text =
  tell_json tell "log"
    (`Assoc
       [ ("time", Canonical.number time); ("severity", `String kind); ("about", Dolphin_json.Field.texts about);
         ("text", `String text) ])

let line_on tell ~time (l : Log.line) = text tell (severity l.severity) ~time ~about:l.about l.text
let line n = line_on n.tell_
let remark_on tell ~time what = line_on tell ~time (Log.remark Log.start ~time what)

(* {1 On the map} *)

let timed ~time name json : Yojson.Safe.t = `Assoc [ ("time", Canonical.number time); (name, json) ]

let places n ~time (before : Shared.t) =
  let store = n.configuration.shared.store in
  if store != before.store then begin
    let now = Charted.places n.program.program store in
    if now <> n.places then begin
      n.places <- now;
      tell n "places" (timed ~time "places" now)
    end
  end

let ways n ~time (t : Transition.t) =
  let of_effect : Effect.t -> Yojson.Safe.t option = function
    | Start (v, task) -> Charted.way n.world v task
    | Stop _ | Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
    | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ -> None
  in
  List.iter (fun way -> tell n "way" (timed ~time "way" way)) (List.filter_map of_effect t.effects)

let transition n ~stuck ~time (t : Transition.t) =
  let before = n.configuration.shared in
  n.configuration <- t.next;
  places n ~time before;
  ways n ~time t;
  let log, lines = Log.transition ~stuck n.log ~time t in
  n.log <- log;
  List.iter (line n ~time) lines

let configuration n = n.configuration

let replaced n program configuration =
  n.program <- program;
  n.configuration <- configuration

let news n ~time state =
  n.world <- World.add state n.world;
  let log, lines = Log.news n.log ~time state in
  n.log <- log;
  List.iter (line n ~time) lines

let remark n ~time what = line n ~time (Log.remark n.log ~time what)
let question n ~time prompt = text n.tell_ "said" ~time (Log.question n.log ~time prompt)

(* {1 Waiting} *)

let place n at = Step.text_of_place (Step.place_of n.program.program at)

let json_of_waiting n ({ what; at; lacking } : Waiting.t) : Yojson.Safe.t =
  let member name f = Option.fold ~none:[] ~some:(fun x -> [ (name, `String (f x)) ]) in
  `Assoc ((("what", `String what) :: member "at" (place n) at) @ member "lacking" Fun.id lacking)

type place_of_question = { at : string option; is_confirm : bool }

let place_of_question n prompt =
  let { Program_file.program; source; _ } = n.program in
  let found = Waiting.question program ~source n.configuration prompt in
  { at = Option.map (place n) found.at; is_confirm = found.is_confirm }

let open_questions n =
  let located (q : Open_question.t) = (q, Option.map (place n) (Program_file.location n.program q.site)) in
  List.map located (Open_question.list n.configuration)

let waiting n ~time =
  let { Program_file.program; source; _ } = n.program in
  let world = World.at (Exactly (World.whole time)) n.world in
  let now = Waiting.list program ~source world n.configuration in
  if now <> n.told then begin
    n.told <- now;
    tell n "waiting" (`Assoc [ ("time", Canonical.number time); ("for", `List (List.map (json_of_waiting n) now)) ])
  end

let replayed n (e : Entry.t) replay =
  entry n e;
  match e, Replay.latest replay with
  | Vehicle { time; state }, _ -> news n ~time state
  | Transition { time; _ }, Some (_, t) ->
    transition n ~stuck:(Replay.was_stuck replay) ~time t;
    waiting n ~time
  | Act { time; act }, _ -> remark n ~time (Act.words act)
  | (Header _ | Partial _ | Label _ | Event _ | Transition _ | Note _ | Resumed _ | End _), _ -> ()
