(** Graphs as JSON.

    {v
{ "format": "dolphin-lts", "version": 1,
  "initial": 0, "states": 3,
  "labels": ["start(survey1)", "done(survey1)"],
  "transitions": [[0, 0, 1], [1, 1, 2]],
  "texts": ["ready", "surveying", "home"] }
    v}

    A transition is [[source, label, target]]; states and labels are numbered from 0. ["texts"] describes each state
    and may be absent. Members that are not listed here are ignored, so that later versions can add some. *)

open Dolphin_lts

val write : (string -> unit) -> Graph.t -> unit
(** [write out g] calls [out] with the parts of the text, in order; a transition takes a line. *)

val to_string : Graph.t -> string
(** The text that {!write} writes. *)

(** The fault of a text. Transitions and texts are numbered from 0. *)
type error =
  | Not_json of string  (** with the place and the reason *)
  | Not_a_graph  (** ["format"] is not ["dolphin-lts"] *)
  | Version of int  (** another than 1 *)
  | Expected of { what : string; where : string }
  | No_such_state of { state : int; states : int; where : string }
  | No_such_label of { label : int; labels : int; where : string }

val of_string : string -> (Graph.t, error) result
(** [of_string (to_string g)] equals [g], and describes the states as [g] does. *)

val pp_error : Format.formatter -> error -> unit
(** The fault and its place, without a full stop. *)
