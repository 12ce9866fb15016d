open Dolphin_imc

let check = Alcotest.check
let case name run = Alcotest.test_case name `Quick run

let sample =
  lazy (List.concat_map (fun (v : Corpus.vector) -> [ v.little; v.big ]) (Lazy.force Corpus.vectors))

let fails what expected s =
  match Packet.decode s with
  | Ok _ -> Alcotest.failf "%s: decoded" what
  | Error e ->
    if not (List.mem (Error.label e) expected) then Alcotest.failf "%s: %a" what Error.pp_decode e

(* {1 Truncations} *)

(* A packet that stops anywhere is an error, wherever the rest of it may lie in the same buffer. *)
let prefixes () =
  let each s =
    for len = 0 to String.length s - 1 do
      fails "prefix" [ "too short"; "truncated" ] (String.sub s 0 len);
      match (Packet.decode ~pos:0 ~len s, Header.read ~pos:0 ~len s) with
      | Error (Too_short n), Error (Too_short n') -> check Alcotest.(pair int int) "bytes" (len, len) (n, n')
      | Error (Truncated { present; _ }), Error (Truncated { present = present'; _ }) ->
        check Alcotest.(pair int int) "bytes" (len, len) (present, present')
      | _ -> Alcotest.fail "a part of a packet was accepted"
    done
  in
  List.iter each (Lazy.force sample)

(* A payload that is cut short and sealed again: the error is found by the fields. *)
let sealed_prefixes () =
  let each s =
    let payload = String.length s - 22 in
    for size = 0 to payload - 1 do
      fails "payload" [ "field past the end" ] (Corpus.seal (String.sub s 0 (20 + size) ^ "  "))
    done;
    fails "longer payload" [ "bytes left over" ] (Corpus.seal (String.sub s 0 (20 + payload) ^ "\000  "))
  in
  List.iter each (Lazy.force sample)

let frames () =
  let s = List.hd (Lazy.force Corpus.flood) in
  let with_ at c = String.mapi (fun i d -> if i = at then c else d) s in
  fails "sync" [ "not IMC" ] (with_ 0 '\x53');
  fails "sync" [ "not IMC" ] (with_ 1 '\xFF');
  fails "checksum" [ "bad checksum" ] (with_ (String.length s - 1) '\x00');
  fails "checksum" [ "bad checksum" ] (with_ 9 '\xAA');
  fails "more" [ "surplus bytes" ] (s ^ "\000");
  fails "two" [ "surplus bytes" ] (s ^ s)

(* Places that are not in the string count as missing. *)
let out_of_bounds () =
  let s = List.hd (Lazy.force Corpus.flood) in
  let nothing pos len =
    match Packet.decode ~pos ~len s with
    | Error (Too_short 0) -> ()
    | Ok _ | Error _ -> Alcotest.failf "decode ~pos:%d ~len:%d" pos len
  in
  nothing (-1) 30;
  nothing 0 (-1);
  nothing (String.length s + 1) 1;
  nothing max_int max_int;
  nothing min_int min_int;
  match Packet.decode ~pos:0 ~len:max_int s with
  | Ok _ -> ()
  | Error e -> Alcotest.failf "%a" Error.pp_decode e

(* A packet is found inside a buffer. *)
let inside () =
  let s = List.hd (Lazy.force Corpus.lifecycle) in
  let buffer = "before" ^ s ^ "after" in
  let p = Packet.decode ~pos:6 ~len:(String.length s) buffer in
  check Alcotest.bool "the same packet" true (p = Packet.decode s);
  match Header.read ~pos:6 buffer with
  | Error e -> Alcotest.failf "%a" Error.pp_decode e
  | Ok h -> check Alcotest.bool "by its header" true (Packet.decode_after ~pos:6 h buffer = p)

(* {1 Nesting and lists} *)

let plan_control arg = Message.Plan_control { Message.Plan_control.default with arg }
let rec nested n = plan_control (if n = 0 then None else Some (nested (n - 1)))
let packet m = Packet.make ~src:0x4001 ~timestamp:0. m

(* [Error.max_depth] messages within a message are read and written, and not one more. *)
let depth () =
  let p = packet (nested Error.max_depth) in
  let s = Check.encoded p in
  check Alcotest.bool "deepest" true (Packet.equal p (Check.decoded s));
  (match Packet.encode (packet (nested (Error.max_depth + 1))) with
   | Error (Nested_too_deep { field = "PlanControl.arg" }) -> ()
   | Ok _ | Error _ -> Alcotest.fail "one too deep was written");
  (* The head of PlanControl as far as the id in [arg], once more. *)
  let head = "\000\000\000\000\000\000\000\000\047\002" in
  let payload = String.sub s 20 (String.length s - 22) in
  let deeper = String.sub s 0 20 ^ head ^ payload ^ "\000\000" ^ "  " in
  fails "one too deep" [ "nested too deep" ] (Corpus.seal deeper);
  let bottomless = String.concat "" (List.init 6000 (fun _ -> head)) in
  fails "bottomless" [ "nested too deep" ] (Corpus.seal (String.sub s 0 20 ^ bottomless ^ "  "))

let allocated f =
  let before = Gc.allocated_bytes () in
  ignore (Sys.opaque_identity (f ()));
  Gc.allocated_bytes () -. before

let proportionate s = allocated (fun () -> Packet.decode s) <= 1024. +. (64. *. float (String.length s))

(* A count of messages that cannot be there costs nothing. *)
let counts () =
  let header = String.sub (Check.encoded (packet (Abort : Message.t))) 0 20 in
  let with_id id payload =
    let b = Bytes.of_string (header ^ payload ^ "  ") in
    Bytes.set_uint16_le b 2 id;
    Corpus.seal (Bytes.to_string b)
  in
  let transition count elements = with_id 553 ("\000\000\000\000\000\000" ^ count ^ elements) in
  fails "65535 messages" [ "field past the end" ] (transition "\255\255" "");
  check Alcotest.bool "costs nothing" true (proportionate (transition "\255\255" ""));
  (* As many of the smallest message as a packet holds: Abort, two bytes each. *)
  let aborts n = String.concat "" (List.init n (fun _ -> "\038\002")) in
  let full = transition "\000\120" (aborts 30720) in
  check Alcotest.bool "a full list costs its share" true (proportionate full);
  match (Check.decoded full).content with
  | Message (Plan_transition { actions; _ }) -> check Alcotest.int "messages" 30720 (List.length actions)
  | _ -> Alcotest.fail "not a transition"

(* {1 Mutations} *)

let mutate rand donors s =
  let int = Random.State.int rand in
  let length = String.length s in
  let before i = String.sub s 0 i and after i = String.sub s i (length - i) in
  let extreme () = [| '\x00'; '\x01'; '\x7F'; '\x80'; '\xFE'; '\xFF' |].(int 6) in
  let set i c = String.mapi (fun j d -> if i = j then c else d) s in
  if length = 0 then s
  else
    let i = int length in
    match int 9 with
    | 0 | 1 -> set i (Char.chr (Char.code s.[i] lxor (1 lsl int 8)))
    | 2 -> set i (extreme ())
    | 3 -> String.mapi (fun j d -> if j = i || j = i + 1 then '\xFF' else d) s
    | 4 -> before i
    | 5 -> before i ^ String.make (1 + int 8) (extreme ()) ^ after i
    | 6 -> before i ^ after (min length (i + 1 + int 4))
    | 7 ->
      let j = int length in
      before i ^ String.sub s j (min (1 + int 40) (length - j)) ^ after i
    | _ ->
      let donor : string = donors.(int (Array.length donors)) in
      let j = int (String.length donor) in
      before i ^ String.sub donor j (String.length donor - j)

let rec mutate_often rand donors s n =
  if n = 0 then s else mutate_often rand donors (mutate rand donors s) (n - 1)

(* An accepted text is a message: it can be written, and the written text is read as the same. (Not the same bytes: a
   signalling NaN becomes a quiet one.) *)
let coherent p =
  match Packet.encode p with
  | Error e -> Alcotest.failf "accepted, and not written: %a" Error.pp_encode e
  | Ok s -> Packet.equal p (Check.decoded s) && String.length (Yojson.Safe.to_string (Packet.to_json p)) > 0

let mutations () =
  let count =
    match Option.bind (Sys.getenv_opt "DOLPHIN_IMC_MUTATIONS") int_of_string_opt with
    | Some count -> count
    | None -> 200_000
  in
  let rand = Random.State.make [| 1492 |] in
  let donors = Array.of_list (Lazy.force Corpus.datagrams) in
  let outcomes = Hashtbl.create 16 in
  let note label =
    Hashtbl.replace outcomes label (1 + Option.value (Hashtbl.find_opt outcomes label) ~default:0)
  in
  for i = 1 to count do
    let s = donors.(Random.State.int rand (Array.length donors)) in
    let s = mutate_often rand donors s (1 + Random.State.int rand 3) in
    (* Most are sealed again, or the checksum would turn them all away. *)
    let s = if Random.State.int rand 8 = 0 then s else Corpus.seal s in
    match Packet.decode s with
    | exception e -> Alcotest.failf "%s raised %s" (Corpus.to_hex s) (Printexc.to_string e)
    | result ->
      if i mod 16 = 0 && not (proportionate s) then
        Alcotest.failf "%s allocates too much" (Corpus.to_hex s);
      (match result with
       | Error e ->
         ignore (Format.asprintf "%a" Error.pp_decode e);
         note (Error.label e)
       | Ok p ->
         note "accepted";
         if not (coherent p) then Alcotest.failf "%s is not coherent" (Corpus.to_hex s))
  done;
  Hashtbl.iter (fun label n -> Printf.printf "%8d %s\n" n label) outcomes;
  let reached label = Hashtbl.mem outcomes label in
  let all =
    [
      "accepted"; "too short"; "not IMC"; "truncated"; "surplus bytes"; "bad checksum"; "field past the end";
      "bytes left over"; "unknown inline message"; "misplaced inline message";
    ]
  in
  check Alcotest.(list string) "outcomes never met" [] (List.filter (fun label -> not (reached label)) all)

(* {1 What cannot be written} *)

let unwritable () =
  let fails m pattern =
    match Packet.encode (packet m) with
    | Ok _ -> Alcotest.fail "written"
    | Error e -> check Alcotest.string "error" pattern (Format.asprintf "%a" Error.pp_encode e)
  in
  let control = Message.Plan_control.default in
  fails (Plan_control { control with request_id = 65536 }) "PlanControl.request_id: 65536 is out of range";
  fails (Plan_control { control with request_id = -1 }) "PlanControl.request_id: -1 is out of range";
  fails (Plan_control { control with op = Other 256 }) "PlanControl.op: 256 is out of range";
  fails
    (Plan_control { control with flags = Message.Plan_control.Flags.of_int 65536 })
    "PlanControl.flags: 65536 is out of range";
  fails
    (Plan_control { control with plan_id = String.make 65536 'a' })
    "PlanControl.plan_id: length 65536, more than 65535";
  fails
    (Plan_control { control with plan_id = String.make 65535 'a' })
    "message 559: 65547 bytes, more than 65535";
  fails
    (State_report { Message.State_report.default with fuel = 128 })
    "StateReport.fuel: 128 is out of range";
  let actions = List.init 65536 (fun _ -> Message.Abort) in
  fails
    (Plan_transition { Message.Plan_transition.default with actions })
    "PlanTransition.actions: length 65536, more than 65535";
  match Packet.encode { (packet Message.Abort) with src = 65536 } with
  | Error (Out_of_range { field = "src"; value = 65536 }) -> ()
  | Ok _ | Error _ -> Alcotest.fail "an address out of range"

let suite =
  [
    case "every prefix is an error" prefixes;
    case "every shorter payload is an error" sealed_prefixes;
    case "frames" frames;
    case "places out of bounds" out_of_bounds;
    case "a packet inside a buffer" inside;
    case "depth" depth;
    case "counts of messages" counts;
    case "mutated datagrams" mutations;
    case "what cannot be written" unwritable;
  ]
