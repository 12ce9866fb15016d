type key = float * int

module Key_map = Map.Make (struct
    type t = key

    let compare (time, number) (time', number') =
      match Float.compare time time' with 0 -> Int.compare number number' | order -> order
  end)

type 'a t = { occurrences : 'a Key_map.t; added : int }

let empty = { occurrences = Key_map.empty; added = 0 }

let add time x a =
  let key = (time, a.added) in
  (key, { occurrences = Key_map.add key x a.occurrences; added = a.added + 1 })

let remove key a = { a with occurrences = Key_map.remove key a.occurrences }
let first a = Option.map (fun ((time, _), x) -> (time, x)) (Key_map.min_binding_opt a.occurrences)

let rest a =
  match Key_map.min_binding_opt a.occurrences with
  | Some (key, _) -> remove key a
  | None -> a
