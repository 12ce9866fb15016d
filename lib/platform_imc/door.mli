(** Texts of messages as they enter: from here on they are UTF-8 without control characters, fit for terminals, journals
    and exports. *)

open Dolphin_imc

val content : Packet.content -> Packet.content
(** [content c] is [c] with U+FFFD in place of each control character, and each byte that is not UTF-8, of names of
    systems, entities, parameters and plans, of replies, errors, and entries of log books; other texts are not read. *)

val is_plain : string -> bool
(** Whether a text is as they are: the plan of another name would not be recognised in the vehicle's reports. *)
