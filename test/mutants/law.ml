(* usage: law.exe OCAMLC FILE.mli FILE.ml LAW.ml FROM UNTIL EACH

   Makes every EACH-th mutation of FILE.ml from the text FROM until the text UNTIL, one at a time, compiles it with
   LAW.ml, a program that needs nothing else and fails if FILE.ml is wrong, and prints the verdicts. Fails if the law
   fails without a mistake. Those that are not noticed are to be equivalent to FILE.ml. *)

let read = Working_copy.read

let write path text =
  let channel = open_out_bin path in
  output_string channel text;
  close_out channel

let silently command = Sys.command (command ^ " >/dev/null 2>&1") = 0

type verdict = Not_built | Noticed | Passed

(* A mistake may let the law run without end. *)
let verdict ~ocamlc ~interface ~law folder ~name text =
  let path suffix = Filename.concat folder (name ^ suffix) in
  write (path ".mli") interface;
  write (path ".ml") text;
  write (Filename.concat folder "law.ml") law;
  let compile = Printf.sprintf "cd %s && %s -w -a+8 -warn-error +8 %s.mli %s.ml law.ml -o law" folder ocamlc name name in
  if not (silently compile) then Not_built
  else if silently (Printf.sprintf "cd %s && ulimit -t 5 && ./law" folder) then Passed
  else Noticed

let in_a_folder f =
  let folder = Filename.temp_file "law" "" in
  Sys.remove folder;
  Unix.mkdir folder 0o700;
  Fun.protect ~finally:(fun () -> ignore (silently ("rm -rf " ^ folder))) (fun () -> f folder)

let word = function Not_built -> "does not build" | Noticed -> "noticed" | Passed -> "NOT NOTICED"

let rec position part ?(from = 0) text =
  let n = String.length part in
  if from + n > String.length text then raise Not_found
  else if String.equal (String.sub text from n) part then from
  else position part ~from:(from + 1) text

(* Indices are checked: a wrong one has the same effect each time. *)
let rec checked source =
  match position "unsafe_" source with
  | exception Not_found -> source
  | i ->
    let after = i + String.length "unsafe_" in
    checked (String.sub source 0 i ^ String.sub source after (String.length source - after))

let judge ~ocamlc ~interface ~file ~law ~from ~until ~each =
  let name = Filename.remove_extension (Filename.basename file) in
  let source = checked (read file) and interface = read interface and law = read law in
  in_a_folder (fun folder ->
      let verdict = verdict ~ocamlc ~interface ~law folder ~name in
      if verdict source <> Passed then failwith "the law fails without a mistake";
      let first = position from source and last = position until source in
      let is_between (m : Mutation.t) = m.first >= first && m.after <= last in
      let is_chosen i _ = i mod each = 0 in
      let print (m : Mutation.t) =
        let text = Mutation.apply m source in
        Printf.printf "%s, %s\n%s" (Mutation.name m.kind) (word (verdict text)) (Mutation.difference source text)
      in
      List.iter print (List.filteri is_chosen (List.filter is_between (Mutation.all source))))

let () =
  match Sys.argv with
  | [| _; ocamlc; interface; file; law; from; until; each |] ->
    judge ~ocamlc ~interface ~file ~law ~from ~until ~each:(int_of_string each)
  | _ -> prerr_endline "usage: law.exe OCAMLC FILE.mli FILE.ml LAW.ml FROM UNTIL EACH"; exit 2
