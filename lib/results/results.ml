let ( let* ) = Result.bind

let rec fold f acc = function
  | [] -> Ok acc
  | x :: rest ->
    let* acc = f acc x in
    fold f acc rest

let map f xs =
  let add found x =
    let* y = f x in
    Ok (y :: found)
  in
  Result.map List.rev (fold add [] xs)

let map_values f entries =
  let value (k, x) =
    let* y = f x in
    Ok (k, y)
  in
  map value entries

let concat_map f xs = Result.map List.concat (map f xs)
