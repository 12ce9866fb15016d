(** Configurations as JSON that another program can keep: their contents in readable form, and all of it as data from
    which {!of_json} restores the configuration. Equal configurations have the same JSON. *)

open Dolphin_semantics

val to_json : Core.program -> Configuration.t -> (Yojson.Safe.t, string) result
(** [to_json p c] is [c]: [control], [end], [A], [B], [N] and [store] in the clear, and [state]. An error if it is too
    large to be written, as a task is that a loop doubles again and again. *)

val of_json : Nodes.t -> Core.program -> Yojson.Safe.t -> (Configuration.t, string) result
(** [of_json nodes p json] is the configuration of [p] that [json] is: only its [state] is read. The error is a
    sentence without a full stop. *)

(** {1:data As data alone} *)

val of_state : Data.budget -> Configuration.t -> Data.json
(** The member [state]. @raise Data.Too_large, as {!of_shared} does. *)

val state : Nodes.t -> Core.program -> Data.json -> Configuration.t
(** @raise Data.Wrong, as {!shared} does. *)

val of_shared : Data.budget -> Shared.t -> Data.json list
(** @raise Data.Too_large as {!of_state} does. *)

val shared : Nodes.t -> Core.program -> Data.json list -> Shared.t
(** @raise Data.Wrong if the program has no such shared part. *)
