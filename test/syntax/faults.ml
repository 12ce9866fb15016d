(* Prints the diagnostics of each snippet of a file; [---] separates them. *)

let () =
  let rec split snippet = function
    | [] -> [ snippet ]
    | "---" :: lines -> snippet :: split [] lines
    | line :: lines -> split (line :: snippet) lines
  in
  let show lines =
    let source = String.concat "\n" (List.rev lines) ^ "\n" in
    print_string ("---\n" ^ source ^ "===\n" ^ Support.told ~file:"p.dol" source)
  in
  List.iter show (split [] (String.split_on_char '\n' (String.trim (Support.read_file Sys.argv.(1)))))
