type key = float * int

module Key_map = Map.Make (struct
    type t = key

    let compare (time, number) (time', number') =
      match Float.compare time time' with 0 -> Int.compare number number' | order -> order
  end)

type 'a t = { events : 'a Key_map.t; added : int }

let empty = { events = Key_map.empty; added = 0 }

let add time x q =
  let key = (time, q.added) in
  (key, { events = Key_map.add key x q.events; added = q.added + 1 })

let remove key q = { q with events = Key_map.remove key q.events }
let first q = Option.map (fun ((time, _), x) -> (time, x)) (Key_map.min_binding_opt q.events)

let rest q =
  match Key_map.min_binding_opt q.events with
  | Some (key, _) -> remove key q
  | None -> q
