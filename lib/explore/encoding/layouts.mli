(** The shapes of a state space, numbered, all laid out alike: with so many bits for a shape's number and for that of
    what is shared, and so many words. *)

(** Some number does not fit its field: all must be laid out anew, by {!widened}. *)
exception Outgrown

type t

val create : ?watched:int -> Components.t -> t
(** With so many bits for what a {!Product} knows: none by default. *)

val count : t -> int

val words : t -> int
(** Words of a state. *)

val widths : t -> Layout.widths

(** {1:reading First words} *)

val number : t -> int -> int
(** [number t w] is the number of the shape of a state that starts with [w]; 0 is none. *)

val shared : t -> int -> int
(** [shared t w] is the number above it: of what is shared, or of a configuration that executes nothing. *)

val first : t -> int -> int -> int
(** [first t number shared] is the word that starts with these. *)

val watched : t -> int -> int
(** [watched t w] is what a {!Product} knows. *)

val watching : t -> int -> int -> int
(** [watching t w n] is [w] with [n] for that.
    @raise Outgrown *)

val shape : t -> int -> Layout.t
(** [shape t n] is the shape with number [n], from 1. *)

(** {1:shapes Shapes} *)

val find : t -> Layout.frame -> Component.family Component.tree list -> Layout.t
(** [find t f trees] is the shape with frame [f] and parts of these families. *)

val without : t -> Layout.t -> Layout.place -> Layout.t
(** [without t s p] is [s] without what stands at [p]. *)

val becoming : t -> Layout.t -> Layout.place -> int -> Component.part Component.tree list -> Layout.t
(** [becoming t s p serial children] is [s] with [children], the ones of the target with this serial number, for what
    stands at [p]. *)

val with_children : t -> Layout.t -> Layout.place -> Component.part Component.tree list -> Layout.t
(** As {!becoming}, of any children. *)

(** {1:fields Fields} *)

val fits : t -> shared:int -> bool
(** [fits t ~shared] is whether all numbers fit their fields, those of what is shared being below [shared]. *)

val widened : t -> watched:int -> shared:int -> int array -> int array -> unit
(** [widened t ~watched ~shared] makes all fields as wide as they need be, for numbers below [watched] and [shared];
    [widened t ~watched ~shared old fresh] then puts the state that was [old] into [fresh], which is all 0. *)
