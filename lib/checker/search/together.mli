(** A search that goes on in several processes: all expand a level, and wait for each other before the next ([Team]). *)

(** The search of a system [S]. *)
module Make (S : System.S) : sig
  type state := Search_state.Make(S).t
  type shared := Search_state.Make(S).shared

  val is_possible : state -> bool
  (** Whether several processes may go on from here: there are as many states as that is worth, in memory that can be
      shared. *)

  val start : state -> unit
  (** [start t] lays the states out in memory that processes share. The states from [t.next] on are a level. Without
      memory for that the search stays one of a single process. *)

  val expand_all : state -> shared -> unit
  (** [expand_all t shared] expands all that is left, in [t.workers] processes that have ended when it has: [t] has
      what they found.
      @raise Limits.Stop where a bound is met, or a process ended early *)
end
