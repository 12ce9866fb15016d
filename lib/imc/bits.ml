module type S = sig
  type t = private int

  val none : t
  val of_int : int -> t
  val to_int : t -> int
  val mem : t -> t -> bool
  val ( + ) : t -> t -> t
  val ( - ) : t -> t -> t
  val to_json : t -> Yojson.Safe.t
  val pp : Format.formatter -> t -> unit
end

let is_single bit = bit <> 0 && bit land (bit - 1) = 0

let names named x =
  let spell (names, rest) (bit, name) =
    if is_single bit && rest land bit <> 0 then (name :: names, rest land lnot bit) else (names, rest)
  in
  match List.assoc_opt x named with
  | Some name when x <> 0 -> [ name ]
  | Some _ | None ->
    let names, rest = List.fold_left spell ([], x) named in
    List.rev (if rest = 0 then names else Printf.sprintf "0x%X" rest :: names)

module Make (Named : sig
    val names : (int * string) list
  end) =
struct
  type t = int

  let none = 0
  let of_int x = x
  let to_int x = x
  let mem x y = x land lnot y = 0
  let ( + ) = ( lor )
  let ( - ) x y = x land lnot y
  let to_json x = `List (List.map (fun name -> `String name) (names Named.names x))
  let pp ppf x = Fmt.(list ~sep:(any " ") string) ppf (names Named.names x)
end
