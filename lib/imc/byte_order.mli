(** The order of the bytes of numbers. In IMC the sender chooses it, packet by packet. *)

type t =
  | Little_endian  (** A packet that begins [54 FE]: the order of vehicles, and of Dolphin. *)
  | Big_endian  (** A packet that begins [FE 54]. *)

val pp : Format.formatter -> t -> unit
(** ["little-endian"] or ["big-endian"]. *)
