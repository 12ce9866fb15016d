(** The recorded life of a vehicle. *)

type line = { time : float;  (** s *) inward : bool;  (** from the vehicle *) bytes : string }

val console : int
(** The IMC address of the console that was recorded. *)

val vehicle : string
(** The name of the vehicle. *)

val lines : line list Lazy.t
(** All datagrams, in order. *)

val fleet : line list Lazy.t
(** The datagrams of four vehicles that execute [examples/rendezvous.dol]. *)

val message : line -> Dolphin_imc.Message.t
(** @raise Failure if it is broken. *)
