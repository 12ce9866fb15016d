(** Requests for what can be found out about programs without running them. *)

open Dolphin_json
open Exchange

(** Each is of one subject; [docs/api.md] has the members of requests and replies. *)

val start : Hall.subject -> Hall.t -> Field.members -> (json, refusal) result
(** Begins an analysis in place of the one before; refused as ["busy"] while that goes on, and if an argument is not
    right. *)

val result : Hall.subject -> Hall.t -> Dolphin_http.Request.t -> (json, refusal) result
(** How it goes, or what was found; [null] if nothing was asked. *)

val cancel : Hall.subject -> Hall.t -> Field.members -> (json, refusal) result
(** Ends it, if it goes on. *)
