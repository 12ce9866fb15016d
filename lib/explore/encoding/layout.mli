(** Shapes of executing configurations, and how a configuration of a shape is laid out in words. A shape is the machine
    that waits, the tree of nests, and the families of the parts in it, in order. All else that tells configurations of
    one shape apart is a few small numbers: what is shared, and each part's number in its family. *)

open Dolphin_semantics

(** A machine that waits for a task. *)
type frame = {
  frame : int;
  machine : Machine.t;
  symmetry : Task_group.t option;  (** if states are kept only up to what can change places *)
  mutable over : int array;
  (** by shared number, for the use of {!Space}: the number of the configuration that follows the end of the task *)
}

(** Where a part or a nest stands. *)
type place = private {
  index : int;  (** parts first, by position *)
  from : int;
  upto : int;  (** the positions of its parts: those from [from] on, below [upto] *)
  inside : Component.path option;  (** of a nest *)
  children : place list;  (** of a nest *)
  mutable around : place option;  (** the nest that it is in *)
}

type t = {
  number : int;  (** from 1 *)
  frame : frame;
  top : place list;
  families : Component.family array;
  leaves : place array;  (** by position *)
  nests : place array;
  mutable word : int array;  (** by position: the word that holds the part *)
  mutable shift : int array;  (** its lowest bit there *)
  mutable mask : int array;  (** all bits of its width, at the right *)
  without : t option array;  (** by place: the shape without what stands there, once it is known *)
  becoming : (int, t) Hashtbl.t;
  (** by place and serial number of a target: the shape after it, once it is known *)
}

val create : number:int -> frame -> Component.family Component.tree list -> t
(** Not laid out yet. *)

val above : place -> int -> place
(** [above p n] is the nest that is [n] levels above [p]; [p] itself if [n] is 0. *)

val replaced : t -> place -> Component.family Component.tree list -> Component.family Component.tree list
(** [replaced s p trees] is the tree of [s] with [trees] for what stands at [p]. *)

val key : frame -> Component.family Component.tree list -> int list
(** [key f trees] is different for all that makes a different shape. *)

val residual : t -> place -> (int -> Residual.t) -> Residual.t
(** [residual s p part] is what stands at [p], with [part i] at position [i]. *)

(** {1:words Words}

    The first word starts with the shape's number, lowest bits first, then has what a {!Product} knows, if there is one,
    and the number of what is shared; the parts follow, none across the end of a word. Shape 0 stands for all other
    configurations, each with its own number above these. *)

type widths = { shape : int; watched : int; shared : int }

val lay_out : widths -> t -> int
(** [lay_out widths s] lays [s] out anew, in the present widths of its families; the result is how many words it
    needs. *)

val local : t -> int array -> int -> int
(** [local s key i] is the number of the part at position [i] in its family, in a state of shape [s]. *)

val put : t -> int array -> int -> int -> unit
(** [put s key i n] makes it [n], where all bits are 0. *)
