(** The console of a mission on simulated IMC vehicles, killed at many points, and others that go on. *)

val run : int option -> (string, string) result
(** [run how_many] kills it before, in the middle of and after each line of the journal, resumed soon and late,
    some of those that go on being killed too; or at [how_many] of these points. A summary; the error's is of trials
    some of which went wrong, which standard error tells more of. *)
