open Dolphin_plans
open Dolphin_geo
open Codec

(* {1 Places and areas} *)

let place =
  let of_list = function
    | [ latitude; longitude ] ->
      Result.map_error (fun _ -> "a position out of range") (Position.make ~latitude ~longitude ~height:0.)
    | _ -> Error "not a place: its latitude and its longitude"
  in
  let to_list (p : Position.t) = [ p.latitude; p.longitude ] in
  conv of_list to_list (limited [ ("minItems", `Int 2); ("maxItems", `Int 2) ] (list (number ())))

let pair = write place
let path = write (list place)

let area_fields =
  let made result = Result.map_error (Format.asprintf "%a" Area.pp_error) result in
  let of_parts = function
    | Some rings, _, _ -> made (Area.of_rings rings)
    | None, Some centre, Some radius -> made (Area.circle centre radius)
    | None, None, _ -> Error "neither with rings nor with a centre"
    | None, Some _, None -> Error "without a radius"
  in
  let rings : Area.t -> _ = function Shape shape -> Some (Area.rings shape) | Circle _ -> None
  and centre : Area.t -> _ = function Circle c -> Some c.centre | Shape _ -> None
  and radius : Area.t -> _ = function Circle c -> Some c.radius | Shape _ -> None in
  check of_parts
    (let+ centre = optional "centre" place centre
     and+ radius = optional "radius" (number ()) radius ~doc:"metres"
     and+ rings = optional "rings" (list (list place)) rings ~doc:"its rims, and those of its holes" in
     (rings, centre, radius))

let area = members area_fields

(* {1 Fences} *)

let inside = case "inside" area_fields (fun a -> Fences.Inside a)
let outside = case "outside" area_fields (fun a -> Fences.Outside a)
let limit = number ~least:0. ~most:Wgs84.farthest ()
let metres = one "metres" limit
let depth = case "depth" metres (fun n -> Fences.Depth n)
let height = case "height" metres (fun n -> Fences.Height n)
let distance = case "distance" metres (fun n -> Fences.Distance n)

let fence =
  let choose : Fences.rule -> _ = function
    | Inside a -> Is (inside, a)
    | Outside a -> Is (outside, a)
    | Depth n -> Is (depth, n)
    | Height n -> Is (height, n)
    | Distance n -> Is (distance, n)
  in
  let rule =
    union_around ~tag:"rule"
      (default 0. "margin" limit Fun.id ~doc:"metres")
      [ Case inside; Case outside; Case depth; Case height; Case distance ]
      choose
  in
  named "fence"
    (record
       (let+ text = field "fence" text (fun (f : Fences.fence) -> f.text) ~doc:"as it is declared"
        and+ margin, rule = part (fun (f : Fences.fence) -> (f.margin, f.rule)) rule in
        { Fences.rule; margin; text; at = Dolphin_syntax.Location.none }))
