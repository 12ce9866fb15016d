(** A search along random walks, in place of all states. *)

(** Walks of a system [S]. *)
module Make (S : System.S) : sig
  type state := Search_state.Make(S).t

  val run : state -> Sample.t -> walks:int -> look:(int -> unit) -> enough:(unit -> bool) -> unit
  (** [run t sample ~walks ~look ~enough] is as {!Breadth_first.Make.run_walks}.
      @raise Limits.Stop unless all states have been expanded *)
end
