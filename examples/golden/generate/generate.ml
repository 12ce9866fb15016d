(* generate.exe FOLDER ROOT FILE...: the rules of FOLDER, from which ROOT is the way up to the root of the tree.

   Each example runs on the fleet beside it; a script beside it, NAME.py, is its supplier. Its output is as before,
   and its steps are a run by the semantics. *)
let rule ~folder ~root ~has_supplier name =
  let supplier = if has_supplier then Printf.sprintf "\n      --supplier %%{dep:../%s.py}" name else "" in
  Printf.printf
    {|
(rule
 (targets %s.output %s.run)
 (deps ../%s.fleet)
 (action
  (with-outputs-to
   %s.output
   (with-accepted-exit-codes
    (or 0 1)
    (chdir
     %%{workspace_root}
     (run %%{exe:%s/bin/dolphin.exe} exec %%{dep:../%s.dol} --journal %s/%s.run%s))))))

(rule
 (alias runtest)
 (package dolphin)
 (action
  (progn
   (diff %s.log %s.output)
   (echo "passed: %s/%s.log\n"))))

(rule
 (alias runtest)
 (package dolphin)
 (action
  (system
   "verdict=$(%%{exe:%s/bin/dolphin.exe} trace check %%{dep:../%s.dol} %%{dep:%s.run}) ||
    { echo $verdict; exit 1; }")))
|}
    name name name name root name folder name supplier name name folder name root name name

let () =
  let folder, root, files =
    match Array.to_list Sys.argv with
    | _ :: folder :: root :: files -> (folder, root, List.map Filename.basename files)
    | _ -> failwith "generate.exe FOLDER ROOT FILE..."
  in
  let example file = if Filename.check_suffix file ".dol" then Some (Filename.chop_suffix file ".dol") else None in
  let names = List.sort String.compare (List.filter_map example files) in
  print_string "; Made by generate/generate.ml; dune promote brings it up to date.\n";
  List.iter (fun name -> rule ~folder ~root ~has_supplier:(List.mem (name ^ ".py") files) name) names
