(** Requests for analyses of programs. *)

open Dolphin_json
open Exchange

(** Each is of one subject; [docs/api.md] has the members of requests and replies. *)

val not_busy : Analysis.subject -> Session.t -> (unit, refusal) result
(** Refused as ["busy"] while an analysis of this subject goes on. *)

val start : Analysis.subject -> Session.t -> Field.members -> (json, refusal) result
(** [start subject h found] begins the analysis that {!Analysis_work.prepare} has made of the request, [found], in place
    of the one before; refused as ["busy"] while that goes on. *)

val result : Analysis.subject -> Session.t -> Dolphin_http.Response.t
(** The progress or the result of the analysis; [null] if there was no request. *)

val cancel : Analysis.subject -> Session.t -> (json, refusal) result
(** Ends it, if it goes on. *)
