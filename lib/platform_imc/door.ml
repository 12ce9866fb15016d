open Dolphin_imc

let text = Dolphin_utf8.Utf8.line
let is_plain t = text t == t

let parameter (p : Message.Entity_parameter.t) : Message.Entity_parameter.t =
  { name = text p.name; value = text p.value }

let message (m : Message.t) : Message.t =
  match m with
  | Announce a -> Announce { a with sys_name = text a.sys_name; services = text a.services }
  | Entity_list l -> Entity_list { l with list = text l.list }
  | Vehicle_state s -> Vehicle_state { s with last_error = text s.last_error; error_ents = text s.error_ents }
  | Plan_control_state s -> Plan_control_state { s with plan_id = text s.plan_id; man_id = text s.man_id }
  | Plan_control c -> Plan_control { c with plan_id = text c.plan_id; info = text c.info }
  | Log_book_entry e -> Log_book_entry { e with context = text e.context; text = text e.text }
  | Entity_parameters p -> Entity_parameters { name = text p.name; params = List.map parameter p.params }
  | other -> other

let content : Packet.content -> Packet.content = function
  | Message m -> Message (message m)
  | Unknown _ as unknown -> unknown
