open Dolphin_ltl

type 'letter word = { letters : 'letter array; back : int }

(* Whether the formula holds, by position. Until is the least solution of its equation, release the greatest. *)
let rec truth at word (f : 'p Formula.t) =
  let truth = truth at word in
  let n = Array.length word.letters in
  let next i = if i = n - 1 then word.back else i + 1 in
  let each on = Array.init n on in
  let of_two f g on =
    let f = truth f and g = truth g in
    each (fun i -> on f.(i) g.(i))
  in
  let solution start f g step =
    let f = truth f and g = truth g in
    let rec go x =
      let x' = each (fun i -> step f.(i) g.(i) x.(next i)) in
      if x = x' then x else go x'
    in
    go (Array.make n start)
  in
  match f with
  | True -> each (fun _ -> true)
  | False -> each (fun _ -> false)
  | Proposition p -> each (fun i -> at word.letters.(i) p)
  | Not f -> Array.map not (truth f)
  | And (f, g) -> of_two f g ( && )
  | Or (f, g) -> of_two f g ( || )
  | Implies (f, g) -> of_two f g (fun f g -> (not f) || g)
  | Equivalent (f, g) -> of_two f g ( = )
  | Next f ->
    let f = truth f in
    each (fun i -> f.(next i))
  | Finally f -> truth (Until (True, f))
  | Globally f -> truth (Not (Finally (Not f)))
  | Until (f, g) -> solution false f g (fun f g x -> g || (f && x))
  | Release (f, g) -> solution true f g (fun f g x -> g && (f || x))
  | Weak_until (f, g) -> solution true f g (fun f g x -> g || (f && x))

let holds at word f = (truth at word f).(0)

let formula proposition =
  let open QCheck2.Gen in
  let leaf =
    frequency
      [ (1, return Formula.True); (1, return Formula.False); (8, map (fun p -> Formula.Proposition p) proposition) ]
  in
  let node self n =
    let unary build = map build (self (n - 1)) and binary build = map2 build (self (n / 2)) (self (n / 2)) in
    oneof
      [ unary (fun f -> Formula.Not f); unary (fun f -> Formula.Next f); unary (fun f -> Formula.Finally f);
        unary (fun f -> Formula.Globally f); binary (fun f g -> Formula.And (f, g));
        binary (fun f g -> Formula.Or (f, g)); binary (fun f g -> Formula.Implies (f, g));
        binary (fun f g -> Formula.Equivalent (f, g)); binary (fun f g -> Formula.Until (f, g));
        binary (fun f g -> Formula.Release (f, g)); binary (fun f g -> Formula.Weak_until (f, g)) ]
  in
  sized_size (int_bound 6) (fix (fun self n -> if n <= 0 then leaf else node self n))
