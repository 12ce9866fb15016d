open Dolphin_semantics

(* Two dates of the same moment are at most a day apart. *)
let zone seconds =
  let here = Unix.localtime seconds and utc = Unix.gmtime seconds in
  let days = if here.tm_year = utc.tm_year then here.tm_yday - utc.tm_yday else here.tm_year - utc.tm_year in
  (days * 1440) + ((here.tm_hour - utc.tm_hour) * 60) + here.tm_min - utc.tm_min

let now its_zone =
  let seconds = Unix.gettimeofday () in
  Calendar.of_unix ~zone:(Option.value its_zone ~default:(zone seconds)) seconds
