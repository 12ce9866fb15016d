open Dolphin_semantics
open Dolphin_environment

type t = {
  store : Store.t;
  tuples : Tuples.t;
  bound : Core.vehicle list;
  outside : Environment.t;
}

let equal a b =
  Tuples.compare a.tuples b.tuples = 0
  && Store.compare a.store b.store = 0
  && List.compare String.compare a.bound b.bound = 0
  && Environment.compare a.outside b.outside = 0

let hash s =
  let mix h k = (h * 65599) + k in
  mix (mix (mix (Tuples.hash s.tuples) (Store.hash s.store)) (Hashtbl.hash s.bound)) (Environment.hash s.outside)
  land max_int

let of_configuration (c : Configuration.t) outside =
  { store = c.store; tuples = c.tuples; bound = c.bound; outside }

let under control s : Configuration.t =
  {
    control;
    store = s.store;
    allocation = Configuration.Vehicle_map.empty;
    bound = s.bound;
    tuples = s.tuples;
  }
