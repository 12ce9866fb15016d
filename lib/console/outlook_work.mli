(** What may still happen in a run, computed from its journal: a worker's part of {!Outlook}. *)

open Dolphin_json
open Exchange

val order : program:Dolphin_app.Program_file.t -> journal:string -> json
(** The request: the journal, and the path and digest of the program. *)

val compute : Workspace.t -> Field.members -> (json, refusal) result
(** [compute w order] has the present of the run ([from]: [time], [transitions]), the times at which it may be [over]
    ([earliest], [latest] in seconds since its start, [latest] is [null] if there is no bound; [null] if no run ends),
    the tasks that run with the times at which they will be over ([running]: [vehicle], [plan], [earliest], [latest]),
    the names of the properties of {!Dolphin_explore.Property} that a run from here violates ([violated]), those that
    are violated only if plans fail or links are lost ([by_faults]), and whether all runs were looked at ([complete]).
    Refused if the run is over, or the program has changed since it began. *)
