module By_normal = Set.Make (Value)

type t = { small : By_normal.t; large : Value.t list }

(* The normal form of a value whose parts share much is out of reach: [Value.equals] looks at each part once. *)
let is_small = Value.has_at_most 1_000

let empty = { small = By_normal.empty; large = [] }

let add x xs =
  if is_small x then { xs with small = By_normal.add (Value.normal x) xs.small } else { xs with large = x :: xs.large }

let mem x xs = if is_small x then By_normal.mem (Value.normal x) xs.small else List.exists (Value.equals x) xs.large
