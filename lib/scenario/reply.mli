(** A supplier's reply to the calls of a program, as a fleet file gives it: a value as a supplier can send it
    ({!Dolphin_json.Host_value}), or the reason why there is none. *)

open Dolphin_syntax
open Dolphin_semantics

type t = (Core.value, string) result

val read : Ast.expression -> (t list, Diagnostic.t) result
(** [read e] is the replies that [e] leaves the choice of, at least one: a value, [fails], [fails('why')], or
    [either(...)] of these. Values are literals, numbers with units, lists, maps and places as in programs,
    [object('queue')], [task('survey')], also spelt [imcPlan], [vehicles('x8-02', ...)]. Tasks are from
    {!Fault.unknown_site}. *)

val data : Ast.expression -> (Core.value list, Diagnostic.t) result
(** [data e] is the values that [e] leaves the choice of, at least one, for an input: as {!read}, but without tasks,
    objects and [fails]. *)

val equal : t -> t -> bool
(** Of replies that {!read} gives. *)

val pp : Format.formatter -> t list -> unit
(** As {!read} reads it. *)
