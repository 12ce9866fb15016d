(** The kit that judges adapters: [dolphin platform check]. Each situation starts the adapter again. *)

type plans = Situations.plans = {
  short : string;  (** a plan, by name, that a vehicle runs to its end within {!field-patience} *)
  long : string;  (** one that lasts longer than all situations together *)
  vehicle : string option;  (** only this vehicle; otherwise the first one that is ready *)
  patience : float;  (** seconds that an answer may take *)
}

(** The verdict on an adapter in one situation. *)
type verdict = {
  name : string;
  what : string;  (** the required behaviour *)
  wrong : string option;  (** [None]: it did *)
  remark : string option;
  transcript : string list;  (** the last lines of the conversation, if something is wrong *)
  seconds : float;
}

val names : (string * string) list
(** The situations, and the required behaviour of adapters in them. *)

val judge :
  plans -> only:string list -> goes_on:(unit -> bool) -> (verdict -> unit) -> string -> verdict list Lwt.t
(** [judge plans ~only ~goes_on tell command] puts the adapter [command] into each situation, or those named [only],
    one after the other; [tell] gets each verdict at once. It may be cancelled, once [goes_on ()] has become false:
    the adapter is ended, the situation that it was in has no verdict, and no other begins. *)

val to_junit : command:string -> verdict list -> string
(** The verdicts as JUnit's XML. *)
