(* Laws of each format that a schema describes: what the schema allows is read; what is written is read as the same
   value. "test_formats.exe lines NAME" prints random lines of a format, which must be valid. *)

open Dolphin_json

let document file = Formats.schema (Formats.find (Filename.chop_suffix file ".schema.json"))
let generator format = Values.of_schema ~document (Formats.schema format)
let print json = Canonical.to_string json

let law (Formats.Format { name; codec; refuses; _ } as format) =
  let read_and_written json =
    match Codec.read codec json with
    | Error why -> refuses || failwith why
    | Ok x -> (
        match Codec.read codec (Codec.write codec x) with
        | Ok x' -> x = x' || failwith ("not the same: " ^ print (Codec.write codec x))
        | Error why -> failwith (print (Codec.write codec x) ^ " is not read: " ^ why))
  in
  Test_support.Property.case ~count:500 name ~print (generator format) read_and_written

(* {1 Lines} *)

let lines (Formats.Format { codec; _ } as format) =
  let line json =
    match Codec.read codec json with Ok x -> print_endline (Codec.to_string codec x) | Error _ -> ()
  in
  let seeds = 2018 :: Option.to_list (Option.bind (Sys.getenv_opt "DOLPHIN_SEED") int_of_string_opt) in
  let of_seed seed = QCheck2.Gen.generate ~rand:(Random.State.make [| seed |]) ~n:300 (generator format) in
  List.iter (fun seed -> List.iter line (of_seed seed)) seeds

let () =
  match Sys.argv with
  | [| _; "lines"; name |] -> lines (Formats.find name)
  | _ -> Alcotest.run "formats" [ ("laws", List.map law Formats.all) ]
