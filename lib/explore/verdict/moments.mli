(** Nodes of a graph together with moments: with what was looked at since time has passed. Those of a component whose
    looks do not agree are searched in place of its nodes, as no time passes between looks that contradict each
    other. *)

type t
(** Nodes with moments, of several components. *)

type component
(** A component of the graph. *)

val create : unit -> t
(** [create ()] has none yet. *)

val component : Looks.concerns -> component
(** [component c] is a new component, whose moments keep what [c] concerns. *)

val number : t -> component -> int -> Looks.moment -> int
(** [number ms c i m] is the number, below 0, of the node [i] of [c] with the moment [m]. *)

(** A node with its moment. *)
type node = { component : component; i : int; moment : Looks.moment }

val find : t -> int -> node
(** [find ms n] is the node with the number [n].
    @raise Not_found if there is none *)

val after : component -> time:bool -> Looks.moment -> Looks.t -> Looks.moment list
(** [after c ~time m looks] is the moments after a step with [looks] at [m], [time] being whether time may pass before
    it: {!Looks.after}. *)

val count : component -> int
(** How many nodes with moments it has until now. *)
