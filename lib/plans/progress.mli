(** How far a vehicle is on the way of its plan, from reports of its place. Pure.

    A vehicle advances along the way only: each report is matched with the part of the way ahead that the vehicle can
    have reached since the report before. So neither neighbouring rows nor crossings make it jump. Of the places that
    match, that one is taken which lies nearest and best fits the time that has passed. A vehicle that is more than 50
    metres off its way does not advance until it is back.

    {[
      open Dolphin_geo
      open Dolphin_plans

      let go_to id location =
        { Plan.id; kind = Go_to; location; speed = (2., Metres_per_second); z = (3., Depth); payloads = [] }

      let away metres = Wgs84.displace Place.apdl ~north:metres ~east:0.

      let plan =
        Inline_plan.Maneuvers
          { name = "out"; description = ""; vehicles = [];
            maneuvers = [ go_to "1.Goto" Place.apdl; go_to "2.Goto" (away 1000.) ] }

      let () =
        let t = Option.get (Progress.start ~speed:2. plan) in
        let t = Progress.observe ~at:0. Place.apdl t in
        let t = Progress.observe ~at:125. (away 250.) t in
        assert (Float.abs (Progress.share t -. 0.25) < 0.001)
    ]} *)

module Position = Dolphin_geo.Position

type t
(** The progress of one vehicle on one plan. *)

val start : speed:float -> Inline_plan.t -> t option
(** [start ~speed p] is the progress of a vehicle that has been given [p], with [speed] where [p] has no speed in metres
    per second; [nan] if that is not known. [None] if [p] has no {!Inline_plan.way_from}, or no place. *)

val observe : at:float -> Position.t -> t -> t
(** [observe ~at p t] is [t] once the vehicle was seen at [p] at the second [at], which is not before that of the report
    before. The share never falls. It is 0 until the vehicle has come to the first place of the way, or was seen behind
    it. In the time of a dwell the vehicle may be anywhere within the radius of the leg and 30 metres. *)

val share : t -> float
(** [share t] is the share of the way that is done, from 0 to 1, as {!Inline_plan.from_share} takes it. *)
