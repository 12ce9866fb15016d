(* [extract PAGE FOLDER] prints a test: a case for each worked example, the text between {[ and ]} in a doc comment, of
   the interfaces (mli files) below FOLDER. The compiler and failed assertions name the place in the interface.

   PAGE, docs/architecture.md, lists the interfaces that have examples: the exit status is 1 if its list has another
   one, or leaves one out. *)

let read path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let lines path = String.split_on_char '\n' (read path)

(* Folders of the compiler's outputs begin with a point. *)
let rec interfaces folder =
  let of_name name =
    let path = Filename.concat folder name in
    if name.[0] = '.' then []
    else if Filename.check_suffix name ".mli" then [ path ]
    else if Sys.is_directory path then interfaces path
    else []
  in
  List.concat_map of_name (List.sort String.compare (Array.to_list (Sys.readdir folder)))

let has_mark line =
  let rec from i = i + 1 < String.length line && (String.sub line i 2 = "{[" || from (i + 1)) in
  from 0

(* Line by line: the examples, each with the number of its first line. Their marks stand alone on lines, but for the
   end of the comment. *)
let examples path =
  let rec outside n = function
    | [] -> []
    | line :: rest when String.trim line = "{[" -> inside (n + 1) (n + 1) [] rest
    | line :: _ when has_mark line -> failwith (Printf.sprintf "%s:%d: {[ stands alone on its line" path n)
    | _ :: rest -> outside (n + 1) rest
  and inside first n example = function
    | [] -> failwith (Printf.sprintf "%s:%d: the example has no end" path first)
    | line :: rest when List.mem (String.trim line) [ "]}"; "]} *)" ] ->
      (first, List.rev example) :: outside (n + 1) rest
    | line :: rest -> inside first (n + 1) (line :: example) rest
  in
  outside 1 (lines path)

let print_case path (first, example) =
  Printf.printf "      Alcotest.test_case \"line %d\" `Quick (fun () ->\n" first;
  Printf.printf "          let module _ = struct\n# %d %S\n" first path;
  List.iter print_endline example;
  print_endline "end in\n          ());"

(* The interfaces in the table of the section "Start here". *)
let listed page =
  let rec skip = function
    | [] -> []
    | "## Start here" :: rest -> rest
    | _ :: rest -> skip rest
  in
  let rec section = function
    | [] -> []
    | line :: _ when String.length line > 2 && String.sub line 0 3 = "## " -> []
    | line :: rest -> line :: section rest
  in
  let is_interface word = Filename.check_suffix word ".mli" in
  List.concat_map (fun line -> List.filter is_interface (String.split_on_char '`' line)) (section (skip (lines page)))

(* As the page has it, from the root of the project. *)
let from_root folder path =
  let length = String.length folder in
  Filename.concat "lib" (String.sub path (length + 1) (String.length path - length - 1))

let () =
  let page, folder =
    match Array.to_list Sys.argv with
    | [ _; page; folder ] -> page, folder
    | _ -> failwith "arguments: a page, a folder"
  in
  let of_interface path =
    match examples path with [] -> None | examples -> Some (from_root folder path, examples)
  in
  let all = List.filter_map of_interface (interfaces folder) in
  let listed = List.sort String.compare (listed page) in
  if listed <> List.map fst all then begin
    let missing = List.filter (fun (path, _) -> not (List.mem path listed)) all in
    let surplus = List.filter (fun path -> not (List.mem_assoc path all)) listed in
    List.iter (fun (path, _) -> prerr_endline (path ^ " has an example: list it in docs/architecture.md")) missing;
    List.iter (fun path -> prerr_endline (path ^ ", listed once or more, has no example")) surplus;
    exit 1
  end;
  print_endline "let () =\n  Alcotest.run \"examples of interfaces\" [";
  let print (path, examples) =
    Printf.printf "    (%S, [\n" path;
    List.iter (print_case path) examples;
    print_endline "    ]);"
  in
  List.iter print all;
  print_endline "  ]"
