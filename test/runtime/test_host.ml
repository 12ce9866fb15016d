open Dolphin_semantics
open Dolphin_json
open Dolphin_runtime
open Lwt.Infix

let case name test = Alcotest.test_case name `Quick test
let deadline = 20.
let value = Alcotest.testable Value.pp (fun x y -> Value.compare x y = 0)

(* {1 Values} *)

let list (xs : Core.value list) : Core.value = List (Vector.of_list xs)
let position : Dolphin_geo.Position.t = { latitude = 41.25; longitude = -8.5; height = 2. }
let platform_task name : Core.value = Task (Platform { name; plan = None; task_site = 7 })

let json_is expected x =
  let text = function Ok json -> Yojson.Safe.to_string json | Error why -> "error: " ^ why in
  Alcotest.(check string) expected expected (text (Host_value.to_json x))

let writes_values () =
  json_is "null" Null;
  json_is "[true,3,0.5,\"a\\\"b\"]" (list [ Boolean true; Integer 3; Number 0.5; String "a\"b" ]);
  json_is "{\"z\":1,\"a\":null}" (Map [ ("z", Integer 1); ("a", Null) ]);
  json_is "[3,2,1]" (Range (3, 1));
  json_is "\"Units.RPM\"" (Symbol "Units.RPM");
  json_is "{\"object\":\"queue\"}" (Host "queue");
  json_is "{\"task\":\"survey1\"}" (platform_task "survey1");
  json_is "{\"vehicles\":[\"v2\",\"v1\"]}" (Vehicles [ "v2"; "v1" ]);
  json_is "{\"latitude\":41.25,\"longitude\":-8.5,\"height\":2.0}" (Position position);
  json_is "{\"map\":{\"task\":1}}" (Map [ ("task", Integer 1) ]);
  json_is "{\"task\":1,\"other\":2}" (Map [ ("task", Integer 1); ("other", Integer 2) ])

let keeps_values () =
  json_is "error: nan is not a number that JSON has" (Number Float.nan);
  json_is "error: of tasks, only platform tasks can be sent to the host" (Task (Idle { seconds = 1.; site = 0 }));
  json_is "error: a range of more than 100000 numbers is too long to send" (Range (min_int, max_int));
  json_is ("error: " ^ Value.kind Wildcard ^ " cannot be sent to the host") (list [ Wildcard ]);
  let rec nested n : Core.value = if n = 0 then Null else list [ nested (n - 1) ] in
  json_is "error: it is nested more than 100 deep" (nested 101)

let read text = Result.bind (Host_value.parse text) (Host_value.of_json ~site:7)
let reads text expected = Alcotest.(check (result value string)) text (Ok expected) (read text)

let reads_values () =
  reads "[1, 1.0, 1e2, \"\\u00e9\"]" (list [ Integer 1; Number 1.; Number 100.; String "\xc3\xa9" ]);
  reads "123456789012345678901234567890" (Number 123456789012345678901234567890.);
  reads "{\"b\": 1, \"a\": {}}" (Map [ ("b", Integer 1); ("a", Map []) ]);
  reads "{\"vehicles\": [\"v2\", \"v1\", \"v2\"]}" (Vehicles [ "v2"; "v1" ]);
  reads "{\"longitude\": -8.5, \"latitude\": 41.25}" (Position { position with height = 0. })

let round_trip () =
  let same x =
    match Result.bind (Host_value.to_json x) (fun json -> read (Yojson.Safe.to_string json)) with
    | Ok y -> Alcotest.check value "same" x y
    | Error why -> Alcotest.fail why
  in
  List.iter same
    [ list [ Null; Boolean false; Integer max_int; Integer min_int; Number 0.1; Number 1e300; String "\n\x7f" ];
      platform_task "p"; Host "o"; Vehicles []; Position position;
      Area (Result.get_ok (Dolphin_geo.Area.circle position 12.5));
      Area (Result.get_ok (Dolphin_geo.Area.corridor [ position; { position with latitude = 41.2 } ] 12.5));
      Map [ ("object", Map [ ("map", Map [ ("latitude", Null); ("longitude", Null) ]) ]) ]; Map [] ]

let refuses text =
  match read text with
  | Ok x -> Alcotest.failf "%s read as %s" text (Value.to_string x)
  | Error why -> if why = "" then Alcotest.failf "%s: no reason" text

let refuses_values () =
  List.iter refuses
    [ ""; "{"; "nul"; "[1,]"; "1 2"; "NaN"; "-Infinity"; "1e999"; "{\"a\":1,\"a\":2}"; "{\"object\":3}";
      "{\"task\":\"\"}"; "{\"vehicles\":[1]}"; "{\"vehicles\":\"v\"}"; "{\"latitude\":91,\"longitude\":0}";
      "{\"latitude\":\"x\",\"longitude\":0}"; "{\"map\":1}"; "{\"centre\":1,\"radius\":1}"; "{\"rims\":1}";
      "{\"rims\":[]}"; "{\"rims\":[[{\"latitude\":1,\"longitude\":1},{\"latitude\":1,\"longitude\":2}]]}";
      (* clockwise *)
      "{\"rims\":[[{\"latitude\":1,\"longitude\":1},{\"latitude\":2,\"longitude\":1},\
       {\"latitude\":1,\"longitude\":2}]]}";
      String.make 500_000 '['; String.make 1000 '[' ^ String.make 1000 ']' ]

(* {1 The process} *)

let with_host ?timeout command test =
  Lwt_main.run
    (Lwt_unix.with_timeout deadline (fun () ->
         match Host.start ?timeout command with
         | Error why -> Alcotest.fail why
         | Ok host -> Lwt.finalize (fun () -> test host) (fun () -> Host.close host)))

let call ?subject ?(arguments = []) host member =
  Host.call host ~site:7 ~subject ~member ~arguments:(Some arguments)

let gives expected reply = reply >|= Alcotest.(check (result value string)) "reply" (Ok expected)
let fails expected reply = reply >|= Alcotest.(check (result value string)) "reply" (Error expected)

(* A host that replies to request [i] by its [i]th line, with the request itself as [$request]. *)
let scripted lines = String.concat "\n" (List.map (fun line -> "read -r request; " ^ line) lines)

let speaks () =
  let quoted = "printf '%s\\n' \"$request\" | sed 's/\"/\\\\\"/g; s/.*/{\"id\":ID,\"value\":\"&\"}/'" in
  let echo id = String.concat (string_of_int id) (Str.split_delim (Str.regexp "ID") quoted) in
  let command =
    scripted [ echo 1; echo 2; echo 3; "echo '{\"id\":4,\"error\":\"closed\"}'"; "echo '{\"value\":5,\"id\":5}'" ]
  in
  with_host command (fun host ->
      call host "getSupplier" |> gives (String "{\"id\":1,\"call\":\"getSupplier\",\"arguments\":[]}") >>= fun () ->
      Host.call host ~site:7 ~subject:(Some "supplier") ~member:"queue" ~arguments:None
      |> gives (String "{\"id\":2,\"object\":\"supplier\",\"get\":\"queue\"}")
      >>= fun () ->
      call ~subject:"queue" ~arguments:[ Integer 20; Host "unit" ] host "await"
      |> gives
        (String "{\"id\":3,\"object\":\"queue\",\"call\":\"await\",\"arguments\":[20,{\"object\":\"unit\"}]}")
      >>= fun () ->
      call host "next" |> fails "closed" >>= fun () ->
      call ~arguments:[ Wildcard ] host "next" |> fails (Value.kind Wildcard ^ " cannot be sent to the host")
      >>= fun () -> call host "next" |> gives (Integer 5))

let knows_version () =
  with_host "read -r request; echo '{\"id\":1,\"value\":'$DOLPHIN_SUPPLIER_PROTOCOL'}'" (fun host ->
      call host "version" |> gives (Integer 1))

(* A reason that starts with [expected]: after that, a library speaks. *)
let breaks expected reply =
  reply >|= function
  | Error why when String.length why > String.length expected ->
    Alcotest.(check string) "reply" expected (String.sub why 0 (String.length expected))
  | reply -> Alcotest.(check (result value string)) "reply" (Error expected) reply

let broken name ?timeout command expected =
  case name (fun () ->
      with_host ?timeout command (fun host ->
          call host "f" |> breaks expected >>= fun () ->
          (* From then on it is not asked again. *)
          call host "f" |> breaks expected))

let reply text = Printf.sprintf "read -r request; echo '%s'; read -r request; echo '{\"id\":2,\"value\":1}'" text

let broken_hosts =
  [ broken "a host that dies" "read -r request; exit 3" "the host process ended with exit status 3";
    broken "a host that was dead" "exit 4" "the host process ended with exit status 4";
    broken "a host that is killed" "read -r request; kill -KILL $$" "the host process was killed by SIGKILL";
    broken "a host that is no command" "/nonexistent/host 2>/dev/null" "the host process ended with exit status 127";
    broken "a host that leaves its output to another" "sleep 10 & exit 5" "the host process ended with exit status 5";
    broken "a host that closes its output" "exec >&-; sleep 10" "the host process closed its output";
    broken "a host that hangs" ~timeout:0.2 "sleep 10" "the host process did not reply within 0.2 seconds";
    broken "a host that writes nonsense" (reply "hello")
      "the host process replied \"hello\", which is not JSON: ";
    broken "a host that replies a bare value" (reply "3") "the host process replied \"3\", which is not an object";
    broken "a host that replies without id" (reply "{\"value\":1}")
      "the host process replied \"{\\\"value\\\":1}\", which has no id";
    broken "a host that replies to another request" (reply "{\"id\":2,\"value\":1}")
      "the host process replied \"{\\\"id\\\":2,\\\"value\\\":1}\", to request 2, but request 1 is open";
    broken "a host that replies nothing" (reply "{\"id\":1}")
      "the host process replied \"{\\\"id\\\":1}\", which has neither a value nor an error";
    broken "a host that replies no value" (reply "{\"id\":1,\"value\":{\"task\":1}}")
      "the host process replied \"{\\\"id\\\":1,\\\"value\\\":{\\\"task\\\":1}}\", which is not a value for a program: \
       the name of a task is expected, not 1";
    broken "a host that writes without end" "yes | tr -d '\\n'"
      "the host process's reply is longer than 1048576 bytes" ]

let takes_long_lines () =
  let x = String.make 1_000_000 'x' in
  let many = "head -c 1000000 /dev/zero | tr '\\0' x" in
  let command = "read -r request; printf '{\"id\":1,\"value\":\"'; " ^ many ^ "; echo '\"}'" in
  with_host command (fun host -> call host "f" |> gives (String x))

(* The request does not fit into the pipe: the write waits, and the time-out holds for it too. *)
let sends_in_vain () =
  with_host ~timeout:0.2 "sleep 10" (fun host ->
      call ~arguments:[ String (String.make 1_000_000 'x') ] host "f"
      |> fails "the host process did not reply within 0.2 seconds")

let can_be_cancelled () =
  with_host "sleep 10" (fun host ->
      let reply = call host "f" in
      Lwt_unix.sleep 0.05 >>= fun () ->
      Lwt.cancel reply;
      Alcotest.(check bool) "cancelled" true (Lwt.state reply = Lwt.Fail Lwt.Canceled);
      call host "f" |> fails "an earlier call was interrupted")

let exists pid = match Unix.kill pid 0 with () -> true | exception Unix.Unix_error (Unix.ESRCH, _, _) -> false

(* Whether it no longer runs: an orphan may wait for being reaped by its new parent. *)
let is_over pid =
  let is_zombie () =
    let input = open_in (Printf.sprintf "/proc/%d/stat" pid) in
    let line = Fun.protect ~finally:(fun () -> close_in input) (fun () -> input_line input) in
    match Str.search_forward (Str.regexp_string ") Z ") line 0 with _ -> true | exception Not_found -> false
  in
  (not (exists pid)) || (try is_zombie () with Sys_error _ | End_of_file -> not (exists pid))

let rec eventually ?(attempts = 200) what holds =
  if holds () then Lwt.return_unit
  else if attempts = 0 then Alcotest.fail what
  else Lwt_unix.sleep 0.01 >>= fun () -> eventually ~attempts:(attempts - 1) what holds

(* The host prints its process and that of a child; both are gone after the end. *)
let leaves_nothing behaviour () =
  let pids = ref [] in
  let command =
    behaviour
    ^ "\nsleep 60 & read -r request; echo '{\"id\":1,\"value\":['$$,$!']}'; while :; do sleep 1; done"
  in
  with_host command (fun host ->
      call host "pids" >|= function
      | Ok (List xs) ->
        let pid : Core.value -> int = function Integer n -> n | x -> Alcotest.fail (Value.to_string x) in
        pids := List.map pid (Vector.to_list xs)
      | Ok x -> Alcotest.failf "replied %s" (Value.to_string x)
      | Error why -> Alcotest.fail why);
  Alcotest.(check bool) "the host is reaped" true (not (exists (List.hd !pids)));
  Lwt_main.run (eventually "a process is left" (fun () -> List.for_all is_over !pids))

let ends_politely () =
  let file = Filename.temp_file "dolphin" ".host" in
  with_host (Printf.sprintf "while read -r request; do :; done; echo bye > %s" (Filename.quote file)) (fun _ ->
      Lwt.return_unit);
  let input = open_in file in
  let text = input_line input in
  close_in input;
  Sys.remove file;
  Alcotest.(check string) "its last words" "bye" text

let tests =
  [ case "values become JSON" writes_values;
    case "some values stay" keeps_values;
    case "JSON becomes values" reads_values;
    case "values come back the same" round_trip;
    case "bad JSON is refused" refuses_values;
    case "requests and replies" speaks;
    case "the protocol's version" knows_version;
    case "a reply of almost 1 MiB" takes_long_lines;
    case "a request that nobody reads" sends_in_vain;
    case "a call can be cancelled" can_be_cancelled;
    case "a host may end by itself" ends_politely;
    case "a host is terminated, with its children" (leaves_nothing "");
    case "a host that does not want to end is killed" (leaves_nothing "trap '' TERM") ]
  @ broken_hosts
