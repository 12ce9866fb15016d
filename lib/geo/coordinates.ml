type mark = Degrees | Minutes | Seconds
type hemisphere = North | South | East | West
type token = Number of float * bool | Mark of mark | Hemisphere of hemisphere | Comma | Word of string

let ( let* ) = Result.bind

let spellings =
  [ ("\xc2\xb0", Mark Degrees); ("\xc2\xba", Mark Degrees); ("''", Mark Seconds); ("'", Mark Minutes);
    ("\"", Mark Seconds); ("\xe2\x80\xb2", Mark Minutes); ("\xe2\x80\x99", Mark Minutes);
    ("\xe2\x80\xb3", Mark Seconds); ("\xe2\x80\x9d", Mark Seconds); (",", Comma); (";", Comma) ]

let words =
  [ ("N", Hemisphere North); ("S", Hemisphere South); ("E", Hemisphere East); ("W", Hemisphere West);
    ("d", Mark Degrees); ("deg", Mark Degrees); ("m", Mark Minutes); ("s", Mark Seconds) ]

let is_letter c = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')
let is_of_number c = (c >= '0' && c <= '9') || c = '.'

(* [span is text i] is the end of the characters from [i] that satisfy [is]. *)
let rec span is text i = if i < String.length text && is text.[i] then span is text (i + 1) else i

let starts_at text i prefix =
  let n = String.length prefix in
  i + n <= String.length text && String.sub text i n = prefix

let rec tokens text i found =
  if i >= String.length text then Ok (List.rev found)
  else
    match text.[i] with
    | ' ' | '\t' -> tokens text (i + 1) found
    | c when is_letter c ->
      let j = span is_letter text i in
      let word = String.sub text i (j - i) in
      let token = Option.value (List.assoc_opt word words) ~default:(Word word) in
      tokens text j (token :: found)
    | c when is_of_number c || c = '-' || c = '+' -> number text i found
    | _ -> (
        match List.find_opt (fun (spelling, _) -> starts_at text i spelling) spellings with
        | Some (spelling, token) -> tokens text (i + String.length spelling) (token :: found)
        | None -> Error "it cannot be read")

and number text i found =
  let signed = not (is_of_number text.[i]) in
  let first = if signed then i + 1 else i in
  let j = span is_of_number text first in
  match Dolphin_numerals.Numeral.number (String.sub text first (j - first)) with
  | Some x when j > first -> tokens text j (Number ((if text.[i] = '-' then -.x else x), signed) :: found)
  | Some _ | None -> Error "a number of it cannot be read"

(* {1 Degrees} *)

let is_hemisphere = function Hemisphere _ -> true | Number _ | Mark _ | Comma | Word _ -> false

(* The tokens of one coordinate and those of the other. *)
let halves tokens =
  let rec until stops before = function
    | [] -> None
    | token :: rest when stops token -> Some (List.rev before, token, rest)
    | token :: rest -> until stops (token :: before) rest
  in
  match until (fun token -> token = Comma) [] tokens, tokens with
  | Some (first, _, second), _ -> Some (first, second)
  | None, [ (Number _ as a); (Number _ as b) ] -> Some ([ a ], [ b ])
  | None, (Hemisphere _ as first) :: rest ->
    Option.map (fun (numbers, letter, rest) -> (first :: numbers, letter :: rest)) (until is_hemisphere [] rest)
  | None, _ -> Option.map (fun (numbers, letter, rest) -> (numbers @ [ letter ], rest)) (until is_hemisphere [] tokens)

(* Degrees, minutes and seconds in that order; without marks they are that by their order. *)
let rec parts expected = function
  | [] -> Ok []
  | Number (x, signed) :: rest -> (
      let mark, rest =
        match expected, rest with
        | _, Mark mark :: rest -> (Some mark, rest)
        | mark :: _, rest -> (Some mark, rest)
        | [], rest -> (None, rest)
      in
      let rec after mark = function [] -> None | m :: left -> if m = mark then Some left else after mark left in
      match Option.bind mark (fun mark -> Option.map (fun left -> (mark, left)) (after mark expected)) with
      | None -> Error "degrees, minutes and seconds come in this order, each once"
      | Some (mark, _) when mark <> Degrees && signed -> Error "only degrees have a sign"
      | Some (mark, _) when mark <> Degrees && x >= 60. ->
        Error (Printf.sprintf "%s are below 60, not %.15g" (if mark = Minutes then "minutes" else "seconds") x)
      | Some (mark, left) ->
        let* others = parts left rest in
        if others <> [] && not (Float.is_integer x) then
          Error "only the last of degrees, minutes and seconds has a fraction"
        else Ok ((mark, x, signed) :: others))
  | (Mark _ | Hemisphere _ | Comma | Word _) :: _ -> Error "a number is missing"

