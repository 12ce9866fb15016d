open Dolphin_geo

type shape =
  | Spot of Position.t
  | Way of Position.t list
  | Ground of ring list
  | Sketch of Position.t list
  | Round of { centre : Position.t; radius : float }

and ring = { rim : Position.t list; holes : Position.t list list }

type t = { name : string; place : string; shape : shape }

exception Wrong of { place : string; why : string }

let wrong place format = Printf.ksprintf (fun why -> raise (Wrong { place; why })) format

let position place ~latitude ~longitude ~height =
  match Position.make ~latitude ~longitude ~height with
  | Ok p -> p
  | Error e -> wrong place "%s" (Format.asprintf "%a" Position.pp_error e)
