(** CRC-16/ARC: polynomial [x^16 + x^15 + x^2 + 1], bits reflected, initial value 0.

    Source: IMC, packet footer; the catalogue of parametrised CRC algorithms gives the check value
    [arc "123456789" ~pos:0 ~len:9 = 0xBB3D]. *)

val arc : string -> pos:int -> len:int -> int
(** [arc s ~pos ~len] is the checksum of the [len] bytes of [s] from [pos], in [0 .. 0xFFFF].
    @raise Invalid_argument if [s] has no such bytes. *)
