open Dolphin_semantics

type t = {
  transition : time:float -> cause:Transition.event option -> Transition.t -> unit;
  news : time:float -> World.vehicle_state -> unit;
  unknown : time:float -> Fault.t -> unit;
}

let nobody =
  { transition = (fun ~time:_ ~cause:_ _ -> ()); news = (fun ~time:_ _ -> ()); unknown = (fun ~time:_ _ -> ()) }

let both a b =
  { transition =
      (fun ~time ~cause t ->
         a.transition ~time ~cause t;
         b.transition ~time ~cause t);
    news =
      (fun ~time state ->
         a.news ~time state;
         b.news ~time state);
    unknown =
      (fun ~time fault ->
         a.unknown ~time fault;
         b.unknown ~time fault) }
