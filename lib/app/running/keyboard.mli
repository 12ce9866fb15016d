(** The lines typed at the terminal of a run: the answers to its questions, and all others. *)

type t

val start : other:(string -> unit) -> t
(** [start ~other] reads standard input from now on; [other] gets each line that answers no question. *)

val settle : t -> unit
(** [settle k] hands what has been typed so far to [other]: before a question is shown, which it cannot answer. A line
    that was begun is forgotten. *)

val answer : t -> (string, string) result Lwt.t
(** [answer k] is the next line that is typed, or the reason why there is none. It may be cancelled. *)
