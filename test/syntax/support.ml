open Dolphin_syntax

let read_file path =
  let channel = open_in_bin path in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

let pp_faults source ppf faults =
  List.iter (fun fault -> Format.fprintf ppf "@[<v>%a@]@." (Diagnostic.pp ~source) fault) faults

let told ~file source =
  match Parse.program ~file source with
  | Ok _ -> "no fault\n"
  | Error faults -> Format.asprintf "%a" (pp_faults source) faults

let parse source =
  match Parse.program ~file:"test.dol" source with
  | Ok program -> program
  | Error faults -> Alcotest.failf "%s@.%a" source (pp_faults source) faults

let printed program = Format.asprintf "%a" Print.program program

(* Two programs are the same if they differ in locations only. *)
let same = Alcotest.testable Print.program (fun p q -> Erase.program p = Erase.program q)
