module Numbers = Map.Make (struct
    type t = int * Looks.moment

    let compare (i, m) (i', m') =
      let c = Int.compare i i' in
      if c <> 0 then c else Looks.compare_moments m m'
  end)

type component = { concerns : Looks.concerns; mutable numbers : int Numbers.t; mutable count : int }
type node = { component : component; i : int; moment : Looks.moment }
type t = (int, node) Hashtbl.t

let create () : t = Hashtbl.create 16
let component concerns = { concerns; numbers = Numbers.empty; count = 0 }

let number nodes component i moment =
  match Numbers.find_opt (i, moment) component.numbers with
  | Some number -> number
  | None ->
    let number = -1 - Hashtbl.length nodes in
    Hashtbl.add nodes number { component; i; moment };
    component.numbers <- Numbers.add (i, moment) number component.numbers;
    component.count <- component.count + 1;
    number

let find (nodes : t) number = Hashtbl.find nodes number
let after component ~time moment looks = Looks.after component.concerns (if time then Looks.beginning else moment) looks
let count component = component.count
