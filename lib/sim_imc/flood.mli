(** The telemetry of sensors and control, which a console does not use: the traffic of a vehicle beside the streams
    of {!Vehicle_node}, about 700 datagrams a second, in the proportions in which they were recorded. *)

val content : int -> int * Dolphin_imc.Packet.content
(** [content n] is the entity and the content of the [n]-th datagram: over 64 in a row, half of them
    message 281 with 5 bytes, an eighth each 254, 256, 257, which have 32 to 40, the rest EntityState of one entity
    after another. *)
