open Dolphin_imc
open Dolphin_platform_imc

let fail fmt = Printf.ksprintf (fun text -> print_endline text; exit 1) fmt

(* {1 Recordings} *)

let read path =
  let channel = open_in_bin path in
  Fun.protect
    ~finally:(fun () -> close_in channel)
    (fun () -> really_input_string channel (in_channel_length channel))

let packets path =
  let bytes = read path in
  let rec split pos =
    if pos >= String.length bytes then []
    else
      match Header.read ~pos bytes with
      | Error why -> fail "%s: %s" path (Error.label why)
      | Ok h -> String.sub bytes pos (Header.overhead + h.size) :: split (pos + Header.overhead + h.size)
  in
  split 0

(* {1 Mutations} *)

let byte random = Char.chr (Random.State.int random 256)

let spoil random bytes =
  let b = Bytes.of_string bytes in
  for _ = 0 to Random.State.int random 6 do
    Bytes.set b (Random.State.int random (Bytes.length b)) (byte random)
  done;
  Bytes.unsafe_to_string b

(* A length and a checksum that fit, so that the payload is looked at. *)
let seal bytes =
  let length = String.length bytes in
  if length < Header.overhead || length > Header.overhead + 0xFFFF then bytes
  else
    let b = Bytes.of_string bytes in
    let set = if bytes.[0] = '\xFE' then Bytes.set_uint16_be else Bytes.set_uint16_le in
    set b 4 (length - Header.overhead);
    set b (length - 2) (Crc.arc (Bytes.unsafe_to_string b) ~pos:0 ~len:(length - 2));
    Bytes.unsafe_to_string b

let mutate random recorded =
  let any () = recorded.(Random.State.int random (Array.length recorded)) in
  let part bytes = String.sub bytes 0 (Random.State.int random (String.length bytes)) in
  match Random.State.int random 8 with
  | 0 -> part (any ())
  | 1 -> any () ^ part (any ())
  | 2 -> String.init (Random.State.int random 200) (fun _ -> byte random)
  | 3 -> seal (part (any ()))
  | 4 -> seal (any () ^ part (any ()))
  | 5 | 6 -> seal (spoil random (any ()))
  | _ -> spoil random (any ())

(* {1 The codec} *)

(* Whether [bytes] is a packet; a packet is the bytes that it was decoded from. *)
let codec definition bytes =
  match Packet.decode bytes with
  | Error _ -> false
  | Ok p ->
    (* Signalling NaNs become quiet ones, in the bytes but not in the packet. *)
    (match Result.map (fun bytes -> Packet.decode bytes) (Packet.encode p) with
     | Ok (Ok again) -> if not (Packet.equal p again) then fail "decoded, encoded, decoded: another packet"
     | Ok (Error why) -> fail "decoded and encoded: %s" (Error.label why)
     | Error why -> fail "decoded and not encoded: %s" (Format.asprintf "%a" Error.pp_encode why));
    ignore (Dynamic.packet_to_json definition p);
    true

(* {1 The console} *)

let loopback = Unix.inet_addr_loopback
let vehicle = "lauv-noptilus-1"

let settings : Station.settings =
  { id = 0x4ABC; name = "ccu-dolphin"; program = ""; addresses = [ { host = loopback; port = 6001 } ]; epoch = 1.79e9;
    first_request = 101; payload = []; types = []; type_names = []; records = true; abort_after = None;
    run = ""; jitter = 0. }

let hear ~now bytes s = fst (Station.datagram ~now ~from:loopback bytes s)

(* A console that has heard a whole lifecycle, and has a plan under way. *)
let console lifecycle =
  let s = List.fold_left (fun s bytes -> hear ~now:1. bytes s) (Station.create settings) lifecycle in
  fst (Station.start ~now:2. vehicle { name = "planB"; plan = None; task_site = 0 } s)

let knowledge s = List.map (fun (x : Station.system) -> x.node) (Station.systems ~now:0. s)

let rec drained s = match Station.take s with Some (_, s) -> drained s | None -> s

(* How often an invalid datagram is held against all that is known, not only against the count of those that were
   believed: with many systems that takes long. *)
let look_every = 50

type tally = { mutable valid : int; mutable invalid : int; mutable looked : int }

let throw tally definition ~i ~now bytes s =
  let valid = codec definition bytes in
  let s' = hear ~now bytes s in
  if valid then tally.valid <- tally.valid + 1
  else begin
    tally.invalid <- tally.invalid + 1;
    if Station.accepted s' <> Station.accepted s then fail "datagram %d is invalid and was believed" i;
    if tally.invalid mod look_every = 0 then begin
      tally.looked <- tally.looked + 1;
      if compare (knowledge s') (knowledge s) <> 0 then fail "datagram %d is invalid and changed the state" i
    end
  end;
  s'

(* {1 Memory} *)

let live_megabytes () =
  Gc.compact ();
  float_of_int ((Gc.stat ()).live_words * (Sys.word_size / 8)) /. 1e6

let () =
  let count = int_of_string Sys.argv.(1) in
  let lifecycle = packets Sys.argv.(2) in
  let recorded = Array.of_list (lifecycle @ packets Sys.argv.(3)) in
  let definition = Lazy.force Definition.builtin in
  let random = Random.State.make [| (match Sys.getenv_opt "SEED" with Some n -> int_of_string n | None -> 1866) |] in
  let tally = { valid = 0; invalid = 0; looked = 0 } in
  let first = count / 4 in
  let began = Unix.gettimeofday () in
  let rec go i s early =
    if i = count then (s, early)
    else
      let now = 2. +. (float_of_int i /. 14_000.) in
      let bytes = mutate random recorded in
      let s =
        match throw tally definition ~i ~now bytes s with
        | s -> s
        | exception error -> fail "datagram %d: %s" i (Printexc.to_string error)
      in
      let s = if i land 1023 = 0 then drained (fst (Station.tick ~now s)) else s in
      go (i + 1) s (if i = first then live_megabytes () else early)
  in
  let s, early = go 0 (console lifecycle) 0. in
  let late = live_megabytes () in
  ignore (Sys.opaque_identity recorded);
  Printf.printf "%d datagrams in %.0f s: %d invalid, none believed, %d of them held against all that was known\n" count
    (Unix.gettimeofday () -. began) tally.invalid tally.looked;
  Printf.printf "%d valid, of %d systems; %d read\n" tally.valid (List.length (knowledge s)) (Station.accepted s);
  Printf.printf "live memory: %.1f MB after a quarter, %.1f MB at the end\n" early late;
  if late > (1.5 *. early) +. 8. then fail "memory grows"
