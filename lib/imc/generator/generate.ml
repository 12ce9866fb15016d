(* generate DEF INTERFACE IMPLEMENTATION: writes the typed messages of the definition file DEF. *)

open Dolphin_imc_definition

let read path =
  let channel = open_in_bin path in
  Fun.protect
    ~finally:(fun () -> close_in_noerr channel)
    (fun () -> really_input_string channel (in_channel_length channel))

let write path text =
  let channel = open_out_bin path in
  Fun.protect ~finally:(fun () -> close_out_noerr channel) (fun () -> output_string channel text)

let () =
  match Sys.argv with
  | [| _; def; interface; implementation |] -> (
      match Def_file.parse (read def) with
      | Error error ->
        Format.eprintf "%s: %a@." def Def_file.pp_error error;
        exit 2
      | Ok definition -> (
          match Outline.make definition with
          | exception Outline.Unsupported why ->
            Format.eprintf "%s: not supported: %s@." def why;
            exit 2
          | outline ->
            write interface (Code.to_string (Interface.code outline));
            write implementation (Code.to_string (Implementation.code outline))))
  | _ ->
    prerr_endline "usage: generate DEF INTERFACE IMPLEMENTATION";
    exit 2
