type t = { salt : string }

let make () = { salt = Operators.secret () }

let is_key text =
  let is_good c =
    match c with 'a' .. 'z' | 'A' .. 'Z' | '0' .. '9' | '.' | '-' | '_' -> true | _ -> false in
  let n = String.length text in
  n > 0 && n <= 64 && String.for_all is_good text

(* Of the digest that makes a name. *)
let digits = 12
let owner name = String.sub name 0 (max 0 (String.length name - digits - 1))

let name v ?operator role key =
  let kind = Operators.role_name role in
  let who = Option.value operator ~default:kind in
  who ^ "-" ^ String.sub (Digest.to_hex (Digest.string (String.concat "/" [ v.salt; kind; who; key ]))) 0 digits
