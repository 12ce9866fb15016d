type t = { year : int; month : int; day : int; second : int; zone : int }

let day_length = 86_400

(* Numbers of two digits, as in 21:30. *)
let digits text =
  let is_digit c = c >= '0' && c <= '9' in
  if String.length text = 2 && String.for_all is_digit text then int_of_string_opt text else None

let of_clock ~hours ~minutes ~seconds =
  if hours < 24 && minutes < 60 && seconds < 60 then Some ((hours * 3600) + (minutes * 60) + seconds) else None

let time_of_day text =
  let found =
    match List.map digits (String.split_on_char ':' text) with
    | [ Some hours; Some minutes ] -> of_clock ~hours ~minutes ~seconds:0
    | [ Some hours; Some minutes; Some seconds ] -> of_clock ~hours ~minutes ~seconds
    | _ -> None
  in
  let wrong = Printf.sprintf "'%s' is not a time of day from '00:00' to '23:59:59', such as '21:30'" text in
  Option.to_result found ~none:wrong

let most_zone = 14 * 60

let offset text =
  let sign = match text.[0] with '+' -> Some 1 | '-' -> Some (-1) | _ -> None | exception Invalid_argument _ -> None in
  match sign, String.split_on_char ':' (String.sub text 1 (max 0 (String.length text - 1))) with
  | Some sign, [ hours; minutes ] -> (
      match digits hours, digits minutes with
      | Some hours, Some minutes when minutes < 60 && (hours * 60) + minutes <= most_zone ->
        Some (sign * ((hours * 60) + minutes))
      | (Some _ | None), _ -> None)
  | (Some _ | None), _ | (exception Invalid_argument _) -> None

let zone text =
  let wrong =
    Printf.sprintf "'%s' is not a time zone: write 'UTC', or an offset from UTC of at most 14 hours, such as '+01:00'"
      text
  in
  if text = "UTC" then Ok 0 else Option.to_result (offset text) ~none:wrong

let pp_offset ppf minutes =
  Format.fprintf ppf "%c%02d:%02d" (if minutes < 0 then '-' else '+') (abs minutes / 60) (abs minutes mod 60)

let pp_zone ppf minutes = if minutes = 0 then Format.pp_print_string ppf "UTC" else pp_offset ppf minutes

let month_length ~year month =
  match month with
  | 2 -> if (year mod 4 = 0 && year mod 100 <> 0) || year mod 400 = 0 then 29 else 28
  | 4 | 6 | 9 | 11 -> 30
  | _ -> 31

let date text =
  match Scanf.sscanf text "%4[0-9]-%2[0-9]-%2[0-9]%!" (fun y m d -> (y, digits m, digits d)) with
  | year, Some month, Some day when String.length year = 4 ->
    let year = int_of_string year in
    if year >= 1 && month >= 1 && month <= 12 && day >= 1 && day <= month_length ~year month then
      Some (year, month, day)
    else None
  | _ | (exception (Scanf.Scan_failure _ | Failure _ | End_of_file)) -> None

let read ~zone text =
  let wrong = Printf.sprintf "'%s' is not a date and a time of day, such as '2026-06-01 21:30'" text in
  match String.split_on_char ' ' text with
  | [ its_date; time ] -> (
      match date its_date, time_of_day time with
      | Some (year, month, day), Ok second -> Ok { year; month; day; second; zone }
      | Some _, (Error _ as error) -> error
      | None, _ -> Error wrong)
  | _ -> Error wrong

let pp_time ppf n = Format.fprintf ppf "%02d:%02d:%02d" (n / 3600) (n / 60 mod 60) (n mod 60)

let pp_with separator ppf t =
  Format.fprintf ppf "%04d-%02d-%02d%c%a" t.year t.month t.day separator pp_time t.second

let pp_local = pp_with ' '
let pp ppf t = Format.fprintf ppf "%a%a" (pp_with 'T') t pp_offset t.zone

(* Years from March on, since year 0: leap days then come last, and the months of each five have 153 days. *)
let of_days days =
  let days = days + 719_468 in
  let era = (if days >= 0 then days else days - 146_096) / 146_097 in
  let of_era = days - (era * 146_097) in
  let years = (of_era - (of_era / 1_460) + (of_era / 36_524) - (of_era / 146_096)) / 365 in
  let of_year = of_era - ((365 * years) + (years / 4) - (years / 100)) in
  let months = ((5 * of_year) + 2) / 153 in
  let month = if months < 10 then months + 3 else months - 9 in
  (years + (era * 400) + (if month <= 2 then 1 else 0), month, of_year - (((153 * months) + 2) / 5) + 1)

let of_unix ~zone seconds =
  let local = int_of_float (Float.floor seconds) + (zone * 60) in
  let second = ((local mod day_length) + day_length) mod day_length in
  let year, month, day = of_days ((local - second) / day_length) in
  { year; month; day; second; zone }

let of_string text =
  let found =
    if String.length text <> 25 || text.[10] <> 'T' then None
    else
      let in_zone zone = Result.to_option (read ~zone (String.sub text 0 10 ^ " " ^ String.sub text 11 8)) in
      Option.bind (offset (String.sub text 19 6)) in_zone
  in
  Option.to_result found ~none:"not a date such as 2026-06-01T21:30:00+01:00"

let at t n = (t.second + n) mod day_length
