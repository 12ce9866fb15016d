open Dolphin_geo

type t = { name : string; outlines : (string * Outline.t) list }

let rims : Outline.t -> Position.t list list = function
  | Spot p -> [ [ p ] ]
  | Way ps -> [ ps ]
  | Rings rings -> rings
  | Round { centre; radius } -> (
      match Area.circle centre radius with Ok circle -> [ Area.corners circle ] | Error _ -> [ [ centre ] ])

let places layer = List.map (fun (_, outline) -> List.concat (rims outline)) layer.outlines

(* {1 What is near the map}

   A coast may be that of a continent: parts outside of the map are drawn by few points. *)

let margin = 40.

let is_beyond ~left ~right ~top ~bottom (x, y) =
  x < left -. margin || x > right +. margin || y < top -. margin || y > bottom +. margin

(* Points beyond one side of the map all, so that no line between two of them meets it. *)
let is_apart ~left ~right ~top ~bottom points =
  let all side = List.for_all side points in
  all (fun (x, _) -> x < left) || all (fun (x, _) -> x > right) || all (fun (_, y) -> y < top)
  || all (fun (_, y) -> y > bottom)

(* Of points beyond that follow each other on one side, the first and the last are enough. *)
let without_beyond ~left ~right ~top ~bottom points =
  let beyond = is_beyond ~left ~right ~top ~bottom and apart = is_apart ~left ~right ~top ~bottom in
  let add kept p =
    match kept with
    | b :: a :: rest when beyond p && beyond b && beyond a && apart [ p; b; a ] -> p :: a :: rest
    | kept -> p :: kept
  in
  List.rev (List.fold_left add [] points)

let numbers = 3
let key i = Printf.sprintf "layer layer%d" (i mod numbers)

let draw ~project ~thin ~left ~right ~top ~bottom i layer =
  let points ps = without_beyond ~left ~right ~top ~bottom (List.map project ps) in
  let apart = is_apart ~left ~right ~top ~bottom in
  let commands ~closed ps =
    let point (x, y) = Svg.number x ^ "," ^ Svg.number y in
    "M" ^ String.concat " L" (List.map point (thin (points ps))) ^ if closed then " Z" else ""
  in
  let shape (name, (outline : Outline.t)) =
    let tip = if name = "" then layer.name else name in
    let path ~name ~closed rims = [ Svg.path ~name ~tip (String.concat " " (List.map (commands ~closed) rims)) ] in
    let rims = rims outline in
    if apart (List.map project (List.concat rims)) then []
    else
      match outline with
      | Spot p -> [ Svg.circle ~name:(key i ^ " spot") ~tip (project p) 3. ]
      | Way _ -> path ~name:(key i) ~closed:false rims
      | Rings _ | Round _ -> path ~name:(key i ^ " filled") ~closed:true rims
  in
  List.concat_map shape layer.outlines
