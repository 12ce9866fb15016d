external memory : int -> unit = "dolphin_limit_memory"
external end_with_parent : unit -> unit = "dolphin_end_with_parent"
