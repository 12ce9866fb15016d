(** The layouts of a state space, numbered, with equal widths of the fields that all have, and equally many words. *)

exception Outgrown
(** Some number does not fit its field: {!widen} must be called. *)

type t

val create : ?spare_bits:int -> Components.t -> t
(** [create ?spare_bits c] is empty. [spare_bits], 8 by default, are added to the fields that all layouts have, or
    fewer: only as many as fit without more words per state. *)

val words : t -> int
(** Words of a state. *)

(** {1:reading First words} *)

val number : t -> int -> int
(** [number t w] is the number of the layout of a state with first word [w]; no layout has number 0. *)

val shared : t -> int -> int
(** [shared t w] is the number in the next field: of the shared state, or of a configuration that executes nothing. *)

val first : t -> int -> int -> int
(** [first t number shared] is the first word with these, and 0 in all other bits. *)

val layout : t -> int -> Layout.t
(** [layout t n] is the layout with number [n], from 1. *)

(** {1:layouts Layouts} *)

val find : t -> Layout.frame -> Component.family Component.tree list -> Layout.t
(** [find t f trees] is the layout with frame [f] and components of these families.
    @raise Outgrown if it is new, and needs more words than there are. *)

val without : t -> Layout.t -> Layout.place -> Layout.t
(** [without t l p] is [l] without what stands at [p]. *)

val becoming : t -> Layout.t -> Layout.place -> int -> Component.component Component.tree list -> Layout.t
(** [becoming t l p serial children] is [l] with [children], those of the target with this serial number, at [p]. *)

val with_children : t -> Layout.t -> Layout.place -> Component.component Component.tree list -> Layout.t
(** As {!becoming}, with any children. *)

(** {1:fields Fields} *)

val fits : t -> shared:int -> bool
(** [fits t ~shared] is whether all numbers fit their fields, those of shared states being below [shared]. *)

val widen : t -> reserved:int -> shared:int -> int array -> int array -> unit
(** [widen t ~reserved ~shared] makes all fields at least as wide as they need be, for shared states with numbers
    below [shared], and reserves that many bits. [widen t ~reserved ~shared old fresh] then puts the state that was
    [old] into [fresh], which is all 0; the reserved bits are left out. *)
