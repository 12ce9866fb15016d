open Dolphin_imc
open Dolphin_platform_imc
open Dolphin_runtime
open Dolphin_geo
module State = Message.Plan_control_state

let loopback = Unix.inet_addr_loopback
let vehicle = 0x1A

let settings : Station.settings =
  { id = 0x4001; name = "ccu-7"; program = "p.dol"; addresses = [ { host = loopback; port = 6001 } ]; epoch = 0.;
    first_request = 0; payload = []; types = []; type_names = []; records = false; abort_after = None; run = "";
    jitter = 0. }

let hear ~now message s =
  let packet = Packet.make ~src:vehicle ~dst:Header.nobody ~timestamp:(1000. +. now) message in
  fst (Station.datagram ~now ~from:loopback (Result.get_ok (Packet.encode packet)) s)

let announce =
  Message.Announce
    { Message.Announce.default with
      sys_name = "x8-02"; sys_type = Uav; lat = 0.7; lon = 0.1; services = "imc+udp://127.0.0.1:6002/" }

let at north = Message.Estimated_state { Message.Estimated_state.default with lat = 0.7; lon = 0.1; x = north }
let ready = Message.Plan_control_state { State.default with state = Ready; plan_id = "q" }

let state ~now s =
  match Station.systems ~now s with
  | [ { state; _ } ] -> state
  | systems -> Alcotest.failf "%d systems" (List.length systems)

(* The last that the program was told, or [told]. *)
let rec told s last =
  match Station.take s with
  | None -> (s, last)
  | Some (Platform.Vehicle state, s) -> told s (Some state)
  | Some ((Task_done _ | Task_failed _ | Timer _ | Input _ | Quiet), s) -> told s last

let instant = 0.1
let step i = float_of_int i *. instant

(* At some steps the vehicle reports that it is so many metres north; it is ready all the time. *)
let flight reports =
  let one (s, last, reported) i =
    let now = step i in
    let s = if i mod 3 = 0 then hear ~now ready s else s in
    let here = List.assoc_opt i reports in
    let s = match here with Some north -> hear ~now (at north) s | None -> s in
    let reported = if here = None then reported else Some i in
    let s = if Station.due s <= now then fst (Station.tick ~now s) else s in
    let s, last = told s last in
    let fail what = QCheck2.Test.fail_reportf "at %g: %s" now what in
    let age = match reported with Some at -> step (i - at) | None -> infinity in
    let picked = match last with Some state -> Dolphin_semantics.World.is_ready state | None -> false in
    if picked <> (age < Node.currency) && Float.abs (age -. Node.currency) > 1e-6 then
      fail (if picked then "it may be picked" else Option.value (state ~now s).unready ~default:"it is ready, untold");
    (match reported, last with
     (* It is told a second after it was told last, with the next datagram. *)
     | Some at, Some known when picked && step (i - at) > 1.3 +. 1e-9 ->
       if Wgs84.distance known.position (state ~now s).position > 5.01 then fail "the program has an old position"
     | _, _ -> ());
    (s, last, reported)
  in
  let s = hear ~now:0. announce (Station.create settings) in
  ignore (List.fold_left one (s, None, None) (List.init 150 Fun.id));
  true

let flights =
  let open QCheck2.Gen in
  list_size (int_bound 60) (pair (int_bound 149) (float_range 0. 2000.))

let random =
  Test_support.Property.case ~count:300 "a vehicle may be picked if its position is current"
    ~print:QCheck2.Print.(list (pair int float)) flights flight

let first =
  Alcotest.test_case "before its first report, a vehicle is not where it announced to be" `Quick (fun () ->
      let s = hear ~now:1. ready (hear ~now:0. announce (Station.create settings)) in
      let check what expected ~now s = Alcotest.(check (option string)) what expected (state ~now s).unready in
      check "not yet" (Some "has not reported its position yet") ~now:1. s;
      let s = hear ~now:1.5 (at 10.) s in
      check "now" None ~now:1.5 s;
      check "later" (Some "has not reported its position for 2 s") ~now:3.5 (fst (Station.tick ~now:3.5 s)))

let bound =
  Alcotest.test_case "what the program holds is not given up for an old position" `Quick (fun () ->
      let s = hear ~now:1. (at 10.) (hear ~now:1. ready (hear ~now:0. announce (Station.create settings))) in
      let s = fst (Station.bind ~now:1. [ "x8-02" ] s) in
      let s = hear ~now:9. ready s in
      Alcotest.(check (option string)) "ready" None (state ~now:9. s).unready)

let tests = ("positions", [ first; random; bound ])
