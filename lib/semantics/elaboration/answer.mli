(** Typed answers to [ask]. *)

val event : Core.program -> string -> (Transition.event, Transition.refusal) result
(** [event p text] is the event of the answer [text], an expression over the variables of [p]; [Error (Bad_answer
    why)] if it is not one. *)

val confirmation : string -> bool option
(** [confirmation text] is whether [text], as people type it, is yes ([yes], [y], [true]) or no ([no], [n], [false]). *)

val confirmation_of_value : Core.value -> bool option
(** [confirmation_of_value x] is whether [x] is yes or no: a truth value, or a text that is a {!confirmation}. *)
