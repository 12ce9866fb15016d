open Test_support
open Dolphin_semantics
let () =
  let ic = open_in_bin Sys.argv.(1) in
  let source = really_input_string ic (in_channel_length ic) in
  let p = Pure_run.compile_exn source in
  let world = Pure_run.world (List.init 1000 (fun i -> Pure_run.vehicle (Printf.sprintf "v%04d" i) ~north:(float i))) in
  let steps = ref 0 in
  let running = Queue.create () in
  let rec go c =
    match (Transition.internal p world c) () with
    | Seq.Cons (t, _) -> take t
    | Seq.Nil ->
      if Queue.is_empty running then c else
      match Transition.accept p world c (Vehicle_done (Queue.pop running)) with
      | Ok t -> take t | Error _ -> go c
  and take (t : Transition.t) =
    incr steps;
    List.iter (function Effect.Start (v,_) -> Queue.push v running | _ -> ()) t.effects;
    go t.next in
  let t0 = Sys.time () in
  let _ = go (Configuration.initial p) in
  Printf.printf "%d steps %.2f s\n" !steps (Sys.time () -. t0)
