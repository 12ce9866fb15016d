(** A file of words of 8 bytes, without a name: it is gone when the process is. *)

type t

exception Failed of string
(** The system refused to write, to read or to make the file, for this reason. *)

val create : directory:string -> t
(** @raise Failed as the others do *)

val append : t -> int -> unit
(** [append f x] appends the word [x]. *)

val read : t -> at:int -> Bytes.t -> words:int -> unit
(** [read f ~at b ~words] reads [words] words, from the one at place [at] on. *)

val close : t -> unit
(** Closes the file, which is gone then. *)
