(* The offset of the local zone, in zones on both sides of UTC, by minutes, and where the year or the day is another. *)

open Dolphin_app
open Dolphin_semantics

(* POSIX has the sign the other way round: the offset is what is added to the local time for UTC. *)
let zones = [ ("UTC0", 0); ("AAA-1", 60); ("AAA+3", -180); ("AAA-5:30", 330); ("AAA+9:30", -570); ("AAA-14", 840) ]

let at year month day hour =
  let tm : Unix.tm =
    { tm_year = year - 1900; tm_mon = month - 1; tm_mday = day; tm_hour = hour; tm_min = 0; tm_sec = 0; tm_wday = 0;
      tm_yday = 0; tm_isdst = false }
  in
  fst (Unix.mktime tm)

let in_zone name f =
  let before = Option.value (Sys.getenv_opt "TZ") ~default:"" in
  Unix.putenv "TZ" name;
  Fun.protect ~finally:(fun () -> Unix.putenv "TZ" before) f

let test_zones () =
  let check (name, minutes) =
    let of_moment (year, month, day, hour) =
      let seconds = in_zone "UTC0" (fun () -> at year month day hour) in
      let label = Printf.sprintf "%s at %d-%d-%d %d:00" name year month day hour in
      Alcotest.(check int) label minutes (in_zone name (fun () -> Local_time.zone seconds))
    in
    List.iter of_moment
      [ (2026, 6, 1, 12); (2026, 12, 31, 23); (2027, 1, 1, 0); (2028, 2, 29, 23); (2028, 12, 31, 20); (2026, 7, 1, 0) ]
  in
  List.iter check zones

(* Central European time. *)
let test_summer () =
  let zone = "CET-1CEST,M3.5.0,M10.5.0/3" in
  let offset month = in_zone zone (fun () -> Local_time.zone (at 2026 month 15 12)) in
  Alcotest.(check (pair int int)) "winter and summer" (60, 120) (offset 1, offset 7)

let test_now () =
  let date = in_zone "AAA-5:30" (fun () -> Local_time.now None) in
  Alcotest.(check int) "the local zone" 330 date.Calendar.zone;
  Alcotest.(check int) "a given one" (-60) (Local_time.now (Some (-60))).Calendar.zone

let () =
  Alcotest.run "local time"
    [ ("zones",
       [ Alcotest.test_case "offsets" `Quick test_zones; Alcotest.test_case "summer" `Quick test_summer;
         Alcotest.test_case "now" `Quick test_now ]) ]
