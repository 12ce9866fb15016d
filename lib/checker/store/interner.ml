module Make (Key : Hashtbl.HashedType) = struct
  module Table = Hashtbl.Make (Key)

  type t = { numbering : Numbering.t; numbers : int Table.t; mutable values : Key.t array }

  let create numbering = { numbering; numbers = Table.create 64; values = [||] }
  let count t = Table.length t.numbers
  let value t i = t.values.(i)
  let find t x = Table.find_opt t.numbers x

  let number t x =
    match Table.find_opt t.numbers x with
    | Some i -> i
    | None ->
      Numbering.give t.numbering;
      let i = count t in
      if i = Array.length t.values then begin
        let values = Array.make (max 16 (2 * i)) x in
        Array.blit t.values 0 values 0 i;
        t.values <- values
      end;
      t.values.(i) <- x;
      Table.add t.numbers x i;
      i
end
