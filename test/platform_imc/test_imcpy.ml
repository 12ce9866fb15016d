let program =
  {|
v = pick { type 'UUV'; payload 'Sidescan'; timeout 20.seconds }
execute imcPlan('survey') >> imcPlan {
  planName 'lines'
  locate Location.APDL
  speed 1.5, Speed.Units.METERS_PS
  z 3, Z.Units.DEPTH
  goTo payload: [[name: 'Sidescan', Range: 50]]
  move 200, 0
  loiter radius: 100
}
execute during 1.second run imcPlan('long')
execute watch imcPlan('nowhere') onError { e -> message "failed: ${e}"; ignore() }
message "battery ${battery(v)}"
|}

let program_says = " program     says: "

let lines_of path =
  let channel = open_in path in
  let rec read lines =
    match input_line channel with line -> read (line :: lines) | exception End_of_file -> List.rev lines
  in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> read [])

(* What the program says in a line of the log, after a time of eight letters. *)
let message line =
  let before = 8 + String.length program_says in
  if String.length line > before && String.sub line 8 (String.length program_says) = program_says then
    Some (String.sub line before (String.length line - before))
  else None

let write path text =
  let channel = open_out path in
  output_string channel text;
  close_out channel

(* What the vehicle is to write down. The positions are those of APDL and 200 m north of it. *)
let expected =
  {|
{"did": "started", "plan": "survey"}
{"did": "completed", "plan": "survey"}
{"did": "started", "plan": "lines", "start": "1.Goto",
 "maneuvers": [["1.Goto", "Goto", 41.185242, -8.704803, 3.0, "DEPTH", 1.5, "METERS_PS",
                [["Sidescan", [["Active", "true"], ["Range", "50"]]]]],
               ["2.Loiter", "Loiter", 41.187043, -8.704803, 3.0, "DEPTH", 1.5, "METERS_PS", []]],
 "transitions": [["1.Goto", "maneuverIsDone", "2.Loiter"]]}
{"did": "completed", "plan": "lines"}
{"did": "started", "plan": "long"}
{"did": "stopped", "plan": "long"}
{"did": "refused", "plan": "nowhere"}
|}

let deeds text = List.of_seq (Seq.map (fun json -> Yojson.Safe.to_string json) (Yojson.Safe.seq_from_string text))

let mission ~python =
  let first = Test_support.Ports.lease () in
  let ports = Printf.sprintf "%d-%d" first (first + 4) in
  let file suffix = Filename.temp_file "dolphin" suffix in
  let source = file ".dol" and did = file ".jsonl" and said = file ".txt" in
  write source program;
  let vehicle =
    Unix.create_process python [| python; "imcpy_vehicle.py"; ports; did |] Unix.stdin Unix.stdout Unix.stderr
  in
  let finish () =
    Unix.kill vehicle Sys.sigkill;
    ignore (Unix.waitpid [] vehicle);
    List.iter Sys.remove [ source; did; said ]
  in
  Fun.protect ~finally:finish (fun () ->
      let arguments = [ "40"; "dolphin"; "exec"; source; "--imc-loopback"; "--imc-discovery-ports"; ports ] in
      let status = Sys.command (Filename.quote_command "timeout" ~stdout:said ~stderr:said arguments) in
      let said = lines_of said in
      if status <> 0 then Alcotest.failf "status %d: %s" status (String.concat "\n" said);
      Alcotest.(check (list string)) "what the vehicle did" (deeds expected)
        (deeds (String.concat "\n" (lines_of did)));
      Alcotest.(check (list string)) "what the program says"
        [ "failed: nowhere failed on imcpy-1: undefined plan"; "battery 0.75" ]
        (List.filter_map message said))

let tests =
  ("imcpy", Test_support.Imcpy.cases [ ("a vehicle that is made with imcpy runs a program's plans", mission) ])
