open Dolphin_geo

type shape =
  | Spot of Position.t
  | Way of Position.t list
  | Ground of ring list
  | Sketch of Position.t list
  | Round of { centre : Position.t; radius : float }
  | Flawed of string
  | Note of string

and ring = { rim : Position.t list; holes : Position.t list list }

type t = { name : string; place : string; shape : shape }

exception Wrong of { place : string; why : string }

let wrong place format = Printf.ksprintf (fun why -> raise (Wrong { place; why })) format

let each ~name ~place f =
  match f () with
  | shapes -> List.rev (List.rev_map (fun shape -> { name; place; shape }) shapes)
  | exception Wrong { place; why } -> [ { name; place; shape = Flawed why } ]

let left_out ?(name = "") place format =
  Printf.ksprintf (fun why -> [ { name; place; shape = Note (why ^ ", and left out") } ]) format

let empty = Note "it is empty, and left out"

let no_geometry = Note "it has no geometry, and is left out"

let some = function [] -> [ empty ] | shapes -> shapes

let non_empty shapes = some (List.filter (( <> ) empty) shapes)

(* {1 Rings that files close} *)

let accuracy = 1e-3

let gap ring =
  match ring, List.rev ring with
  | (first : Position.t) :: _ :: _, (last : Position.t) :: _ ->
    if first.latitude = last.latitude && first.longitude = last.longitude then 0. else Wgs84.distance first last
  | _, _ -> 0.

let open_end ring =
  let metres = gap ring in
  if metres <= accuracy then None
  else Some (Printf.sprintf (if metres < 10. then "%.3f m" else "%.0f m") metres)

let closing name ring =
  let note = Printf.sprintf "%s ends %s from its beginning, and is closed by a straight line" name in
  Option.to_list (Option.map (fun metres -> Note (note metres)) (open_end ring))

let with_gaps shapes =
  let polygons = List.concat_map (function Ground rings -> rings | _ -> []) shapes in
  let one i { rim; holes } =
    let of_polygon = match polygons with [ _ ] -> "" | _ -> Printf.sprintf " of polygon %d" (i + 1) in
    let hole j ring = closing (Printf.sprintf "hole %d%s" (j + 1) of_polygon) ring in
    closing ("the rim" ^ of_polygon) rim @ List.concat (List.mapi hole holes)
  in
  shapes @ List.concat (List.mapi one polygons)

let position place ~latitude ~longitude ~height =
  match Position.make ~latitude ~longitude ~height with
  | Ok p -> p
  | Error e -> wrong place "%s" (Format.asprintf "%a" Position.pp_error e)
