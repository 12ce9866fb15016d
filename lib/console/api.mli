(** The requests of pages and programs, as [docs/api.md] and [docs/openapi.json] describe them. *)

val reply : Session.t -> Dolphin_http.Request.t -> Dolphin_http.Response.t Lwt.t
(** [reply h r] is the reply to [r], if {!Access} permits it. *)

val routes : (string * string) list
(** All methods and paths, for the test of the description: [("GET", "/api/status")]. *)
