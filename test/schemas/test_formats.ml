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

(* {1 Vehicles}

   A run whose journal cannot be read is not resumed. *)

let extremes = [ 0.; -0.; 1.; -1.; 7.; -90.; 180.; 1e5; -2e4; 1e6; -1e6; 2e6; -2e6; 1e17; -1e17; 1e308; -1e308; 5e-324 ]

let reports () =
  let number name x = (name, `Float x) in
  let known = List.map (fun name -> number name 0.) [ "latitude"; "longitude"; "height"; "depth"; "altitude"; "battery"; "speed" ] in
  let with_one name x =
    List.map (fun (other, zero) -> if other = name then number name x else (other, zero)) known in
  let is_taken name x =
    let report = `Assoc ([ ("kind", `String "vehicle"); ("vehicle", `String "v") ] @ with_one name x) in
    let line =
      `Assoc
        ([ ("kind", `String "vehicle"); ("time", `Int 0); ("vehicle", `String "v"); ("type", `String "UUV");
           ("payload", `List []); ("connected", `Bool true) ]
         @ with_one name x)
    in
    let is_report = Result.is_ok (Codec.read Dolphin_platform_protocol.Report.codec report)
    and is_line = Result.is_ok (Dolphin_trace.Entry.of_string (print line)) in
    if is_report && not is_line then Alcotest.failf "%s %g is taken from adapters, and not in a journal" name x;
    is_report
  in
  let taken = List.concat_map (fun (name, _) -> List.map (is_taken name) extremes) known in
  Alcotest.(check bool) "some are taken" true (List.mem true taken);
  Alcotest.(check bool) "some are not" true (List.mem false taken)

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
  | _ ->
    Alcotest.run "formats"
      [ ("laws", List.map law Formats.all);
        ("vehicles", [ Alcotest.test_case "a journal has what adapters may report" `Quick reports ]) ]
