(** An observer of the states that a search expands. Several processes each have a copy of it, from a fork on. *)
type t = {
  see : int -> unit;  (** is called with a state's number before it is expanded *)
  told : unit -> string;  (** its findings in a worker *)
  hear : first:(int -> int -> int) -> string -> unit;
  (** adds the findings that another has {!told}; [first i j] is that of the states [i] and [j] to which fewer
      transitions lead, or the other one if one of them is -1 *)
}
