open Dolphin_plans
open Dolphin_geo
open Field

(* {1 Places and areas} *)

let pair (p : Position.t) : Yojson.Safe.t = `List [ Canonical.number p.latitude; Canonical.number p.longitude ]
let path ps : Yojson.Safe.t = `List (List.map pair ps)

let area : Area.t -> members = function
  | Circle { centre; radius } -> [ ("centre", pair centre); ("radius", Canonical.number radius) ]
  | Shape shape -> [ ("rings", `List (List.map path (Area.rings shape))) ]

let to_pair json =
  let* found = list number json in
  match found with
  | [ latitude; longitude ] ->
    Result.map_error (fun _ -> "a position out of range") (Position.make ~latitude ~longitude ~height:0.)
  | _ -> Error "a place is its latitude and its longitude"

let to_area found =
  let made result = Result.map_error (Format.asprintf "%a" Area.pp_error) result in
  if List.mem_assoc "rings" found then
    let* rings = get (list (list to_pair)) "rings" found in
    made (Area.of_rings rings)
  else
    let* centre = get to_pair "centre" found in
    let* radius = get number "radius" found in
    made (Area.circle centre radius)

(* {1 Fences} *)

let fence (f : Fences.fence) : Yojson.Safe.t =
  let metres n = [ ("metres", Canonical.number n) ] in
  let rule, what =
    match f.rule with
    | Inside a -> ("inside", area a)
    | Outside a -> ("outside", area a)
    | Depth n -> ("depth", metres n)
    | Height n -> ("height", metres n)
    | Distance n -> ("distance", metres n)
  in
  let margin = if f.margin = 0. then [] else [ ("margin", Canonical.number f.margin) ] in
  `Assoc ([ ("fence", `String f.text); ("rule", `String rule) ] @ margin @ what)

let to_fence json : (Fences.fence, string) result =
  let* found = members json in
  let* text = get text "fence" found in
  let* rule = get Field.text "rule" found in
  let* margin = optional number ~default:0. "margin" found in
  let metres make = Result.map make (get number "metres" found) in
  let* rule : Fences.rule =
    match rule with
    | "inside" -> Result.map (fun a -> Fences.Inside a) (to_area found)
    | "outside" -> Result.map (fun a -> Fences.Outside a) (to_area found)
    | "depth" -> metres (fun n -> Fences.Depth n)
    | "height" -> metres (fun n -> Fences.Height n)
    | "distance" -> metres (fun n -> Fences.Distance n)
    | other -> Error (Printf.sprintf "unknown fence '%s'" other)
  in
  Ok { Fences.rule; margin; text; at = Dolphin_syntax.Location.none }
