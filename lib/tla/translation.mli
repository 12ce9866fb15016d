(** Programs as tables of TLA+. Every expression and every closure has a number; expressions refer to their parts by
    number. Code that [spec/DolphinMachine.tla] cannot run is refused, with its place in the program. *)

open Dolphin_semantics

type t
(** Mutable: the translation so far. *)

val create : Core.program -> World.t -> t
(** [create p w] has translated nothing of [p], which runs in [w]. *)

val lambda : t -> Core.lambda -> int
(** [lambda t l] is the number of [l], with all that it contains translated. *)

val reply : t -> at:Tla.t -> Core.value -> Tla.t
(** [reply t ~at x] is [x] as a host replies it; its tasks are made at the expression whose number [at] is. Refusals
    have no place. *)

val place : t -> Dolphin_geo.Position.t -> int
(** [place t p] is the number of the position [p]. *)

val reads_position : t -> bool
(** Whether any code that has been translated looks at a position. *)

val sensors : t -> Core.sensor list
(** The other sensors that it looks at. *)

val name_of_sensor : Core.sensor -> string
(** Their names in the models, each another. *)

val refusals : t -> Dolphin_syntax.Diagnostic.t list
(** The parts that cannot be translated, in the order of the text. *)

(** {1:tables The tables} *)

val code : t -> (Tla.t * Dolphin_syntax.Location.t option) list
(** The expressions, each with its place in the program. *)

val lambdas : t -> (Tla.t * Dolphin_syntax.Location.t option) list
(** The lambdas in the order of their numbers, each with its place in the program. *)

val lambda_names : t -> Tla.t
(** The labels of the lambdas, in the order of their numbers. *)

val plans : t -> Tla.t
(** The plans that tasks of the program name. *)

val places : t -> Tla.t
(** The positions that matter ({!Places}). *)

val distances : t -> Tla.t
(** The distances between them. *)
