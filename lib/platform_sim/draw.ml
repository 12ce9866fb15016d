type question = Length | Failure | Moment | Course

let number = function Length -> 1 | Failure -> 2 | Moment -> 3 | Course -> 4

(* The output function of SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014). *)
let mix z =
  let open Int64 in
  let z = mul (logxor z (shift_right_logical z 30)) 0xBF58476D1CE4E5B9L in
  let z = mul (logxor z (shift_right_logical z 27)) 0x94D049BB133111EBL in
  logxor z (shift_right_logical z 31)

let absorb state n = mix (Int64.add (Int64.logxor state (Int64.of_int n)) 0x9E3779B97F4A7C15L)

let share ~seed ~vehicle ~start question =
  let state = ref (absorb (absorb 0L seed) (String.length vehicle)) in
  String.iter (fun c -> state := absorb !state (Char.code c)) vehicle;
  let bits = absorb (absorb !state start) (number question) in
  Int64.to_float (Int64.shift_right_logical bits 11) *. 0x1p-53

let between least most share = least +. (share *. (most -. least))
