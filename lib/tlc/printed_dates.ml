module Moments = Map.Make (struct type t = int * string list let compare = Stdlib.compare end)

type t = (int * int) Moments.t

let none = Moments.empty

let add d program date moment =
  let wider = function
    | Some (earliest, latest) -> Some (min earliest date, max latest date)
    | None -> Some (date, date)
  in
  Moments.update (program, moment) wider d

let line d s =
  match Option.map (String.split_on_char '\t') (Quoted.unescape s) with
  | Some ("T" :: program :: date :: (_ :: _ as moment)) -> (
      match int_of_string_opt program, int_of_string_opt date with
      | Some program, Some date -> Some (add d program date moment)
      | None, _ | _, None -> None)
  | Some _ | None -> None

let windows d n =
  let of_program ((program, moment), window) = if program = n then Some (moment, window) else None in
  List.filter_map of_program (Moments.bindings d)
