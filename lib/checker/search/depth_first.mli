(** Search depth first, by bitstate hashing: a state is marked when its turn comes, and then expanded, so it is on the
    path when a cycle comes back to it. Only runs that are shown are kept. *)

(** The search of a system [S], from a search state without workers. *)
module Make (S : System.S) : sig
  type state := Search_state.Make(S).t

  val run : state -> bytes:int -> look:(int -> unit) -> enough:(unit -> bool) -> unit
  (** [run t ~bytes ~look ~enough] is as {!Breadth_first.Make.run_bitstate}.
      @raise Limits.Stop always: it never knows that it has seen all *)

  val here : int
  (** As {!Breadth_first.Make.here}. *)

  val keep : state -> int -> int
  (** As {!Breadth_first.Make.keep}. *)
end
