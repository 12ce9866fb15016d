(** Layouts of executing configurations in words. A layout is the machine that waits, the tree of nests, and the
    families of the components in it, in order. Configurations with the same layout differ in a few small numbers: that
    of the shared state, and each component's number in its family. *)

open Dolphin_semantics

(** A machine that waits for a task. *)
type frame = {
  number : int;  (** from 0 *)
  machine : Machine.t;
  symmetry : Task_group.t option;  (** if states are stored up to symmetry *)
}

(** The place of a component or a nest. *)
type place = private {
  index : int;  (** components first, by position *)
  from : int;
  upto : int;  (** the positions of its components: those from [from] on, below [upto] *)
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
  mutable word : int array;  (** by position: the word that holds the component *)
  mutable shift : int array;  (** its lowest bit there *)
  mutable mask : int array;  (** all bits of its width, at the right *)
  without : t option array;  (** memoised by {!Layouts}, by place: the layout without what stands there *)
  becoming : (int, t) Hashtbl.t;
  (** memoised by {!Layouts}, by place and serial number of a target: the layout after it *)
}

val create : number:int -> frame -> Component.family Component.tree list -> t
(** Not laid out yet. *)

val above : place -> int -> place
(** [above p n] is the nest that is [n] levels above [p]; [p] itself if [n] is 0. *)

val replaced : t -> place -> Component.family Component.tree list -> Component.family Component.tree list
(** [replaced l p trees] is the tree of [l] with [trees] at [p]. *)

val key : frame -> Component.family Component.tree list -> int list
(** [key f trees] is different for each layout. *)

val residual : t -> place -> (int -> Residual.t) -> Residual.t
(** [residual l p component] is the residual at [p], with [component i] at position [i]. *)

(** {1:words Words}

    The fields of the first word are, lowest bits first: the bits that are reserved for the search, the layout's number,
    and the number of the shared state. The components follow; none lies across the end of a word. Layout 0 stands for
    configurations that execute nothing: the rest of the first word is the configuration's number. *)

(** The bits of the fields of the first word, in this order. *)
type widths = { reserved : int; layout : int; shared : int }

val lay_out : widths -> t -> int
(** [lay_out widths l] computes the fields of [l] again, for the present widths of its families. The result is how
    many words it needs. *)

val local : t -> int array -> int -> int
(** [local l key i] is the number of the component at position [i] in its family, in a state of layout [l]. *)

val put : t -> int array -> int -> int -> unit
(** [put l key i n] writes [n] there; all its bits must be 0. *)
