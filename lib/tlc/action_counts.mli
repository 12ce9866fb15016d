(** The output of TLC's option [-coverage] about the actions of a specification. *)

type count = {
  action : string;  (** the name of its definition *)
  found : int;  (** how many states TLC found first by it *)
  taken : int;  (** how often it took the action, to whatever state *)
}

val of_message : Message.t -> count option
(** [of_message m] is the count in [m], if it counts an action. Once a minute and at its end TLC prints its counts so
    far, so the last count of an action is the whole. *)
