(* What a scenario is made of. A types-only module: it has no interface of its own; {!Scenario} says what the
   fields mean. *)

type drop = { from : float; lasts : float }

type vehicle = {
  id : Dolphin_semantics.Core.vehicle;
  kind : string;
  payload : string list;
  position : Dolphin_geo.Position.t;
  speed : float;
  battery : float;
  drain : float;
  charge : float;
  joins : float;
  leaves : float option;
  drops : drop list;
  batteries : float list;
  places : Dolphin_geo.Position.t list;
}

type duration = { least : float; most : float }
type ending = Succeeds | May_fail of float | Fails

type plan = {
  name : string;
  duration : duration option;
  ending : ending;
  place : Dolphin_geo.Position.t option;
  only : string list;
}

type answer = { prompt : string; texts : string list }
type reply = { call : string; rounds : Reply.t list list }
type t = { vehicles : vehicle list; plans : plan list; answers : answer list; replies : reply list }
