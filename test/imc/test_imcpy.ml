open Dolphin_imc
open Yojson.Safe.Util

let check = Alcotest.check

(* The output of imcpy, started with [arguments], for [input]. *)
let answers ~python arguments input =
  let file suffix = Filename.temp_file "dolphin" suffix in
  let asked = file ".hex" and said = file ".json" in
  let finish () = Sys.remove asked; Sys.remove said in
  Fun.protect ~finally:finish (fun () ->
      let channel = open_out_bin asked in
      List.iter (fun line -> output_string channel (line ^ "\n")) input;
      close_out channel;
      let command = Filename.quote_command python ~stdin:asked ~stdout:said ("imcpy_peer.py" :: arguments) in
      check Alcotest.int "status of imcpy" 0 (Sys.command command);
      let channel = open_in_bin said in
      let finally () = close_in channel in
      let text = Fun.protect ~finally (fun () -> really_input_string channel (in_channel_length channel)) in
      List.filter_map
        (fun line -> if line = "" then None else Some (Yojson.Safe.from_string line))
        (String.split_on_char '\n' text))

(* Limits of imcpy 1.1.2: the bytes of texts that are not ASCII, and three fields of [Sample], for which it lacks the
   type. The bytes that it writes are compared in any case. *)
let rec in_its_words ~said ours =
  match said, ours with
  | `Assoc [ ("unreadable", _) ], _ -> said
  | `String _, `String text ->
    let spelt c = if Char.code c < 128 then String.make 1 c else "\u{FFFD}" in
    `String (String.concat "" (List.map spelt (List.of_seq (String.to_seq text))))
  | `Assoc said, `Assoc ours when List.map fst said = List.map fst ours ->
    `Assoc (List.map2 (fun (_, said) (key, ours) -> (key, in_its_words ~said ours)) said ours)
  | `List said, `List ours when List.compare_lengths said ours = 0 ->
    `List (List.map2 (fun said ours -> in_its_words ~said ours) said ours)
  | _, ours -> ours

(* [p] has the content that imcpy reports, and the addresses that it saw. *)
let agrees (p : Packet.t) said =
  let message = member "message" said in
  (* Facts give numbers their names, imcpy the numbers. *)
  let rec named json =
    match json with
    | `Assoc (("abbrev", `String name) :: members) ->
      let fields = (Facts.message name).fields in
      let field (key, value) =
        let f = List.find (fun (f : Facts.field) -> f.name = key) fields in
        match value with
        | `Assoc [ ("unreadable", _) ] when name = "Sample" -> (key, value)
        | `Assoc [ ("unreadable", why) ] -> Alcotest.failf "%s.%s: %s" name key (to_string why)
        | `Int n when f.typ <> "fp32_t" && f.typ <> "fp64_t" -> (key, Facts.number f n)
        | other -> (key, named other)
      in
      `Assoc (("abbrev", `String name) :: List.map field members)
    | `List items -> `List (List.map named items)
    | other -> other
  in
  let said_message = named message in
  check Check.json "fields" said_message (in_its_words ~said:said_message (Check.message_json p));
  let header key = member key (member "header" said) in
  check (Alcotest.float 0.) "timestamp" (to_float (header "timestamp")) p.timestamp;
  let stated = List.map (fun key -> to_int (header key)) [ "src"; "src_ent"; "dst"; "dst_ent" ] in
  check Alcotest.(list int) "addresses" stated [ p.src; p.src_ent; p.dst; p.dst_ent ]

let names packets = List.sort_uniq compare (List.map (fun (p : Packet.t) -> Packet.id p) packets)
let all = lazy (List.sort compare (List.map (fun (m : Facts.message) -> m.id) (Lazy.force Facts.messages)))
let count = 12

(* Every message, in both orders of bytes. *)
let it_reads_ours ~python =
  let random = Random.State.make [| 5431 |] in
  let some m = QCheck2.Gen.generate ~n:count ~rand:random (Test_random.message 3 m) in
  let messages = List.concat_map some (Lazy.force Facts.messages) in
  let messages = List.filter Test_random.small messages in
  let ours order = List.map (fun m -> Check.decoded (Test_random.datagram order m)) messages in
  let packets = ours Little_endian @ ours Big_endian in
  let written = List.map (fun p -> Corpus.to_hex (Check.encoded p)) packets in
  let said = answers ~python [ "read"; "data/facts.jsonl" ] written in
  check Alcotest.int "packets" (List.length packets) (List.length said);
  check Alcotest.(list int) "every message" (Lazy.force all) (names packets);
  List.iter2
    (fun (p : Packet.t) said ->
       agrees p said;
       (* imcpy writes little-endian. *)
       let little = Corpus.to_hex (Check.encoded { p with order = Little_endian }) in
       check Alcotest.string "its bytes" little (to_string (member "hex" said)))
    packets said

let we_read_its ~python =
  let said = answers ~python [ "make"; "data/facts.jsonl"; "5431"; string_of_int count ] [] in
  let packets = List.map (fun json -> Check.decoded (Corpus.of_hex (to_string (member "hex" json)))) said in
  check Alcotest.int "packets" (count * List.length (Lazy.force all)) (List.length packets);
  check Alcotest.(list int) "every message" (Lazy.force all) (names packets);
  List.iter2
    (fun p said ->
       agrees p said;
       check Alcotest.string "our bytes" (to_string (member "hex" said)) (Corpus.to_hex (Check.encoded p)))
    packets said

let suite =
  Test_support.Imcpy.cases
    [ ("imcpy reads what we write, every message", it_reads_ours);
      ("we read what imcpy writes, every message", we_read_its) ]
