open Dolphin_platform_protocol
open Dolphin_runtime
open Lwt.Infix
module Order = Dolphin_platform_protocol.Order

type settings = {
  scenario : Dolphin_scenario.Scenario.t;
  seed : int;
  speed : float;
  state : string option;
}

type t = {
  now : unit -> float;  (* of the fleet *)
  memory : Memory.t option;
  output : Writer.t;
  mutable fleet : Served_fleet.t;
  mutable is_greeted : bool;
  mutable is_over : bool;
}

(* {1 Writing} *)

(* Nothing is sent before the greeting: a client that greets gets all vehicles, and asks about requests. *)
let tell s reports =
  if s.is_greeted then Writer.send s.output (String.concat "" (List.map Report.to_line reports))

(* {1 Orders and time} *)

let change s (fleet, reports) =
  s.fleet <- fleet;
  tell s reports

let catch_up s = change s (Served_fleet.advance ~until:(s.now ()) s.fleet)

let obey s (order : Order.t) =
  catch_up s;
  let time = s.now () in
  if Served_fleet.changes order s.fleet then Option.iter (fun memory -> Memory.add memory ~time order) s.memory;
  (match order with
   | Hello _ ->
     s.is_greeted <- true;
     tell s (Served_fleet.greeting :: Served_fleet.everyone s.fleet)
   | _ -> ());
  change s (Served_fleet.order ~now:time order s.fleet);
  if order = Close then s.is_over <- true

let read_order s = function
  | Lines.Line text -> (
      match Order.of_line text with
      | Ok (Some order) -> obey s order
      | Ok None -> ()
      | Error why -> prerr_endline ("dolphin sim: an order " ^ Dolphin_trace.Phrase.harmless why))
  | Too_long -> prerr_endline "dolphin sim: an order is too long"
  | End_of_input -> s.is_over <- true

let longest_sleep = 3600.

let until_due s speed =
  match Served_fleet.due s.fleet with
  | None -> fst (Lwt.task ())
  | Some time -> Lwt_unix.sleep (Float.max 0. (Float.min longest_sleep ((time -. s.now ()) /. speed)))

let rec serve s speed lines line =
  Lwt.pick [ (Lwt.protected line >|= fun line -> `Line line); (until_due s speed >|= fun () -> `Time) ] >>= function
  | `Time -> catch_up s; serve s speed lines line
  | `Line read ->
    read_order s read;
    if s.is_over then Writer.sent s.output else serve s speed lines (Lines.next lines)

(* The fleet as it is now, after what it was ordered before this process. *)
let rebuilt settings ~now orders =
  let fleet = Served_fleet.create ~seed:settings.seed ~is_remembered:(settings.state <> None) settings.scenario in
  let again fleet (time, order) = fst (Served_fleet.order ~now:time order fleet) in
  fst (Served_fleet.advance ~until:now (List.fold_left again fleet orders))

(* Reports that were not heard are repeated. *)
let opened settings =
  match settings.state with
  | None -> Ok (None, 0., [])
  | Some path ->
    let past (memory, began, orders) =
      let elapsed = Float.max 0. ((Unix.gettimeofday () -. began) *. settings.speed) in
      let latest = List.fold_left (fun latest (time, _) -> Float.max latest time) 0. orders in
      (Some memory, Float.max elapsed latest, orders)
    in
    Result.map past (Memory.open_ path)

let run settings =
  Sys.set_signal Sys.sigpipe Signal_ignore;
  match opened settings with
  | Error why ->
    print_string (Report.to_line (Trouble why));
    flush_all ();
    Lwt.return (Error why)
  | Ok (memory, at, orders) ->
    let clock = Clock.stopwatch ~at:(at /. settings.speed) Clock.system in
    let fleet = rebuilt settings ~now:at orders in
    let s =
      { now = (fun () -> clock () *. settings.speed); memory; output = Writer.make Lwt_unix.stdout;
        fleet; is_greeted = false; is_over = false }
    in
    let lines = Lines.make ~limit:Report.longest_line Lwt_unix.stdin in
    serve s settings.speed lines (Lines.next lines) >|= fun () -> Ok ()
