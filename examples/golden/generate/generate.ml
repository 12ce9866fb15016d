(* Each example runs on the fleet beside it; a script beside it, NAME.py, is its supplier. Its output is as before,
   and its steps are a run by the semantics. *)
let rule ~has_supplier name =
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
     (run %%{exe:../../bin/dolphin.exe} exec %%{dep:../%s.dol} --journal examples/golden/%s.run%s))))))

(rule
 (alias runtest)
 (package dolphin)
 (action
  (progn
   (diff %s.log %s.output)
   (echo "passed: examples/golden/%s.log\n"))))

(rule
 (alias runtest)
 (package dolphin)
 (action
  (system
   "verdict=$(%%{exe:../../bin/dolphin.exe} trace check %%{dep:../%s.dol} %%{dep:%s.run}) ||
    { echo $verdict; exit 1; }")))
|}
    name name name name name name supplier name name name name name

let () =
  let files = List.map Filename.basename (List.tl (Array.to_list Sys.argv)) in
  let example file = if Filename.check_suffix file ".dol" then Some (Filename.chop_suffix file ".dol") else None in
  let names = List.sort String.compare (List.filter_map example files) in
  print_string "; Made by generate/generate.ml; dune promote brings it up to date.\n";
  List.iter (fun name -> rule ~has_supplier:(List.mem (name ^ ".py") files) name) names
