(* Blocks of the manual, by the words after the three backquotes:
   - "groovy": a program, which has to end well;
   - "groovy given": the beginning of every further program of its chapter (##);
   - "groovy supplied": a program for the supplier of the examples;
   - "fleet": a fleet, for the programs that follow in its chapter;
   - "text", right after one of these: the output of the program, and its errors and warnings. *)

type kind = Program | Given | Supplied | Fleet
type block = {
  kind : kind;
  line : int;
  text : string;
  expected : string list option;
  given : string;
  fleet : string option;
}

(* {1 Reading the manual} *)

let lines_of path =
  let channel = open_in_bin path in
  let contents = really_input_string channel (in_channel_length channel) in
  close_in channel;
  String.split_on_char '\n' contents

let starts_with prefix s =
  String.length s >= String.length prefix && String.sub s 0 (String.length prefix) = prefix

(* The fenced blocks and headings, with their lines. *)
type piece = Heading of string | Fenced of { info : string; line : int; body : string list } | Prose

let pieces lines =
  let fence line = starts_with "```" line in
  let rec go n reversed = function
    | [] -> List.rev reversed
    | line :: rest when fence line ->
      let info = String.sub line 3 (String.length line - 3) in
      let rec body reversed_body m = function
        | [] -> failwith (Printf.sprintf "line %d: this block does not end" n)
        | line :: rest when fence line -> (List.rev reversed_body, m + 1, rest)
        | line :: rest -> body (line :: reversed_body) (m + 1) rest
      in
      let lines, next, rest = body [] (n + 1) rest in
      go next (Fenced { info; line = n; body = lines } :: reversed) rest
    | line :: rest when starts_with "## " line -> go (n + 1) (Heading line :: reversed) rest
    | line :: rest when String.trim line = "" -> go (n + 1) reversed rest
    | _ :: rest -> go (n + 1) (Prose :: reversed) rest
  in
  go 1 [] lines

let kind_of = function
  | "groovy" -> Some Program
  | "groovy given" -> Some Given
  | "groovy supplied" -> Some Supplied
  | "fleet" -> Some Fleet
  | _ -> None

let blocks pieces =
  let rec go ~given ~fleet reversed = function
    | [] -> List.rev reversed
    | Prose :: rest -> go ~given ~fleet reversed rest
    | Heading _ :: rest -> go ~given:"" ~fleet:None reversed rest
    | Fenced { info; line; body } :: rest -> (
        let text = String.concat "\n" body ^ "\n" in
        let expected, rest =
          match rest with
          | Fenced { info = "text"; body; _ } :: rest -> (Some body, rest)
          | rest -> (None, rest)
        in
        match kind_of info with
        | None -> go ~given ~fleet reversed rest
        | Some kind ->
          let block = { kind; line; text; expected; given; fleet } in
          let given = if kind = Given then given ^ text else given in
          let fleet = if kind = Fleet && expected = None then Some text else fleet in
          go ~given ~fleet (block :: reversed) rest)
  in
  go ~given:"" ~fleet:None [] pieces

(* {1 Running an example} *)

let write path text =
  let channel = open_out_bin path in
  output_string channel text;
  close_out channel

(* The rest of [line] after [marker]. *)
let after marker line =
  let n = String.length marker in
  let rec at i =
    if i + n > String.length line then None
    else if String.sub line i n = marker then Some (String.sub line (i + n) (String.length line - i - n))
    else at (i + 1)
  in
  at 0

let said line = after "program     says: " line

let complaint line =
  match after ": error: " line, after ": warning: " line with
  | Some text, _ -> Some ("error: " ^ text)
  | None, Some text -> Some ("warning: " ^ text)
  | None, None -> None

let halted line = Option.map (fun why -> "halted: " ^ why) (after "program     halts: " line)

let run dolphin supplier block () =
  let name = Printf.sprintf "line_%d" block.line in
  let program = name ^ ".dol" and fleet = name ^ ".fleet" in
  let text, scenario =
    match block.kind with
    | Fleet -> ("", Some block.text)
    | Program | Given | Supplied -> (block.given ^ block.text, block.fleet)
  in
  write program text;
  Option.iter (write fleet) scenario;
  let options =
    (match scenario with Some _ -> [ "--fleet"; fleet ] | None -> [])
    @ match block.kind with Supplied -> [ "--supplier"; Filename.quote supplier ] | Program | Given | Fleet -> []
  in
  let stdout = name ^ ".out" and stderr = name ^ ".err" in
  let command = Filename.quote_command dolphin ([ "exec"; program ] @ options) ~stdin:"/dev/null" ~stdout ~stderr in
  let status = Sys.command command in
  let output = lines_of stdout and errors = lines_of stderr in
  let told = List.filter_map said output @ List.filter_map halted output @ List.filter_map complaint errors in
  let is_error line = starts_with "error: " line || starts_with "halted: " line in
  let expected_to_fail = match block.expected with Some expected -> List.exists is_error expected | None -> false in
  if (status <> 0) <> expected_to_fail then
    Alcotest.failf "status %d\n%s\n%s" status (String.concat "\n" output) (String.concat "\n" errors);
  Option.iter (fun expected -> Alcotest.(check (list string)) "what it says" expected told) block.expected

let () =
  match Sys.argv with
  | [| program; dolphin; manual; supplier |] ->
    let absolute path = if Filename.is_relative path then Filename.concat (Sys.getcwd ()) path else path in
    let case block =
      Alcotest.test_case (Printf.sprintf "language.md:%d" block.line) `Quick
        (run (absolute dolphin) (absolute supplier) block)
    in
    Alcotest.run ~argv:[| program |] "manual" [ ("examples", List.map case (blocks (pieces (lines_of manual)))) ]
  | _ -> failwith "usage: test_manual DOLPHIN MANUAL SUPPLIER"
