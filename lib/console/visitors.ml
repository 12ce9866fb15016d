type t = { salt : string }

let make () = { salt = (Access.fresh ()).steer }

let is_key text =
  let is_good c =
    match c with 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '.' | '-' | '_' -> true | _ -> false in
  let n = String.length text in
  n > 0 && n <= 64 && String.for_all is_good text

let name v (role : Access.role) key =
  let kind = match role with Steers -> "steers" | Watches -> "watches" in
  kind ^ "-" ^ String.sub (Digest.to_hex (Digest.string (String.concat "/" [ v.salt; kind; key ]))) 0 12
