(** One console that dies, and others that go on. *)

type t = {
  death : Console.death;
  again : Console.death;  (** of the next console *)
  pause : float;  (** before it, s *)
}

val pp : Format.formatter -> t -> unit

val run : t -> ports:int -> number:int -> (unit, string) result
(** [run t ~ports ~number] has the mission run to its end, by as many consoles as that takes. It is right if each plan
    was started once, as the vehicles' own log tells, the mission was completed, and the joined journal is one of a
    run. The error says what is wrong, and in which folder that is kept which explains it (in [DOLPHIN_KEPT], or where
    temporary files are): the journal as each console left it, all datagrams of the consoles, what the vehicles did.
    Trials of other numbers, at most 40 in a row, can run at the same time. [ports] is what
    {!Test_support.Ports.lease} gives. *)

val lines : ports:int -> int
(** How many lines of a journal count when nobody dies. *)
