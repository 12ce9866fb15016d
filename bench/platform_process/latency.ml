open Dolphin_runtime
open Lwt.Infix
module Process_platform = Dolphin_platform_process.Process_platform
module Simulator = Dolphin_platform_sim.Simulator
module Scenario = Dolphin_scenario.Scenario

let rounds = 2000

let until (type p) (module P : Platform.S with type t = p) (p : p) fits =
  let rec go () = P.next p >>= fun event -> if fits event then Lwt.return_unit else go () in
  go ()

(* One plan after the other; milliseconds of each. *)
let measure (type p) (module P : Platform.S with type t = p) (p : p) v =
  let times = Array.make rounds 0. in
  let rec go i =
    if i = rounds then Lwt.return_unit
    else begin
      let began = Clock.system.elapsed () in
      P.start p ~number:0 v { name = "instant"; plan = None; task_site = 0 };
      let is_end = function
        | Platform.Task_done _ -> true
        | Task_failed (_, why) -> failwith why
        | Quiet -> failwith "nothing happens any more"
        | Vehicle _ | Timer _ | Input _ -> false
      in
      until (module P) p is_end >>= fun () ->
      times.(i) <- 1000. *. (Clock.system.elapsed () -. began);
      go (i + 1)
    end
  in
  go 0 >>= fun () ->
  P.close p >|= fun () ->
  Array.sort compare times;
  (times.(rounds / 2), times.(rounds * 99 / 100))

let seen v = function Platform.Vehicle { id; _ } -> id = v | _ -> false

let over_the_protocol command =
  Process_platform.open_ (Process_platform.default ~command) >>= function
  | Error why -> failwith why
  | Ok p ->
    until (module Process_platform) p (seen "v") >>= fun () -> measure (module Process_platform) p "v"

let without (scenario : Scenario.t) =
  let v = (List.hd scenario.vehicles).id in
  let tireless (v : Scenario.vehicle) = { v with drain = 0. } in
  let scenario = { scenario with vehicles = List.map tireless scenario.vehicles } in
  let p = Simulator.Virtual.create ~seed:0 scenario in
  until (module Simulator.Virtual) p (seen v) >>= fun () -> measure (module Simulator.Virtual) p v

let () =
  let median, most = Lwt_main.run (over_the_protocol ("exec python3 " ^ Sys.argv.(1))) in
  let median', most' = Lwt_main.run (without Scenario.default) in
  Printf.printf "from an order to its end, of %d: over the protocol median %.3f ms, 99%% %.3f ms; without it %.3f, %.3f\n"
    rounds median most median' most'
