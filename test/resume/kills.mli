(** The console of a mission on simulated IMC vehicles, killed at many points, and others that go on. *)

val run : ?load:int -> int option -> (string, string) result
(** [run ~load how_many] kills it before, in the middle of and after each line of the journal, resumed soon and late,
    some of those that go on being killed too; or at [how_many] of these points, again and again if there are fewer.
    Meanwhile [load] processes (0) do nothing but take time. A summary; the error's is of trials some of which
    failed; standard error has details. *)
