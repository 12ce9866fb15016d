open Dolphin_trace

let case name test = Alcotest.test_case name `Quick test
let show verdict = Format.asprintf "@[<v>%a@]" Verdict.pp verdict

(* A journal without what tells that there were two consoles: which samples were written, and when there was a new one. *)
let story journal =
  let is_told line =
    match Entry.of_string line with
    | Ok (Header _ | Event _ | Transition _ | End _) -> true
    | Ok (Vehicle _ | Note _ | Resumed _) | Error _ -> false
  in
  List.filter is_told (Runs.lines journal)

let resumes (r : Runs.t) ~at text =
  match Runs.resume r text with
  | Error why -> Alcotest.failf "%s, resumed at %d: %s" r.name at why
  | Ok joined ->
    (match Runs.check_text r joined with
     | Run _ -> ()
     | verdict -> Alcotest.failf "%s, resumed at %d: %s" r.name at (show verdict));
    if story joined <> story r.journal then begin
      let differs a b = a <> b in
      let rec first a b =
        match a, b with
        | x :: a, y :: b -> if differs x y then (x, y) else first a b
        | x :: _, [] -> (x, "nothing")
        | [], y :: _ -> ("nothing", y)
        | [], [] -> ("", "")
      in
      let expected, found = first (story r.journal) (story joined) in
      Alcotest.failf "%s, resumed at %d, goes on otherwise:\n%s\nnot\n%s" r.name at found expected
    end

(* In virtual time a run that was broken off, wherever that was, goes on as if nothing had happened. *)
let at_each_line (r : Runs.t) =
  let lines = Runs.lines r.journal in
  for i = 1 to List.length lines - 1 do
    resumes r ~at:i (Runs.text (List.filteri (fun j _ -> j < i) lines))
  done

let examples () = List.iter (fun name -> at_each_line (Runs.run name)) Runs.examples

let () = Alcotest.run "resume" [ ("resume", [ case "after each line of the examples" examples ]) ]
