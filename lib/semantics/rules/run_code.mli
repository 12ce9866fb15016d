(** Code of tasks and of the script in a shared part: the judgement [S ⊢ code ⇓ ...] of docs/semantics.md. *)

open Core

(** The end of a piece of code. *)
type outcome =
  | Gives of value * Shared.t * Code.deed list  (** the deeds of the code, first deed first *)
  | Faulty of Fault.t * Code.deed list  (** its messages before; all its other deeds are undone *)
  | Halts of string * Shared.t * Code.deed list

(** The outcome of a piece of code, with the world and the mode that it leaves. *)
type result = {
  world : World.t;  (** with its assumptions *)
  outcome : outcome;
  mode : Code.mode;  (** a handler's has its verdict *)
}

val atomic :
  ?held:vehicle list Lazy.t -> ?given:value list -> program -> World.t -> Shared.t -> closure -> result Decision.t
(** [atomic ~held ~given p w s code] runs [code] of a task to its end, with arguments [given], none by default. The
    vehicles [held] are held from its place; by default, none. *)

val handler :
  held:vehicle list Lazy.t -> needed:vehicle list Lazy.t -> program -> World.t -> Shared.t -> closure -> Fault.t ->
  result Decision.t
(** [handler ~held ~needed p w s code fault] runs the [onError] code [code] for [fault]. It may not dismiss the vehicles
    [needed]. *)

val context :
  ?held:vehicle list Lazy.t -> ?needed:vehicle list Lazy.t -> program -> World.t -> Shared.t -> Code.mode ->
  Code.context
(** The part of a shared part that the machine sees. *)

val after : Code.context -> Shared.t -> Shared.t
(** [after x s] is [s] with the store, B and N that [x] holds. *)

val kept : program -> World.t -> Shared.t -> Shared.t
(** [kept p w s] is [s] once the step that ran the code is over: in an open world, its readings are known by the
    variables that hold them ({!Reading.keep}). *)

val said : Code.deed list -> Code.deed list
(** The messages among these deeds: messages stay, also of undone code. *)

val effects : Code.deed list -> Effect.t list
(** The requests of these deeds to the outside. *)
