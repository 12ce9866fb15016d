(** Fleets: the fleet of a program, and its contents. *)

type t = {
  path : string option;  (** [None]: the built-in fleet *)
  source : string;
  (** its text, followed by digests of its maps; [""] for the built-in fleet *)
  scenario : Dolphin_scenario.Scenario.t;
  warnings : Dolphin_syntax.Diagnostic.t list;  (** of the maps that it names *)
}

val choose : program:string -> string option -> string option
(** [choose ~program named] is the file of the fleet to use: [named] if there is one, else the file beside [program], if
    there is one. *)

val load : ?may_read:(string -> (unit, string) result) -> string option -> (t, Error.t) result
(** [load ~may_read path] is the fleet in the file [path], or with [None] the built-in one. [may_read] decides for
    each map that it names whether it may be read, by default all. *)

val load_for : program:string -> string option -> (t, Error.t) result
(** [load_for ~program named] is [load (choose ~program named)]. *)

val beginning : Dolphin_semantics.Calendar.t option -> t -> t
(** [beginning date f] is [f] in which runs begin at [date]. *)

val nobody : t
(** A fleet in which there is nothing. *)

val header : t -> Dolphin_trace.Header.source option
(** The fleet as journals name it: by its path and the digest of its text. *)
