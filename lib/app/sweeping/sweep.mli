(** One question for several values of a parameter of a program: [--set n=1..8]. *)

(** The question. *)
type t = { parameter : string; values : int list; load : int -> (Program_file.t, Error.t) result }

(** One program, or one for each value. *)
type question = One of Program_file.t | Several of t

val question : set:(string * string) list -> string -> (question, Error.t) result
(** [question ~set path] is the program in the file [path] with its parameters [set], of which one may have a range of
    values ({!Dolphin_syntax.Parameters.range}). *)

val within : Fleet_file.t -> question -> (question, Error.t) result
(** [within fleet q] is the same of {!Program_file.within} that fleet. *)

(** The answer to one question. *)
type verdict = Dolphin_checker.Verdict.t = Holds | Violated | Inconclusive

(** The answer for a value. *)
type 'a row = { value : int; program : Program_file.t; found : 'a; verdict : verdict }

val rows :
  t -> interrupted:(unit -> bool) -> (Program_file.t -> ('a * verdict, Error.t) result) ->
  ('a row list, Error.t) result
(** [rows s ~interrupted ask] is the answers of [ask] for each value, in their order, up to the first one at which
    [interrupted ()], if any. *)

(** The least value for which all holds. *)
type 'a fewest = {
  row : 'a row;
  below : 'a row option;  (** the next one below, if there was any *)
  is_least : bool;  (** whether it is known of all below that they do not hold *)
}

val fewest : 'a row list -> 'a fewest option
(** [fewest rows] is the least value that holds; [None] if none does. *)

val verdict : 'a row list -> verdict
(** [Holds] if the {!fewest} is known; [Violated] if none holds; else [Inconclusive]. *)

(** {1:report Output} *)

val name : t -> 'a row -> string
(** ["n=3"]. *)

val print : t -> heads:string list -> ('a row -> string list) -> 'a row list -> unit
(** [print s ~heads cells rows] is a table with the value, [cells], and the verdict; and below it the fewest. *)

val to_json : t -> ('a row -> Yojson.Safe.t) -> 'a row list -> Yojson.Safe.t
(** [to_json s found rows] is the answers for programs: the fewest, and for each value its verdict and [found row]. *)
