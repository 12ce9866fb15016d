open Dolphin_imc

type line = { time : float; inward : bool; bytes : string }

let console = 0x4ABC
let vehicle = "lauv-noptilus-1"

let of_hex text =
  String.init (String.length text / 2) (fun i -> Char.chr (int_of_string ("0x" ^ String.sub text (2 * i) 2)))

let line json =
  let open Yojson.Safe.Util in
  match member "hex" json with
  | `String hex ->
    Some { time = to_number (member "t" json); inward = to_string (member "dir" json) = "in"; bytes = of_hex hex }
  | _ -> None

let read_lines path =
  lazy
    (let channel = open_in path in
     let rec read found =
       match input_line channel with
       | text -> read (match line (Yojson.Safe.from_string text) with Some l -> l :: found | None -> found)
       | exception End_of_file -> close_in channel; List.rev found
     in
     read [])

let lines = read_lines "data/lifecycle.jsonl"
let fleet = read_lines "data/fleet.jsonl"

let message line =
  match Packet.decode line.bytes with
  | Ok { content = Message m; _ } -> m
  | Ok { content = Unknown _; _ } -> failwith "unknown message"
  | Error why -> failwith (Format.asprintf "%a" Error.pp_decode why)
