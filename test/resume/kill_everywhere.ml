(* Not part of the tests, as it takes some minutes: kill_everywhere.exe [KILLS [LOAD [losing]]]. Without KILLS each
   point is taken once; LOAD processes take time meanwhile; losing: journals lose their ends. *)

let () =
  let argument i = if Array.length Sys.argv > i then Some (int_of_string Sys.argv.(i)) else None in
  let is_losing = Array.length Sys.argv > 3 && Sys.argv.(3) = "losing" in
  match Resume_test.Kills.run ?load:(argument 2) ~is_losing (argument 1) with
  | Ok summary -> print_endline summary
  | Error summary -> print_endline summary; exit 1
