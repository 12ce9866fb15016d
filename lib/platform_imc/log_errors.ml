open Dolphin_imc

type t = (string * string) list  (* contexts and texts *)

let most = 50
let none = []

let is_reply text =
  let prefix = "reply -- " in
  let n = String.length prefix in
  String.length text >= n && String.sub text 0 n = prefix

let hear ~at_work (entry : Message.Log_book_entry.t) heard =
  let said = (entry.context, entry.text) in
  match entry.type_ with
  | (Error | Critical) when not (is_reply entry.text || List.mem said heard || List.length heard >= most) ->
    let told = if at_work then Some (Printf.sprintf "error of %s: %s" entry.context entry.text) else None in
    (told, said :: heard)
  | Error | Critical | Info | Warning | Debug | Other _ -> (None, heard)
