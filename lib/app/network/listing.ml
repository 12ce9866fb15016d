open Dolphin_display
open Dolphin_runtime
open Lwt.Infix
module Phrase = Dolphin_trace.Phrase

type t = { head : unit -> string; lines : json:bool -> string list; patience : float }

let print l ~json =
  List.iter (if json then print_endline else Safe_print.line) (l.lines ~json);
  flush stdout

let wait interruption seconds = Lwt.pick [ Interruption.promise interruption; Lwt_unix.sleep seconds ]
let is_over interruption ~until = Interruption.happened interruption || Clock.system.elapsed () >= until

(* A table that changes, on a terminal. *)
let watch l interruption ~until =
  let screen = Screen.make ~live:true ~on_closed:(fun _ -> Interruption.interrupt interruption) Unix.stdout in
  let board ~rows ~columns =
    let all = l.head () :: l.lines ~json:false in
    List.map (fun line -> fst (Phrase.split columns line)) (List.filteri (fun i _ -> i < rows) all)
  in
  Screen.show screen board;
  let rec go () =
    if is_over interruption ~until then Lwt.return_unit
    else begin
      Screen.changed screen;
      wait interruption 1. >>= go
    end
  in
  go () >|= fun () -> Screen.close screen

(* A line of JSON each second. *)
let rec report l interruption ~until =
  if is_over interruption ~until then Lwt.return_unit
  else
    wait interruption 1. >>= fun () ->
    print l ~json:true;
    report l interruption ~until

let show l interruption ~as_json ~once ~seconds =
  let until = Option.fold seconds ~none:infinity ~some:(fun seconds -> Clock.system.elapsed () +. seconds) in
  if once || not (as_json || Terminal.is_live ()) then
    wait interruption (Option.value seconds ~default:l.patience) >|= fun () -> print l ~json:as_json
  else if as_json then report l interruption ~until
  else watch l interruption ~until >|= fun () -> print l ~json:false
