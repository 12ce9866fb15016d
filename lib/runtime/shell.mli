(** The shell of a platform with a pure state: the receivers that wait for its events, and the time of the next look
    at it. The state is the platform's own. *)

type t

val make : unit -> t
(** No receiver waits, and nothing is due. *)

val settle : t -> has_event:bool -> quiet:(unit -> bool) -> due:float -> unit
(** [settle s ~has_event ~quiet ~due] is called after changes of the state. A receiver that waits for an event goes
    on if there is one, and one that waits for all to be quiet if it is. [due] is when the state is to be looked at
    next, by the clock of {!watch}. *)

val watch : t -> now:(unit -> float) -> due:(unit -> float) -> tick:(now:float -> unit) -> unit Lwt.t
(** [watch s ~now ~due ~tick] calls [tick ~now] whenever [due ()] has come, in seconds by [now], until [s] is closed. *)

val next : t -> (unit -> 'event option) -> 'event Lwt.t
(** [next s take] is the next event that [take ()] gives, when there is one. Once the platform has failed and no event
    is left, it fails with that error. It may be cancelled. *)

val until_quiet : t -> unit Lwt.t
(** Resolves when {!settle} next finds all quiet. *)

val fail : t -> exn -> unit
(** [fail s error] goes to the receiver of the next event: nothing can be kept any more, for example. The first error
    counts; after {!close} none. Vehicles are served all the same, so that stops are seen through. *)

val is_closed : t -> bool
(** Whether {!close} was called. *)

val close : t -> unit
(** Ends {!watch}. *)
