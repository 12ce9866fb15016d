(** Reasons to end a run early: Ctrl-C, a button of a console, or any other request. *)

type t

val make : unit -> t
(** [make ()] has not happened. *)

val interrupt : t -> unit
(** [interrupt i] makes [i] happen. Once it has, this does nothing. *)

val once_more : t -> unit
(** [once_more i] makes [i] happen; if it has happened, a second time. *)

val promise : t -> unit Lwt.t
(** [promise i] resolves when [i] happens. *)

val again : t -> unit Lwt.t
(** [again i] resolves when [i] happens a second time. *)

val breakable : t -> Dolphin_runtime.Breakable.t
(** [breakable i] is what the signals of {!on_signals} break off. *)

val happened : t -> bool
(** Whether it has happened. *)

val unless : t -> (unit -> 'a Lwt.t) -> 'a option Lwt.t
(** [unless i f] is the result of [f ()]. If [i] happens before, [f ()] is cancelled: [None], once it has cleared up. *)

val unasked : t -> (unit -> unit) -> unit
(** [unasked i interrupt] is [interrupt ()], which interrupts a program that is stuck: no person asked for it. *)

val is_unasked : t -> bool
(** Whether this is within a call of {!unasked}. *)

val on_signals : ?goes_on:(unit -> bool) -> ?again:(unit -> 'a) -> t -> unit
(** From now on SIGINT, SIGTERM, SIGQUIT and SIGHUP make it happen. If it has happened already and [goes_on ()], which
    by default is false, they make it happen a second time. Otherwise they call [again], which need not return, straight
    from the signal's handler; by default nothing. Under nohup SIGHUP stays ignored.
    {!Dolphin_processes.Ending_signals.others} make it happen too, once. *)
