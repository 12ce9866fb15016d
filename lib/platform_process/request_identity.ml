open Dolphin_platform_protocol
open Dolphin_json

let make ~run ~number v task =
  let start : Yojson.Safe.t = `List [ `String run; `Int number; `String v; Plan_body.to_json task ] in
  Printf.sprintf "%s-%d" (Digest.to_hex (Digest.string (Canonical.to_string start))) number
