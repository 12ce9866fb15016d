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

let position place ~latitude ~longitude ~height =
  match Position.make ~latitude ~longitude ~height with
  | Ok p -> p
  | Error e -> wrong place "%s" (Format.asprintf "%a" Position.pp_error e)
