(** The head of an interface is the comment of its type [t]. *)

type t

val bare : t
val commented : t
(** A value. *)

(** Before it. *)
val before : t

val far : t

(** An empty line stands between. *)

type parts = { one : int;  (** a part *) other : int  (** another *) }
type part = { named : int;  (** a part *) unnamed : int }
type cases = One  (** a case *) | Other of int  (** another *)

type first
(** A type. *)

and second = First of first

exception Bare
exception Commented  (** when it is raised *)

module Other_name = String

module Inner : sig
  type t

  val bare : t
end
(** The comment of a module is that of its type [t]. *)

module type S = sig
  type t
end

module Make (_ : S) : sig
  type t

  val commented : t
  (** A value. *)
end
