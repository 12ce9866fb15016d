(** UDP ports that no other test on this machine has, whatever run of tests it belongs to. *)

val count : int
(** How many are leased at once: 640. *)

val lease : unit -> int
(** [lease ()] is the first of {!count} ports in a row, which are this process's until it ends; its children may use
    them. They are below those that systems give out by themselves. *)
