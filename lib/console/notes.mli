(** Notes of people on moments of a run, in a file beside its journal: [mission.notes] beside [mission.run]. The journal
    itself never has any. *)

open Exchange

val beside : string -> string
(** [beside journal] is the path of the notes on the run of [journal]. *)

val list : Workspace.t -> Dolphin_http.Request.t -> (json, refusal) result
(** [GET notes]: the notes on a journal that the query names as [GET replay] does, in the order in which they were
    written; lines that are not notes are left out. *)

val add : Workspace.t -> Dolphin_json.Field.members -> (json, refusal) result
(** [POST notes]: one more, at the end of the file. The journal is named by [run] or [path], the operator by [by]. *)
