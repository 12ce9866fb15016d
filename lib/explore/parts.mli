(** The parts of executing tasks (the components of a [Residual.Parallel], or a residual by itself), each known by a
    small number, with their local steps worked out once.

    A part belongs to a family: the part that it comes from by local steps, and others that do. Its number is the one
    within its family, so that few bits tell which of the family stands somewhere. *)

open Dolphin_semantics

module Shareds : module type of Interner.Make (Shared)

(** What becomes of a part. *)
type target =
  | Stays of int  (** in its family, with this number *)
  | Gone
  | Becomes of { serial : int; parts : part array }
  (** these parts, side by side, or one of another family; [serial] tells such targets apart *)
  | Ends of Configuration.ending  (** of the whole run *)

and part = private {
  residual : Residual.t;
  family : family;
  local : int;  (** its number in its family, from 0 *)
  mutable steps : step array;  (** once it is {!reach}ed *)
  mutable worked_out : step array option;
  mutable components : Components.t option;
}

and family = private {
  number : int;
  mutable members : part array;
  mutable size : int;
  mutable width : int;  (** in bits, of the numbers of members in the layouts in use; 0 if there is none *)
}

(** How a step depends on what is shared. *)
and dependence =
  | Free  (** not: always possible, changes nothing *)
  | Guarded of guard  (** it runs code, with the same target whenever the code goes well *)
  | By_case  (** in any way *)

and guard = private {
  mutable results : int array;  (** by shared number: that of what is shared after, or one of those below *)
}

(** A step as it is when so and so is shared. *)
and case = {
  possible : bool;
  certain : bool;  (** whatever sensors show *)
  shared : int;  (** after the step *)
  result : target;
  mutable whole : int;  (** for the use of {!Space}: the number of the configuration that it ends in, or -1 *)
  others : case list;  (** what else it does, if sensors show something else *)
}

and step = private {
  index : int;  (** in [Residual.steps] *)
  source : Residual.step;
  event : Transition.event option;  (** the one that it takes *)
  dependence : dependence;
  target : target;  (** if it goes well *)
  stays : int;  (** [n] if [target] is [Stays n], else -1 *)
  mutable cases : case array;  (** by shared number *)
}

val unknown : int
(** A guard's result that is to be found with {!guarded}. *)

val impossible : int
(** The guard does not hold. *)

val special : int
(** The code did not go well: see {!case}. *)

type t

val create : ?foreseen:int -> Environment.options -> Core.program -> World.t -> t
(** So many members of a new family are worked out in advance: layouts are then seldom outgrown. *)

val shareds : t -> Shareds.t
val coverage : t -> Coverage.t

val part : t -> Residual.t -> part
(** [part t r] is the part [r], which is no [Parallel]. *)

val reach : t -> part -> unit
(** [reach t p] works out the steps of [p], which some run reaches. *)

val components : t -> part -> Components.t
(** [components t p] is of the steps of [p], in their order. *)

val guarded : t -> step -> guard -> int -> int
(** [guarded t step guard s] is the result of [guard] for shared number [s]. *)

val case : t -> family -> step -> int -> case
(** [case t f step s] is what [step], of a part of [f], does when [s] is shared. *)

val lay_out : family -> unit
(** [lay_out f] makes [f] as wide as its members need. *)

val outgrown : t -> bool
(** Whether a family has outgrown its width since it was laid out. *)

val none_outgrown : t -> unit
(** All families have been laid out again. *)
