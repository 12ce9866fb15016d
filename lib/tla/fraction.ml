let rec gcd a b = if b = 0 then a else gcd b (a mod b)

let shortest n =
  let read precision = Printf.sprintf "%.*e" precision n in
  let rec from precision =
    let text = read precision in
    if precision >= 17 || float_of_string text = n then text else from (precision + 1)
  in
  from 0

(* [digits * 10^exponent] of a text such as [4.1185e+01]. *)
let of_text text =
  match String.index_opt text 'e' with
  | None -> None
  | Some e ->
    let mantissa = String.sub text 0 e and exponent = String.sub text (e + 1) (String.length text - e - 1) in
    let decimals = match String.index_opt mantissa '.' with Some i -> String.length mantissa - i - 1 | None -> 0 in
    let digits = String.concat "" (String.split_on_char '.' mantissa) in
    (match int_of_string_opt digits, int_of_string_opt exponent with
     | Some digits, Some exponent -> Some (digits, exponent - decimals)
     | _, _ -> None)

let rec power k = if k = 0 then 1 else 10 * power (k - 1)
let fits n = Tla.least <= n && n <= Tla.greatest

let of_float n =
  if not (Float.abs n < infinity) then None
  else
    match of_text (shortest n) with
    | None -> None
    | Some (digits, exponent) when exponent > 18 || exponent < -18 -> if digits = 0 then Some (0, 1) else None
    | Some (digits, exponent) ->
      let numerator = if exponent >= 0 then digits * power exponent else digits in
      let denominator = if exponent >= 0 then 1 else power (-exponent) in
      let divisor = max 1 (gcd (abs numerator) denominator) in
      let numerator = numerator / divisor and denominator = denominator / divisor in
      if fits numerator && fits denominator then Some (numerator, denominator) else None
