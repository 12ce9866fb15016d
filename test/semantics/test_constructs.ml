open Dolphin_semantics
open Dolphin_syntax
open Test_support

(* The table of constructs is that of the language: lib/syntax/construct.ml. *)

let strings = Alcotest.(list string)
let case name f = Alcotest.test_case name `Quick f

let reserved () =
  let of_table = List.filter Construct.is_reserved Construct.words in
  let spellings = List.map (fun (word : Construct.word) -> word.spelling) in
  Alcotest.check strings "no reserved word is a name" []
    (List.filter Cursor_context.is_name (spellings of_table));
  let names = List.filter (fun word -> not (Construct.is_reserved word)) Construct.words in
  Alcotest.check strings "the others are names" []
    (List.filter (fun x -> not (Cursor_context.is_name x)) (spellings names));
  Alcotest.check strings "the scanner has them" (List.sort String.compare (spellings of_table)) Cursor_context.words

let rules () = Alcotest.check strings "in order" (List.map Rule.name Rule.all) Construct.rules

let once () =
  let names = List.map (fun (row : Construct.t) -> row.name) Construct.all in
  Alcotest.(check int) "no row twice" (List.length names) (List.length (List.sort_uniq String.compare names))

(* {1 Examples} *)

let before = "v = pick { type 'UUV' }\n"
let is_task row = List.memq row Construct.tasks

let has text part =
  let n = String.length part in
  let rec from i = i + n <= String.length text && (String.sub text i n = part || from (i + 1)) in
  from 0

let are_programs () =
  let fault (row : Construct.t) =
    match Pure_run.compile (before ^ row.example) with
    | Ok _ -> None
    | Error ds when is_task row ->
      Option.map (fun _ -> Pure_run.explain row.example ds)
        (Result.fold ~ok:(fun _ -> None) ~error:Option.some (Pure_run.compile (before ^ "execute " ^ row.example)))
    | Error ds -> Some (Pure_run.explain row.example ds)
  in
  Alcotest.check strings "each example is right" [] (List.filter_map fault Construct.all);
  let lacks (row : Construct.t) =
    row.words <> [] && not (List.exists (fun (word : Construct.word) -> has row.example word.spelling) row.words) in
  let lacking = List.filter lacks Construct.all in
  Alcotest.check strings "each has a word of its row" [] (List.map (fun (row : Construct.t) -> row.name) lacking)

(* The task that [example] is as part of another one: the script assigns that, and pauses. *)
let value example =
  let program = Pure_run.compile_exn (before ^ "t = (" ^ example ^ ") >> idle(1)\npause 1") in
  let run = Pure_run.run ~limit:4 program in
  let part (_, x) = match x with Core.Task (Sequence (t, _)) -> Some t | _ -> None in
  let of_store (c : Configuration.t) = List.find_map part (Store.bindings c.shared.store) in
  match Option.bind (Pure_run.last run) of_store with
  | Some t -> t
  | None -> Alcotest.failf "%s is not a task" example

(* The numbers of tasks and of pieces of code that a term has as parts. *)
let parts t =
  let tasks = ref 0 and code = ref 0 in
  let part t = incr tasks; t and closure c = incr code; c in
  ignore (Task.map { part; code = closure; value = Fun.id; vehicle = Fun.id } t);
  (!tasks, !code)

let have_parts () =
  let count kinds (row : Construct.t) =
    List.length (List.filter (fun (p : Construct.part) -> List.mem p.kind kinds) row.parts) in
  let check (row : Construct.t) =
    if row.name <> "made" then begin
      let tasks, code = parts (value row.example) in
      let many = List.exists (fun (p : Construct.part) -> p.many) row.parts in
      let task_parts = count [ Task; Later ] row and code_parts = count [ Guard; Code; Handler; Maker ] row in
      let at_most = code_parts + count [ Duration; Pairs ] row in
      let fits = tasks = task_parts && code_parts <= code && code <= at_most in
      let fits = if many then tasks >= task_parts && code >= code_parts else fits in
      if not fits then Alcotest.failf "%s has %d tasks and %d pieces of code as parts" row.name tasks code
    end
  in
  List.iter check Construct.tasks

let () =
  Alcotest.run "constructs"
    [ ("words", [ case "reserved" reserved ]);
      ("rows", [ case "rules" rules; case "no name twice" once ]);
      ("examples", [ case "are programs" are_programs; case "have their parts" have_parts ]) ]
