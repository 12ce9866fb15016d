(** The surroundings of a place in a text under way, which need not be a program yet: for completing it. *)

(** The owner of a name after a point. *)
type owner =
  | Nothing  (** Without a point. *)
  | Number  (** [2.km] *)
  | Named of string  (** [Location.APDL], [Speed.Units.RPM]: the names before the point *)
  | Value  (** of any other expression *)

type t = {
  prefix : string;  (** The part of a name that ends here; [""] if none does. *)
  owner : owner;
  builder : Ast.builder option;  (** The block of settings around, if it is the innermost brace. *)
  block : string option;  (** The name of the command whose block this is, as [vehicle] in [vehicle 'a', { ... }]. *)
  call : string option;  (** The name of the call or command whose arguments these are. *)
  text : bool;  (** Whether this is in a string. *)
  comment : bool;  (** Whether this is in a comment. *)
}

val at : string -> int -> t
(** [at source offset] is the surroundings of byte [offset] of [source]: only the text before it is read. *)

val assigned : string -> string list
(** [assigned source] is the names that [source] seems to give a value to or define, each once, in the order of the
    text. *)

val header : string -> string -> string option
(** [header source f] is how [source] seems to define the function [f]: ["f(x, y)"]. *)

val words : string list
(** The words of the language's constructs. *)

val is_name : string -> bool
(** [is_name x] is whether [x] is one name, and no word of a construct. *)
