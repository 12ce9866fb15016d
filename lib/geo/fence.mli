(** Ways against areas that they must keep within, or out of.

    {[
      open Dolphin_geo

      let at north = Wgs84.displace Place.apdl ~north ~east:0.
      let harbour = { Fence.side = Inside; area = Result.get_ok (Area.circle Place.apdl 500.); margin = 20. }
      let fence = Fence.make [ harbour ]
      let to_north metres = [ { Fence.from = at 0.; towards = at metres; radius = 0. } ]

      let () =
        assert (Fence.breach fence (to_north 400.) = None);
        match Fence.breach fence (to_north 490.) with
        | Some breach -> assert (breach.stretch = 0 && Float.abs (breach.by -. 10.) < 0.1)
        | None -> assert false
    ]} *)

(** The side of an area's rim on which ways must stay. *)
type side = Inside | Outside

(** A limit to ways. *)
type rule = {
  side : side;
  area : Area.t;
  margin : float;  (** metres that a way keeps from the area's rim, finite, at least 0 *)
}

(** A part of a way: the points at most [radius] metres from the shortest line between two places. *)
type stretch = { from : Position.t; towards : Position.t; radius : float }

type t
(** Rules, made ready to be asked about many ways. *)

val make : rule list -> t
(** Areas that lie within 10 km share a plane ({!Plane}), others have one of their own. *)

val without_margins : t -> t
(** [without_margins (make rules)] is [make] of [rules] with margins of 0. *)

type breach = {
  rule : int;  (** from 0 *)
  stretch : int;  (** from 0 *)
  at : Position.t;  (** a point of the line of that stretch, at height 0 *)
  by : float;  (** metres by which that point, with the stretch's [radius], is nearer to the rim, or farther beyond it,
                   than the rule allows *)
}

val tolerance : float
(** 5 mm: so far a way may go without a breach, for the rounding of places. *)

val breach : t -> stretch list -> breach option
(** [breach t way] is the breach of the first stretch of [way] that breaks a rule, of the first rule that it breaks:
    [None] if [way] keeps to all of them, up to {!tolerance} and to the error of a {!Plane} in distances and lines.
    If the stretch only comes too near to the rim, [at] is its nearest point. If it crosses the rim, or lies beyond
    it, [at] is the worst of a set of its points so dense that another is worse by little. *)

val breaches_at : t -> Position.t -> (int * float) list
(** [breaches_at t p] is the rules that [p] breaks, each with the metres, in order. *)

(** {1 Ways beside each other} *)

(** The place where two ways come near each other. *)
type meeting = {
  first : int;  (** a stretch of the one, from 0 *)
  second : int;  (** of the other *)
  place : Position.t;  (** on the first *)
  distance : float;  (** metres between the two, at least 0 *)
}

val nearest : within:float -> stretch list -> stretch list -> meeting option
(** [nearest ~within a b] is the points at which [a] and [b] are nearest to each other, if that is nearer than
    [within] metres, up to {!tolerance}; of several such places the first on [a], then on [b]. *)
