(** The implementation of the generated module [Message]: reading, writing, JSON. *)

val code : Outline.t -> Code.t list
(** The text of [message.ml]. *)
