open Dolphin_imc

let raw id length = Packet.Unknown { id; payload = String.make length '\000' }

let entity_state : Packet.content =
  Message (Entity_state { Message.Entity_state.default with state = Normal; description = "active" })

let content n =
  match n land 7 with
  | 0 | 2 | 4 | 6 -> 47, raw 281 5
  | 1 -> 3, raw 254 40
  | 3 -> 3, raw 256 32
  | 5 -> 3, raw 257 32
  | _ -> (n lsr 3) land 63, entity_state
