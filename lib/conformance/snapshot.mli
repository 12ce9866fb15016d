(** Configurations as JSON that another program can hold on to: what is in them in the clear, for it to look at, and the
    whole of it as data, for us to go on from. Equal configurations are the same JSON. *)

open Dolphin_semantics

val to_json : Core.program -> Configuration.t -> (Yojson.Safe.t, string) result
(** [to_json p c] is [c]: [control], [end], [A], [B], [N] and [store] in the clear, and [state]. An error if it is too
    large to be written, as a task is that a loop doubles again and again. *)

val of_json : Nodes.t -> Core.program -> Yojson.Safe.t -> (Configuration.t, string) result
(** [of_json nodes p json] is the configuration of [p] that [json] is: only its [state] is looked at. The error says
    what is wrong, in a sentence without a full stop. *)
