open Dolphin_imc
open Yojson.Safe.Util

let check = Alcotest.check
let case name run = Alcotest.test_case name `Quick run

(* {1 Vectors} *)

let each_vector f =
  let vectors = Lazy.force Corpus.vectors in
  check Alcotest.int "vectors" 330 (List.length vectors);
  List.iter f vectors

(* Every vector has its stated content, in both orders. *)
let content () =
  each_vector (fun { name; little; big; content } ->
      let expected = Facts.shown (member "message" content) in
      let header key = member key (member "header" content) in
      let says order bytes =
        let p = Check.decoded bytes in
        check Check.json name expected (Check.message_json p);
        check Alcotest.bool "byte order" true (p.order = order);
        check (Alcotest.float 0.) "timestamp" (to_float (header "timestamp")) p.timestamp;
        let address = [ p.src; p.src_ent; p.dst; p.dst_ent ] in
        let stated = List.map (fun key -> to_int (header key)) [ "src"; "src_ent"; "dst"; "dst_ent" ] in
        check Alcotest.(list int) "addresses" stated address
      in
      says Little_endian little;
      says Big_endian big)

let reencode () =
  each_vector (fun { name; little; big; _ } ->
      let returns s =
        check Alcotest.string name (Corpus.to_hex s) (Corpus.to_hex (Check.encoded (Check.decoded s)))
      in
      returns little;
      returns big)

(* The two orders are one packet: each is the other, turned round. *)
let orders () =
  each_vector (fun { name; little; big; _ } ->
      let turns s t =
        let turned = Check.encoded (Check.other_order (Check.decoded s)) in
        check Alcotest.string name (Corpus.to_hex t) (Corpus.to_hex turned)
      in
      turns little big;
      turns big little)

(* The vectors have every message but Sample; the same implementation wrote this one. *)
let sample () =
  let s =
    Corpus.of_hex
      "54fee901240000001040fc54d9410140031a00ff8403b81e85eb51b8e63f333333333333c3bf00002040010000a03f00\
       0100010300613d31a657"
  in
  let expected =
    {|{"abbrev":"Sample","timeout":900,"lat":0.71,"lon":-0.15,"z":2.5,"z_units":"DEPTH","speed":1.25,
       "speed_units":"METERS_PS","syringe0":"TRUE","syringe1":"FALSE","syringe2":"TRUE","custom":"a=1"}|}
  in
  check Check.json "Sample" (Yojson.Safe.from_string expected) (Check.message_json (Check.decoded s));
  check Alcotest.bool "the same bytes" true (String.equal s (Check.encoded (Check.decoded s)))

let complete () =
  let names = List.map (fun (v : Corpus.vector) -> v.name) (Lazy.force Corpus.vectors) in
  let all = List.map (fun (m : Facts.message) -> m.name) (Lazy.force Facts.messages) in
  let missing = List.filter (fun name -> not (List.mem name names)) all in
  check Alcotest.(list string) "messages without a vector" [ "Sample" ] missing

(* {1 Recordings} *)

let recorded name packets ~count ~known () =
  let packets = Lazy.force packets in
  check Alcotest.int name count (List.length packets);
  let same s =
    let p = Check.decoded s in
    check Alcotest.bool name true (String.equal s (Check.encoded p));
    match p.content with Message _ -> 1 | Unknown _ -> 0
  in
  check Alcotest.int "known messages" known (List.fold_left (fun n s -> n + same s) 0 packets)

(* The definition read at run time shows every message just as the typed one does. *)
let dynamic () =
  let definition = Lazy.force Definition.builtin in
  let same s =
    let p = Check.decoded s in
    let payload = String.sub s Header.size (String.length s - Header.overhead) in
    match (p.content, Dynamic.decode definition p.order ~id:(Packet.id p) payload) with
    | Message m, Ok m' -> check Check.json (Message.name m) (Message.to_json m) (Dynamic.to_json m')
    | Message m, Error e -> Alcotest.failf "%s: %a" (Message.name m) Error.pp_decode e
    | Unknown _, Error (Bad_payload { fault = Unknown_message _; at = 0; _ }) -> ()
    | Unknown { id; _ }, _ -> Alcotest.failf "message %d is not in the definition" id
  in
  List.iter same (Lazy.force Corpus.datagrams)

(* The lifecycle holds a plan as a real vehicle got it. *)
let plan () =
  let plan_of s =
    match (Check.decoded s).content with
    | Message (Plan_control { type_ = Request; op = Start; arg = Some (Plan_specification plan); _ }) ->
      Some plan
    | _ -> None
  in
  match List.filter_map plan_of (Lazy.force Corpus.lifecycle) with
  | [] -> Alcotest.fail "no plan in the lifecycle"
  | plan :: _ -> (
      check Alcotest.string "plan" "planA" plan.plan_id;
      match plan.maneuvers with
      | { data = Some (Goto { z_units = Depth; speed_units; _ }); _ } :: _ ->
        check Alcotest.string "speed units" "METERS_PS" (Message.Speed_units.name speed_units)
      | _ -> Alcotest.fail "the first maneuver is not a Goto by depth")

let suite =
  [
    case "330 vectors say what is stated" content;
    case "330 vectors encode to the same bytes" reencode;
    case "each byte order encodes to the other" orders;
    case "every message but Sample has a vector" complete;
    case "Sample" sample;
    case "lifecycle: same bytes" (recorded "lifecycle" Corpus.lifecycle ~count:3994 ~known:3994);
    case "flood: same bytes" (recorded "flood" Corpus.flood ~count:3000 ~known:301);
    case "dynamic = typed" dynamic;
    case "a real plan" plan;
  ]