(* The degrees of one coordinate, with its hemisphere. *)
let coordinate tokens =
  let letters, others = List.partition is_hemisphere tokens in
  let* hemisphere =
    match letters with
    | [] -> Ok None
    | [ Hemisphere h ] when tokens = (letters @ others) || tokens = (others @ letters) -> Ok (Some h)
    | _ -> Error "one letter of N, S, E and W belongs to each number"
  in
  let* found = parts [ Degrees; Minutes; Seconds ] others in
  match found with
  | [] -> Error "a number is missing"
  | (first, x, signed) :: _ ->
    let share = function Degrees -> 1. | Minutes -> 60. | Seconds -> 3600. in
    let size = List.fold_left (fun sum (mark, x, _) -> sum +. (Float.abs x /. share mark)) 0. found in
    let negative = signed && Float.sign_bit x in
    if first <> Degrees then Error "degrees are missing"
    else if signed && hemisphere <> None then Error "a sign and a letter of N, S, E and W exclude each other"
    else
      match hemisphere with
      | Some (South | West) -> Ok (-.size, hemisphere)
      | Some (North | East) | None -> Ok ((if negative then -.size else size), hemisphere)

let is_latitude = function Some (North | South) -> true | Some (East | West) | None -> false
let is_longitude = function Some (East | West) -> true | Some (North | South) | None -> false

let in_degrees tokens =
  match halves tokens with
  | None | Some (_, []) | Some ([], _) ->
    Error "a latitude and a longitude are missing, as in 41\xc2\xb011.1'N 8\xc2\xb042.4'W"
  | Some (first, second) ->
    let* a, of_a = coordinate first in
    let* b, of_b = coordinate second in
    let* latitude, longitude =
      if is_longitude of_a && is_latitude of_b then Ok (b, a)
      else if is_longitude of_a || is_latitude of_b then Error "it has no latitude and longitude, by its letters"
      else if (of_a = None) <> (of_b = None) then Error "both have a letter of N, S, E and W, or none has"
      else Ok (a, b)
    in
    Result.map_error (Format.asprintf "%a" Position.pp_error) (Position.make ~latitude ~longitude ~height:0.)

(* {1 The grid} *)

let whole_zone x = if Float.is_integer x && Float.abs x < 1000. then int_of_float x else 0

let of_band letter ~zone ~easting ~northing =
  let half = if letter >= 'N' then Utm.North else Utm.South in
  let* p = Utm.position ~zone half ~easting ~northing in
  let near shift = Utm.band (p.latitude +. shift) = Some letter in
  if near 0. || near 0.5 || near (-0.5) then Ok p
  else
    Error
      (Printf.sprintf "the letter %c of UTM is a band of latitudes, and these metres are not in it; write %d %s" letter
         zone
         (if letter = 'S' then "south for the southern half" else "north or south for a half"))

(* The zone, then the band or the half, then metres. *)
let on_grid = function
  | Number (zone, false) :: where :: rest -> (
      let metres =
        match rest with
        | [ Number (easting, false); Number (northing, false) ]
        | [ Number (easting, false); Comma; Number (northing, false) ]
        | [ Number (easting, false); Mark Minutes; Number (northing, false); Mark Minutes ]
        | [ Number (easting, false); Hemisphere East; Number (northing, false); Hemisphere North ] ->
          Some (easting, northing)
        | _ -> None
      in
      let zone = whole_zone zone in
      let half half = Option.map (fun (easting, northing) -> Utm.position ~zone half ~easting ~northing) metres in
      let band letter = Option.map (fun (easting, northing) -> of_band letter ~zone ~easting ~northing) metres in
      match where with
      | Word ("north" | "n" | "North") -> half North
      | Word ("south" | "South") | Mark Seconds -> half South
      | Hemisphere North -> band 'N'
      | Hemisphere South -> band 'S'
      | Hemisphere West -> band 'W'
      | Hemisphere East -> band 'E'
      | Word text when String.length text = 1 && String.contains "CDEFGHJKLMPQRTUVX" text.[0] ->
        band text.[0]
      | Number _ | Mark _ | Comma | Word _ -> None)
  | _ -> None

let longest = 200

let of_string text =
  let explained why = Printf.sprintf "'%s' is not a position: %s" text why in
  if String.length text > longest then Error "the text is too long for a position"
  else
    Result.map_error explained
      (let* tokens = tokens text 0 [] in
       match on_grid tokens with
       | Some found -> found
       | None ->
         if List.exists (function Word _ -> true | _ -> false) tokens then Error "it cannot be read"
         else in_degrees tokens)
