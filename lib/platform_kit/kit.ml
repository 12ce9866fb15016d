open Lwt.Infix

type plans = Situations.plans = { short : string; long : string; vehicle : string option; patience : float }

type verdict = {
  name : string;
  what : string;
  wrong : string option;
  remark : string option;
  transcript : string list;
  seconds : float;
}

let names = List.map (fun (s : Situations.t) -> (s.name, s.what)) Situations.all

(* A line that is not a report is wrong in any situation, unless a worse fault was found. *)
let judged talks outcome =
  match outcome, List.concat_map Talk.faults talks with
  | Error why, _ -> (Some why, None)
  | Ok _, why :: _ -> (Some why, None)
  | Ok remark, [] -> (None, remark)

let check goes_on = if not (goes_on ()) then raise Lwt.Canceled

let one plans ~goes_on command (s : Situations.t) =
  let began = Unix.gettimeofday () in
  let talks = ref [] in
  (* A script that was cancelled while it ended one adapter starts the next one. *)
  let started t = talks := t :: !talks; check goes_on in
  Lwt.finalize
    (fun () ->
       Lwt.catch
         (fun () -> s.script plans ~started command >|= fun remark -> Ok remark)
         (function Talk.Wrong why -> Lwt.return (Error why) | error -> Lwt.fail error)
       >|= fun outcome ->
       let wrong, remark = judged (List.rev !talks) outcome in
       let transcript = if wrong = None then [] else List.concat_map Talk.transcript (List.rev !talks) in
       { name = s.name; what = s.what; wrong; remark; transcript; seconds = Unix.gettimeofday () -. began })
    (fun () -> Lwt_list.iter_s Talk.finish !talks)

let judge plans ~only ~goes_on tell command =
  let is_wanted (s : Situations.t) = only = [] || List.mem s.name only in
  let judge s =
    check goes_on;
    one plans ~goes_on command s >|= fun verdict -> tell verdict; verdict
  in
  Lwt_list.map_s judge (List.filter is_wanted Situations.all)

(* {1 JUnit} *)

type tree = Element of string * (string * string) list * tree list | Text of string

let rec output out = function
  | Text text -> Xmlm.output out (`Data (Dolphin_trace.Phrase.harmless text))
  | Element (name, attributes, inside) ->
    let attribute (name, value) = (("", name), Dolphin_trace.Phrase.one_line value) in
    Xmlm.output out (`El_start (("", name), List.map attribute attributes));
    List.iter (output out) inside;
    Xmlm.output out `El_end

let case v =
  let failure why = Element ("failure", [ ("message", why) ], [ Text (String.concat "\n" v.transcript) ]) in
  Element
    ( "testcase",
      [ ("classname", "dolphin platform check"); ("name", v.name ^ ": " ^ v.what);
        ("time", Printf.sprintf "%.3f" v.seconds) ],
      List.map failure (Option.to_list v.wrong) )

let to_junit ~command verdicts =
  let failures = List.length (List.filter (fun v -> v.wrong <> None) verdicts) in
  let suite =
    Element
      ( "testsuite",
        [ ("name", command); ("tests", string_of_int (List.length verdicts)); ("failures", string_of_int failures) ],
        List.map case verdicts )
  in
  let text = Buffer.create 4096 in
  let out = Xmlm.make_output ~nl:true ~indent:(Some 2) (`Buffer text) in
  Xmlm.output out (`Dtd None);
  output out suite;
  Buffer.contents text
