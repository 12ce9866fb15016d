let keywords =
  String.split_on_char ' '
    "and as assert asr begin class constraint do done downto else end exception external false for fun \
     function functor if in include inherit initializer land lazy let lor lsl lsr lxor match method mod \
     module mutable new nonrec object of open or private rec sig struct then to true try type val \
     virtual when while with"

let is_upper c = c >= 'A' && c <= 'Z'
let is_lower c = c >= 'a' && c <= 'z'
let is_digit c = c >= '0' && c <= '9'

(* A word begins at a capital after a small letter, and at the last of several capitals if a small
   letter follows it: Plan|DB|State, Z|Units. *)
let snake name =
  let begins_word i =
    i > 0
    && is_upper name.[i]
    && (is_lower name.[i - 1]
        || (is_upper name.[i - 1] && i + 1 < String.length name && is_lower name.[i + 1]))
  in
  let spell i c = (if begins_word i then "_" else "") ^ String.make 1 (Char.lowercase_ascii c) in
  String.concat "" (List.mapi spell (List.of_seq (String.to_seq name)))

let not_keyword name = if List.mem name keywords then name ^ "_" else name
let not_digit prefix name = if is_digit name.[0] then prefix ^ name else name
let module_ name = String.capitalize_ascii (snake name)
let label name = not_keyword (snake name)
let constructor name = not_digit "Value_" (String.capitalize_ascii (String.lowercase_ascii name))
let value name = not_keyword (not_digit "bit_" (String.lowercase_ascii name))
