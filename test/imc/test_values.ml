open Dolphin_imc

let check = Alcotest.check
let case name run = Alcotest.test_case name `Quick run

let crc () =
  let arc s = Crc.arc s ~pos:0 ~len:(String.length s) in
  check Alcotest.int "check value" 0xBB3D (arc "123456789");
  check Alcotest.int "inside" 0xBB3D (Crc.arc "..123456789.." ~pos:2 ~len:9);
  check Alcotest.int "nothing" 0 (arc "");
  check Alcotest.int "one byte" 0xC0C1 (arc "\001");
  let out pos len =
    match Crc.arc "abc" ~pos ~len with
    | _ -> Alcotest.failf "~pos:%d ~len:%d" pos len
    | exception Invalid_argument _ -> ()
  in
  out 0 4;
  out 4 0;
  out (-1) 1;
  out 1 (-1);
  out max_int max_int

let header () =
  let heartbeat = Corpus.of_hex "54fe9600000000001040fc54d9410140031a00ff" in
  let s = Corpus.seal (heartbeat ^ "  ") in
  let h = Check.get ~pp:Error.pp_decode "header" (Header.read s) in
  check Alcotest.string "shown" "message 150, 0 bytes, from 0x4001.3 to 0x001a.255 at 1700000000.250"
    (Format.asprintf "%a" Header.pp h);
  check Alcotest.bool "checksum" true (Header.check h s = Ok ());
  (* The header alone does not mind the checksum; [check] does. *)
  let broken = heartbeat ^ "\000\000" in
  check Alcotest.bool "the same header" true (Header.read broken = Ok h);
  (match Header.check h broken with
   | Error (Bad_checksum { stated = 0; _ }) -> ()
   | Ok () | Error _ -> Alcotest.fail "a wrong checksum");
  (* Nor does a header that belongs elsewhere make it read outside. *)
  let elsewhere ~pos size =
    match (Header.check ~pos { h with size } s, Packet.decode_after ~pos { h with size } s) with
    | Error (Truncated _), Error (Truncated _) -> ()
    | _ -> Alcotest.failf "%d bytes at %d" size pos
  in
  elsewhere ~pos:0 1;
  elsewhere ~pos:1 0;
  elsewhere ~pos:(-1) 0;
  elsewhere ~pos:max_int 0;
  elsewhere ~pos:0 (-5)

let make () =
  let p = Packet.make ~src:0x4001 ~timestamp:1.5 Heartbeat in
  check Alcotest.string "bytes" "54fe96000000000000000000f83f0140ffffffff"
    (String.sub (Corpus.to_hex (Check.encoded p)) 0 40)

let enumerations () =
  let open Message.System_type in
  check Alcotest.string "name" "UUV" (name Uuv);
  check Alcotest.bool "value" true (of_int 4 = Uav && of_int 9 = Other 9);
  for n = 0 to 255 do
    check Alcotest.int "to_int (of_int n)" n (to_int (of_int n))
  done;
  check Check.json "known" (`String "CCU") (to_json Ccu);
  check Check.json "later" (`Int 77) (to_json (Other 77))

let bits () =
  let open Message.Plan_control.Flags in
  let both = calibrate + ignore_errors in
  check Alcotest.int "union" 3 (to_int both);
  check Alcotest.bool "mem" true (mem calibrate both && mem none both && not (mem both calibrate));
  check Alcotest.bool "difference" true (both - calibrate = ignore_errors);
  check Alcotest.string "shown" "CALIBRATE IGNORE_ERRORS" (Format.asprintf "%a" pp both);
  let loops n = Message.C_loops_mask.(to_json (of_int n)) in
  check Check.json "none" (`List []) (loops 0);
  check Check.json "all" (`List [ `String "ALL" ]) (loops 0xFFFFFFFF);
  check Check.json "unnamed" (`List [ `String "DEPTH"; `String "0x4000" ]) (loops 0x4008)

let tuples () =
  let pairs = Alcotest.(list (pair string string)) in
  check pairs "pairs" [ ("Range", "50"); ("Active", "true") ] (Tuple_list.of_string " Range = 50; Active=true;");
  check pairs "no value" [ ("a", ""); ("b", "1=2") ] (Tuple_list.of_string "a;;b=1=2");
  check pairs "empty" [] (Tuple_list.of_string "");
  check Alcotest.string "printed" "a=1;b=2" (Tuple_list.to_string [ ("a", "1"); ("b", "2") ]);
  check Alcotest.(option string) "found" (Some "2") (Tuple_list.find "b" [ ("a", "1"); ("b", "2") ])

(* JSON is well-formed whatever the bytes are. *)
let json () =
  let shown text =
    match Message.to_json (Text_message { origin = ""; text }) with
    | `Assoc members -> List.assoc "text" members
    | _ -> `Null
  in
  let becomes expected text = check Check.json (String.escaped text) (`String expected) (shown text) in
  becomes "olá €😀" "olá €😀";
  becomes "a\u{FFFD}b" "a\xFFb";
  becomes "\u{FFFD}" "\xC3";
  becomes "\u{FFFD}\u{FFFD}" "\xC0\x80";
  becomes "\u{FFFD}\u{FFFD}\u{FFFD}" "\xED\xA0\x80";
  becomes "\u{FFFD}\u{FFFD}\u{FFFD}\u{FFFD}" "\xF4\x90\x80\x80";
  let voltage value = Yojson.Safe.to_string (Message.to_json (Voltage { value })) in
  check Alcotest.string "a number" {|{"abbrev":"Voltage","value":12.5}|} (voltage 12.5);
  check Alcotest.string "not a number" {|{"abbrev":"Voltage","value":"NaN"}|} (voltage nan);
  check Alcotest.string "infinite" {|{"abbrev":"Voltage","value":"-Infinity"}|} (voltage neg_infinity)

let suite =
  [
    case "CRC-16/ARC" crc;
    case "header" header;
    case "Packet.make" make;
    case "enumerations" enumerations;
    case "bits" bits;
    case "tuples" tuples;
    case "JSON" json;
  ]
