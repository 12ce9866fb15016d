(** The interface of the generated module [Message]: types and their documentation. *)

val code : Outline.t -> Code.t list
(** The text of [message.mli]. *)
