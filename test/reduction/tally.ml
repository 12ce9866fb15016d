open Dolphin_explore

type t = {
  mutable skipped : int;
  mutable whole : int;
  mutable reduced : int;
  mutable smaller : int;
  broken : (Property.t, int) Hashtbl.t;
}

let create () = { skipped = 0; whole = 0; reduced = 0; smaller = 0; broken = Hashtbl.create 7 }

let note t property =
  Hashtbl.replace t.broken property (1 + Option.value (Hashtbl.find_opt t.broken property) ~default:0)

let count t (found : Agreement.t option) =
  match found with
  | None -> t.skipped <- t.skipped + 1
  | Some found ->
    t.whole <- t.whole + found.whole;
    t.reduced <- t.reduced + found.reduced;
    if found.reduced < found.whole then t.smaller <- t.smaller + 1;
    List.iter (note t) found.broken

let agrees t = function
  | Error what -> QCheck2.Test.fail_report what
  | Ok found ->
    if Test_support.Property.is_usual () then count t found;
    true

let print_broken t = Hashtbl.iter (fun p n -> Printf.printf "%s: broken by %d\n" (Property.name p) n) t.broken

let check_broken ?(but = []) t =
  let check property =
    if not (List.mem property (Property.All_reached :: but) || Hashtbl.mem t.broken property) then
      Alcotest.failf "no program breaks: %s" (Property.name property)
  in
  List.iter check Property.all
