(** A file in which a simulated fleet outlives the process that simulates it: when it began, and what it was ordered.
    All that became of it follows. *)

type t

val open_ : string -> (t * float * (float * Dolphin_platform_protocol.Order.t) list, string) result
(** [open_ path] is the file, the date when its fleet began, and what that was ordered, with the fleet's time. A file
    that does not exist begins now. *)

val add : t -> time:float -> Dolphin_platform_protocol.Order.t -> unit
(** When it returns, the order survives this process. *)
