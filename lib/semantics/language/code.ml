(* The surroundings, effects and requests of pieces of code: the types that the machine and its operations share. A
   types-only module: it has no interface of its own. [Machine] runs code. *)

open Core

(** {1 What code sees and does} *)

(** The visible deeds of code. *)
type deed =
  | Posted of (string * value) list
  | Consumed of (string * value) list
  | Said of string
  | Released of vehicle list                    (* those that were bound; by [dismiss] too *)
  | Set_connection_timeout of vehicle list option * float  (* for these vehicles, or for all; seconds *)

(** How an error handler settles the error: [ignore()], [retry()], or [propagate()], which is the default. *)
type verdict = Ignored | Propagated | Retried

type mode =
  | Script                                      (* stops after every deed and may wait *)
  | Task_code                                   (* guards, conditions, actions: atomic, may not wait *)
  | Handler of verdict                          (* [onError] code: as task code, and gives a verdict *)

(** The state that code sees and changes. *)
type context = {
  program : program;
  world : World.t;
  allocation : platform_task Vehicle_map.t;     (* A *)
  bound : vehicle list;                         (* B, in pick order *)
  held : vehicle list Lazy.t;                   (* the vehicles held from the place of the code *)
  needed : vehicle list Lazy.t;                 (* the vehicles needed outside of the [watch] of a handler *)
  store : Store.t;
  tuples : Tuples.t;                            (* N *)
  mode : mode;
  deeds : deed list;                            (* latest first *)
}

(** The events that the script waits for. *)
type request =
  | Pick of Settings.pick
  | Ask of string
  | Pause of float                              (* seconds *)
  | Execute of task
  | Host_call of { subject : string option; member : string; arguments : value list option }
  (* a method of a host object, or with [None] a property; without subject, a procedure of the host itself *)

(** {1 Operations} *)

(** The use of the results by a method that calls a closure for each item. *)
type iteration =
  | Each | Collect | Find_all | Find | Any | Every | Count | Sum | Inject | Sort | Greatest | Least

(** The result of an operation whose arguments are values. *)
type outcome =
  | Value of value
  | Done of deed * context * value  (* the deed, which is not among those of the context yet *)
  | Judged of verdict  (* a handler's *)
  | Enter of closure * value list
  | Walk of iteration * closure * value * value list  (* subject; initial results *)
  | Wait of request
  | Stop of string
  | Leave_off  (* the task of [onInterrupt] is over *)
  | Wrong of string  (* a fault of this very operation *)
  | Wrong_at of Fault.t
  | Refuted of string  (* an assertion does not hold *)
  | Asks of World.question * (World.t -> outcome)  (* depends on something that the world leaves open *)
  | Unclear of Fault.t
