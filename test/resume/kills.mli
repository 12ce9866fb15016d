(** The console of a mission on simulated IMC vehicles, killed at many points, and others that go on. *)

val run : ?load:int -> ?is_losing:bool -> int option -> (string, string) result
(** [run ~load ~is_losing how_many] kills it before, in the middle of and after each line of the journal, resumed soon
    and late, some of those that go on being killed too; or at [how_many] of these points, again and again if there are
    fewer.
    With [~is_losing:true] (by default false) it is killed after each line, its journal loses the latest notes of
    requests, and no plan is started twice: the run may fail. Meanwhile [load] processes (0) do nothing but
    take time. A summary; the error's is of trials some of which failed; standard error has details. *)
