type 'p t =
  | True
  | False
  | Proposition of 'p
  | Not of 'p t
  | And of 'p t * 'p t
  | Or of 'p t * 'p t
  | Implies of 'p t * 'p t
  | Equivalent of 'p t * 'p t
  | Next of 'p t
  | Finally of 'p t
  | Globally of 'p t
  | Until of 'p t * 'p t
  | Release of 'p t * 'p t
  | Weak_until of 'p t * 'p t

let rec map on = function
  | True -> True
  | False -> False
  | Proposition p -> Proposition (on p)
  | Not f -> Not (map on f)
  | Next f -> Next (map on f)
  | Finally f -> Finally (map on f)
  | Globally f -> Globally (map on f)
  | And (f, g) -> both on f g (fun f g -> And (f, g))
  | Or (f, g) -> both on f g (fun f g -> Or (f, g))
  | Implies (f, g) -> both on f g (fun f g -> Implies (f, g))
  | Equivalent (f, g) -> both on f g (fun f g -> Equivalent (f, g))
  | Until (f, g) -> both on f g (fun f g -> Until (f, g))
  | Release (f, g) -> both on f g (fun f g -> Release (f, g))
  | Weak_until (f, g) -> both on f g (fun f g -> Weak_until (f, g))

and both : 'p 'q. ('p -> 'q) -> 'p t -> 'p t -> ('q t -> 'q t -> 'q t) -> 'q t =
  fun on f g build ->
  let f = map on f in
  build f (map on g)

(* {1 Text} *)

let rec pp proposition ppf f =
  let pp = pp proposition in
  let unary sign f = Format.fprintf ppf "%s%a" sign pp f in
  let binary f sign g = Format.fprintf ppf "(%a %s %a)" pp f sign pp g in
  match f with
  | True -> Format.pp_print_string ppf "true"
  | False -> Format.pp_print_string ppf "false"
  | Proposition p -> proposition ppf p
  | Not f -> unary "!" f
  | Next f -> unary "X " f
  | Finally f -> unary "F " f
  | Globally f -> unary "G " f
  | And (f, g) -> binary f "&" g
  | Or (f, g) -> binary f "|" g
  | Implies (f, g) -> binary f "->" g
  | Equivalent (f, g) -> binary f "<->" g
  | Until (f, g) -> binary f "U" g
  | Release (f, g) -> binary f "R" g
  | Weak_until (f, g) -> binary f "W" g

(* {1 Reading} *)

type token = Sign of string | Word of string | Atom of string

exception Wrong of string

let wrong format = Printf.ksprintf (fun why -> raise (Wrong why)) format
let is_letter c = match c with 'a' .. 'z' | 'A' .. 'Z' | '_' -> true | _ -> false
let is_inner c = is_letter c || match c with '0' .. '9' | '-' -> true | _ -> false

(* The place after the bracket that closes the one at [start]; quoted texts are skipped. *)
let closing text start =
  let n = String.length text in
  let rec go i depth quote =
    if i >= n then wrong "the %c is not closed" text.[start]
    else
      match text.[i], quote with
      | '\\', Some _ -> go (i + 2) depth quote
      | c, Some q -> go (i + 1) depth (if c = q then None else quote)
      | ('\'' | '"') as q, None -> go (i + 1) depth (Some q)
      | ('(' | '{' | '['), None -> go (i + 1) (depth + 1) None
      | (')' | '}' | ']'), None -> if depth = 1 then i + 1 else go (i + 1) (depth - 1) None
      | _, None -> go (i + 1) depth None
  in
  go start 0 None

let signs = [ "<->"; "->"; "&&"; "||"; "&"; "|"; "!"; "("; ")" ]

let tokens text =
  let n = String.length text in
  let rec skip i = if i < n && (text.[i] = ' ' || text.[i] = '\t' || text.[i] = '\n') then skip (i + 1) else i in
  let rec go i found =
    let i = skip i in
    if i >= n then List.rev found
    else
      let starts sign = i + String.length sign <= n && String.sub text i (String.length sign) = sign in
      if text.[i] = '{' then
        let stop = closing text i in
        go stop (Atom (String.sub text i (stop - i)) :: found)
      else if is_letter text.[i] then word i found
      else
        match List.find_opt starts signs with
        | Some sign -> go (i + String.length sign) (Sign sign :: found)
        | None -> wrong "unexpected '%c'" text.[i]
  and word i found =
    (* A minus sign is part of a name, unless it begins an arrow. *)
    let begins_arrow j = text.[j] = '-' && j + 1 < n && text.[j + 1] = '>' in
    let rec stop j = if j < n && is_inner text.[j] && not (begins_arrow j) then stop (j + 1) else j in
    let j = stop i in
    let name = String.sub text i (j - i) in
    let is_operator = List.mem name [ "X"; "F"; "G"; "U"; "R"; "W"; "not"; "true"; "false" ] in
    let after = skip j in
    if is_operator then go j (Word name :: found)
    else if after < n && text.[after] = '(' then
      let stop = closing text after in
      go stop (Atom (name ^ String.sub text after (stop - after)) :: found)
    else go j (Atom name :: found)
  in
  go 0 []

let describe = function
  | Sign text | Word text | Atom text -> "'" ^ text ^ "'"

(* Each level reads one formula and gives it with the tokens after it. *)
let rec equivalence tokens = left implication [ "<->" ] (fun f g -> Equivalent (f, g)) tokens

and implication tokens =
  match disjunction tokens with
  | f, Sign "->" :: rest ->
    let g, rest = implication rest in
    (Implies (f, g), rest)
  | whole -> whole

and disjunction tokens = left conjunction [ "|"; "||" ] (fun f g -> Or (f, g)) tokens
and conjunction tokens = left binding [ "&"; "&&" ] (fun f g -> And (f, g)) tokens

and left operand signs build tokens =
  let rec more f = function
    | Sign sign :: rest when List.mem sign signs ->
      let g, rest = operand rest in
      more (build f g) rest
    | rest -> (f, rest)
  in
  let f, rest = operand tokens in
  more f rest

and binding tokens =
  let right f rest build =
    let g, rest = binding rest in
    (build f g, rest)
  in
  match unary tokens with
  | f, Word "U" :: rest -> right f rest (fun f g -> Until (f, g))
  | f, Word "R" :: rest -> right f rest (fun f g -> Release (f, g))
  | f, Word "W" :: rest -> right f rest (fun f g -> Weak_until (f, g))
  | whole -> whole

and unary tokens =
  let of_rest rest build =
    let f, rest = unary rest in
    (build f, rest)
  in
  match tokens with
  | (Sign "!" | Word "not") :: rest -> of_rest rest (fun f -> Not f)
  | Word "X" :: rest -> of_rest rest (fun f -> Next f)
  | Word "F" :: rest -> of_rest rest (fun f -> Finally f)
  | Word "G" :: rest -> of_rest rest (fun f -> Globally f)
  | Word "true" :: rest -> (True, rest)
  | Word "false" :: rest -> (False, rest)
  | Atom text :: rest -> (Proposition text, rest)
  | Sign "(" :: rest -> (
      match equivalence rest with
      | f, Sign ")" :: rest -> (f, rest)
      | _, token :: _ -> wrong "')' is expected before %s" (describe token)
      | _, [] -> wrong "a ')' is missing")
  | token :: _ -> wrong "a formula is expected before %s" (describe token)
  | [] -> wrong "a formula is expected at the end"

let of_string text =
  match equivalence (tokens text) with
  | f, [] -> Ok f
  | _, token :: _ -> Error (Printf.sprintf "an operator is expected before %s" (describe token))
  | exception Wrong why -> Error why
