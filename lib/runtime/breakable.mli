(** Pure computations that a signal may break off: a step of the semantics has no bound on its time (an allocation of
    thousands of plans takes seconds, a hard one longer than anyone waits), and an interruption must not wait for it.

    Handlers of signals run where OCaml code allocates, and may raise there. Raising from a computation without effects
    loses its result only. *)

type t

val make : unit -> t
(** Nothing is computed, and nothing was broken off. *)

val attempt : t -> (unit -> 'a) -> 'a option
(** [attempt b f] is [Some (f ())], or [None] if {!break} broke it off: its request has then been carried out. [f] has
    no effects, catches no exceptions of others, and calls no [attempt]. *)

val break : t -> (unit -> unit) -> unit
(** [break b request], called in a handler of a signal, breaks off what [b] attempts: it does not return then, and
    [request ()] is carried out outside of the handler. Otherwise it does nothing. *)
