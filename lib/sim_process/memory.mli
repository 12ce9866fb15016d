(** A file in which a simulated fleet outlives the process that simulates it: its beginning, and its orders. All that
    became of it follows. *)

type t

val open_ : string -> (t * float * (float * Dolphin_platform_protocol.Order.t) list, string) result
(** [open_ path] is the file, the date when its fleet began, and its orders, with the fleet's time. A file that does
    not exist begins now. *)

val add : t -> time:float -> Dolphin_platform_protocol.Order.t -> unit
(** When it returns, the order survives this process. *)
