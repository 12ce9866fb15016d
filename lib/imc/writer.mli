(** Writes the fields of one payload. The counterpart of {!Reader}.

    [field] names the field in the error, should the value not fit. *)

type t

exception Fault of Error.encode
(** The value that cannot be written, and its field. *)

val make : Byte_order.t -> Buffer.t -> t
(** [make order b] appends to [b]. *)

(** {1:numbers Numbers} *)

val u8 : t -> string -> int -> unit
(** [u8 w field n].
    @raise Fault with {!Error.Out_of_range} unless [0 <= n <= 255]; the others in the same way. *)

val u16 : t -> string -> int -> unit
(** [u16 w field n], with [0 <= n < 2^16]. *)

val u32 : t -> string -> int -> unit
(** [u32 w field n], with [0 <= n < 2^32]. *)

val i8 : t -> string -> int -> unit
(** [i8 w field n], with [-2^7 <= n < 2^7]. *)

val i16 : t -> string -> int -> unit
(** [i16 w field n], with [-2^15 <= n < 2^15]. *)

val i32 : t -> string -> int -> unit
(** [i32 w field n], with [-2^31 <= n < 2^31]. *)

val i64 : t -> int64 -> unit
(** Any number fits. *)

val f32 : t -> float -> unit
(** Rounds to the nearest [f32]; beyond the greatest one, to infinity. *)

val f64 : t -> float -> unit
(** Bit by bit. *)

val text : t -> string -> string -> unit
(** [text w field s] is the length of [s] in a [u16], and its bytes.
    @raise Fault with {!Error.Too_long}. *)

(** {1:messages Messages} [write w m] writes the id and the fields of [m]. *)

val inline : t -> string -> (t -> 'a -> unit) -> 'a option -> unit
(** [inline w field write m]. [None] is the id 65535.
    @raise Fault with {!Error.Nested_too_deep}. *)

val list : t -> string -> (t -> 'a -> unit) -> 'a list -> unit
(** [list w field write ms] is the number of [ms] in a [u16], and each of them.
    @raise Fault with {!Error.Too_long}, {!Error.Nested_too_deep}. *)

val tagged : int -> (t -> 'a -> unit) -> t -> 'a -> unit
(** [tagged id write w m] is [id], then the fields that [write] writes. *)
