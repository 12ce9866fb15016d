type value =
  | Int of int
  | Int64 of int64
  | Float of float
  | Bytes of string
  | Inline of t option
  | List of t list

and t = { definition : Definition.message; values : value list }

(* {1 Decoding} *)

let scalar r : Definition.scalar -> value = function
  | U8 -> Int (Reader.u8 r)
  | U16 -> Int (Reader.u16 r)
  | U32 -> Int (Reader.u32 r)
  | I8 -> Int (Reader.i8 r)
  | I16 -> Int (Reader.i16 r)
  | I32 -> Int (Reader.i32 r)
  | I64 -> Int64 (Reader.i64 r)
  | F32 -> Float (Reader.f32 r)
  | F64 -> Float (Reader.f64 r)

let rec message d restriction r id =
  match (Definition.find d id, restriction) with
  | None, _ -> Reader.unknown r id
  | Some m, Some name when not (Definition.admits d name m) -> Reader.misplaced r id name
  | Some m, (Some _ | None) -> { definition = m; values = List.map (field d r) m.fields }

and field d r (f : Definition.field) =
  match f.typ with
  | Number (s, (Quantity _ | Enumeration _ | Bits _)) -> scalar r s
  | Text _ | Raw -> Bytes (Reader.text r)
  | Inline restriction -> Inline (Reader.inline r (message d restriction))
  | List restriction -> List (Reader.list r (message d restriction))

let decode d order ~id payload =
  let r = Reader.make order payload ~pos:0 ~len:(String.length payload) in
  match
    let m = message d None r id in
    Reader.finish r;
    m
  with
  | m -> Ok m
  | exception Reader.Fault { at; fault } -> Error (Error.Bad_payload { id; at; fault })

(* {1 Showing} *)

let enumerated (names : Definition.names) n =
  match List.find_opt (fun (named : Definition.named) -> named.value = n) names.members with
  | Some { name; _ } -> `String name
  | None -> Json.int n

let bits (names : Definition.names) n =
  let pairs = List.map (fun (named : Definition.named) -> (named.value, named.name)) names.members in
  `List (List.map (fun name -> `String name) (Bits.names pairs n))

let rec to_json { definition; values } =
  let show (f : Definition.field) value = (f.name, value_to_json f.typ value) in
  Json.message definition.name (List.map2 show definition.fields values)

and value_to_json (typ : Definition.typ) value =
  match (typ, value) with
  | Number (_, Enumeration names), Int n -> enumerated names n
  | Number (_, Bits names), Int n -> bits names n
  | _, Int n -> Json.int n
  | _, Int64 n -> Json.int64 n
  | _, Float x -> Json.float x
  | Raw, Bytes s -> Json.raw s
  | _, Bytes s -> Json.text s
  | _, Inline m -> Json.inline to_json m
  | _, List ms -> Json.list to_json ms

let message_to_json d message =
  let buffer = Buffer.create 1024 in
  match Message.write (Writer.make Little_endian buffer) message with
  | exception Writer.Fault _ -> Message.to_json message
  | () -> (
      match decode d Little_endian ~id:(Message.id message) (Buffer.contents buffer) with
      | Ok m -> to_json m
      | Error _ -> Message.to_json message)

let packet_to_json d (p : Packet.t) =
  match (p.content, Packet.to_json p) with
  | Unknown { id; payload }, `Assoc members -> (
      match decode d p.order ~id payload with
      | Error _ -> `Assoc members
      | Ok m ->
        let show (key, value) = (key, if String.equal key "message" then to_json m else value) in
        `Assoc (List.map show members))
  | (Message _ | Unknown _), json -> json
