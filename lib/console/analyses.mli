(** Requests for what can be found out about programs without running them. *)

open Dolphin_json
open Exchange

val start : Hall.subject -> Hall.t -> Field.members -> (json, refusal) result
val result : Hall.subject -> Hall.t -> Dolphin_http.Request.t -> (json, refusal) result
val cancel : Hall.subject -> Hall.t -> Field.members -> (json, refusal) result
