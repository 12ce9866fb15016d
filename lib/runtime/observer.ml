open Dolphin_semantics

type t = {
  transition : time:float -> Transition.t -> unit;
  news : time:float -> World.vehicle_state -> unit;
}

let nobody = { transition = (fun ~time:_ _ -> ()); news = (fun ~time:_ _ -> ()) }

let both a b =
  { transition =
      (fun ~time t ->
         a.transition ~time t;
         b.transition ~time t);
    news =
      (fun ~time state ->
         a.news ~time state;
         b.news ~time state) }
