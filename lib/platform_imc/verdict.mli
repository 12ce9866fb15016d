(** The meaning of a vehicle's report on its plan for a request of ours: the rules of {!Execution}, as functions of
    the knowledge. *)

type t =
  | Nothing_new
  | Initialises  (** The vehicle is about to begin a plan, perhaps ours. *)
  | No_sign  (** Nothing shows that the request took effect. *)
  | Runs
  | Succeeded
  | Ended of string  (** It did not succeed, for that reason, unless the vehicle gives a better one. *)
  | Replaced of string  (** The vehicle executes, or has executed, that plan. *)

val of_start :
  now:float -> former_ended:float -> late:string option -> Attempt.t -> Plan_report.t -> t
(** [of_start ~now ~former_ended ~late a r] is the meaning of [r], the latest report, at [now] (s, our clock) while
    it is open whether the vehicle has taken the request [a]. While [a] is not answered and may still take effect, it
    has neither [Ended] nor is it [Replaced]: another console may have commanded the vehicle before our request
    arrives, which then takes the vehicle from that console. But [late] is our own last plan, while a copy of its
    request may still arrive: if it runs again, [a] is [Replaced] at once. [former_ended] is when, by the vehicle's
    clock (s), our last plan of the same name ended; [neg_infinity] without one. *)

val of_run : since:float -> Attempt.t -> Plan_report.t -> t
(** [of_run ~since a r] is the meaning of [r] after the vehicle was seen to run the plan of [a] at [since] by its
    clock (s). *)

val refused : string
(** The reason of a request that the vehicle refuses without one. *)

val blocked : string
(** Reasons where the vehicle gives none. *)
