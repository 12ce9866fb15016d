open Dolphin_trace

let case name test = Alcotest.test_case name `Quick test
let show verdict = Format.asprintf "@[<v>%a@]" Journal_verdict.pp verdict
let entry line = match Entry.of_string line with Ok entry -> entry | Error why -> failwith why

(* Labels of these kinds, and lines that cannot be hidden; of vehicles, new states. *)
let partial ~observed journal =
  let is_observed label = observed = [] || List.mem (Partial.kind label) observed in
  let cause = ref None in
  let line text =
    match entry text with
    | Header _ -> [ Entry.Partial { observed } ]
    | Event { event = Answer _ | No_answer _ | Reply _ | No_reply _ | Input _ | Interruption { stuck = false }; _ }
      as event ->
      cause := Some event;
      []
    | Transition { step; time; _ } ->
      let caused = Option.to_list !cause in
      cause := None;
      if caused <> [] then caused else if is_observed step.label then [ Label { time; label = step.label } ] else []
    | Vehicle _ as vehicle -> [ vehicle ]
    | End _ as last -> [ last ]
    | Event _ | Partial _ | Label _ | Note _ | Act _ | Resumed _ -> []
  in
  Runs.text (List.map (fun entry -> Entry.to_string entry) (List.concat_map line (Runs.lines journal)))

let ends = [ "start"; "done"; "fail" ]

(* Where vehicles take goals from each other, runs with these labels are too many to be followed here. *)
let examples = List.filter (fun name -> name <> "priorities") Runs.examples
let runs = lazy (List.map (fun name -> Runs.run ~period:1e9 name) examples)

let all_possible ?(without = []) observed () =
  let check (r : Runs.t) =
    match Runs.check_text r (partial ~observed r.journal) with
    | Possible { over = true; _ } -> ()
    | verdict -> Alcotest.failf "%s: %s" r.name (show verdict)
  in
  List.iter check (List.filter (fun (r : Runs.t) -> not (List.mem r.name without)) (Lazy.force runs))

(* Traces that no run of the program can have. *)
let impossible name r text lines =
  let expected = String.concat "\n" lines in
  match Runs.check_text r text with
  | Impossible _ as verdict -> Alcotest.(check string) name expected (show verdict)
  | verdict -> Alcotest.failf "%s: %s" name (show verdict)

let header = {|{"format":"dolphin-journal","version":1,"observed":["start","done"]}|}

let vehicle =
  {|{"kind":"vehicle","time":0,"vehicle":"v","type":"UUV","payload":[],|}
  ^ {|"latitude":41,"longitude":-8,"height":0,"battery":1,"connected":true}|}

let label text = Printf.sprintf {|{"kind":"label","label":"%s"}|} text
let program = Runs.of_text "v = pick { type 'UUV' }\nexecute task('a')[v] >> idle(5.seconds) >> task('b')[v]"
let trace lines = Runs.text (header :: vehicle :: lines)

let wrong () =
  impossible "b before a" program
    (trace [ label "start(v, b)" ])
    [ "line 3 does not fit any run: start(v, b)"; "start(v, b) could not happen";
      "possible here: start(v, a)"; "before it: 0 lines" ];
  impossible "twice" program
    (trace [ label "start(v, a)"; label "done(v, a)"; label "start(v, a)" ])
    [ "line 5 does not fit any run: start(v, a)"; "start(v, a) could not happen";
      "possible here: start(v, b)"; "before it: 2 lines" ];
  impossible "what it does not tell" program
    (trace [ label "timeout" ])
    [ "line 3 does not fit any run: timeout"; "labels like timeout are not among those that this trace has";
      "possible here: nothing"; "before it: 0 lines" ]

let beginnings () =
  let check lines =
    match Runs.check_text program (trace lines) with
    | Possible { over = false; lines = n } -> Alcotest.(check int) "lines" (List.length lines) n
    | verdict -> Alcotest.fail (show verdict)
  in
  check [];
  check [ label "start(v, a)" ];
  check [ label "start(v, a)"; label "done(v, a)"; label "start(v, b)"; label "done(v, b)" ]

(* A failure has a reason, which is in its label. *)
let failures () =
  let r = Runs.of_text "v = pick { type 'UUV' }\nexecute watch (task('a')[v]) onError { ignore() }" in
  let text observed lines =
    Runs.text
      (Printf.sprintf {|{"format":"dolphin-journal","version":1,"observed":%s}|} observed :: vehicle :: lines)
  in
  let possible text = match Runs.check_text r text with Possible _ -> () | verdict -> Alcotest.fail (show verdict) in
  possible (text {|["start","fail"]|} [ label "start(v, a)"; label "fail(v, a, no (more) fuel)" ]);
  possible (text {|["start","end"]|} [ label "start(v, a)"; label "end" ])

(* With more possible hidden steps than can be searched, the check has no result. *)
let unknown () =
  let branches = String.concat " | " (List.init 9 (fun i -> Printf.sprintf "(idle(1) >> action { post x%d: 1 })" i)) in
  let r = Runs.of_text (Printf.sprintf "execute %s\nmessage 'over'" branches) in
  let text =
    Runs.text [ {|{"format":"dolphin-journal","version":1,"observed":["message"]}|}; label "message 'over'" ]
  in
  let check most = snd (Journal_verdict.check ~most r.program ~hash:r.hash (Journal.of_string text)) in
  (match check 1000 with Unknown { number = 2; most = 1000 } -> () | verdict -> Alcotest.fail (show verdict));
  match check 100_000 with Possible _ -> () | verdict -> Alcotest.fail (show verdict)

let () =
  Alcotest.run "partial traces"
    [ ( "partial",
        [ case "labels of all examples" (all_possible []);
          case "starts and ends of all examples" (all_possible ends);
          (* In each of these so many steps are hidden that it takes longer than all others. *)
          case "only starts" (all_possible [ "start" ] ~without:[ "rotation"; "recruit" ]);
          case "what is no trace of a run" wrong;
          case "beginnings" beginnings;
          case "failures" failures;
          case "too much is hidden" unknown ] ) ]
