(** Messages read by a definition that is known only at run time, for display.

    The functions of {!Message} for any message, slower and without types: with a user's [IMC.xml], {!Packet.Unknown}
    becomes readable.

    {[
      open Dolphin_imc

      (* A message as in a user's IMC.xml, which no typed message has. *)
      let definition =
        let depth = { Definition.name = "depth"; typ = Number (U8, Quantity []); unit = Some "m"; title = "" } in
        let message = { Definition.id = 9000; name = "Sounding"; title = "Sounding"; fields = [ depth ] } in
        Result.get_ok (Definition.make ~enumerations:[] ~bits:[] ~groups:[] [ message ])

      let () =
        match Dynamic.decode definition Byte_order.Little_endian ~id:9000 "\x07" with
        | Ok sounding -> assert (sounding.values = [ Int 7 ])
        | Error _ -> assert false
    ]} *)

(** The value of a field. [Int64] is for fields of type [i64] alone. *)
type value =
  | Int of int
  | Int64 of int64
  | Float of float
  | Bytes of string  (** Of a text, or raw. *)
  | Inline of t option
  | List of t list

and t = { definition : Definition.message; values : value list  (** One for each field. *) }

val decode : Definition.t -> Byte_order.t -> id:int -> string -> (t, Error.decode) result
(** [decode d order ~id payload] is [payload] as the message [id] of [d]. The error is
    [Bad_payload], with [Unknown_message id] if [d] has none. Limits are those of {!Packet.decode}. *)

val to_json : t -> Yojson.Safe.t
(** As {!Message.to_json} shows it. *)

val message_to_json : Definition.t -> Message.t -> Yojson.Safe.t
(** [message_to_json d m] is [m] as one shows it who knows IMC from [d]; as {!Message.to_json}, if [d] cannot read
    it. *)

val packet_to_json : Definition.t -> Packet.t -> Yojson.Safe.t
(** As {!Packet.to_json} shows it, but a message that is unknown there and known to the definition is
    shown by that. *)
