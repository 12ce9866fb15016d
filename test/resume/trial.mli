(** One console that dies, and others that go on. *)

type t = {
  death : Console.death;
  again : Console.death;  (** of the next console *)
  pause : float;  (** before it, s *)
  lost : int;  (** The latest notes of requests that the journal loses when a console dies. *)
}

val pp : Format.formatter -> t -> unit

val run : t -> ports:int -> number:int -> (unit, string) result
(** [run t ~ports ~number] has the mission run to its end, by as many consoles as that takes. It is right if each
    plan was started once, by the vehicles' own log, the mission was completed, and the joined journal belongs to a
    run. The error has the fault, and the folder with its explanation (in [DOLPHIN_KEPT], or among temporary files):
    the journal as each console left it, all datagrams of the consoles, the activities of the vehicles. Trials of
    other numbers, at most 40 in a row, can run at the same time. [ports] is the result of
    {!Test_support.Ports.lease}. *)

val lines : ports:int -> int
(** The number of lines of a journal that count when no console dies. *)
